"""`insole-studio calibrate`: a module for each step."""
