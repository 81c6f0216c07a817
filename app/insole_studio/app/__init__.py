"""The window put together: bootstrap, frame, menus, theme, features.

``bootstrap.run_application`` starts it, ``features`` constructs the features, ``actions`` binds
their tables, ``main_controller.MainController`` connects them.
"""
