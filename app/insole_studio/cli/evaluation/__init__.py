"""`insole-studio evaluate`: a module for each evaluation."""
