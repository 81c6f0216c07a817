"""`insole-studio records`: the clinic's record without the window."""
