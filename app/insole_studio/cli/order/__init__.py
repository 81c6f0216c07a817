"""`insole-studio order`: to make and to verify an order."""
