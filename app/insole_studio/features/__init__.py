"""One folder for one thing that a user does; they do not know each other."""
