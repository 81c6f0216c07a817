"""The window of the change of the pressure; see `load_actions`."""
