"""The panels of the main window, which all work on one design.

``design.Design`` holds its parts; ``actions.DESIGN_ACTIONS`` are its actions.
"""
