"""The application and its command line.

Beside the packages: ``texts.tr`` translates, ``jobs.Jobs`` starts threads, ``settings.Settings``
and ``user_paths.UserPaths`` are of the user.
"""
