"""Calibrating sensors, in a window of its own.

``actions.CALIBRATE_ACTIONS`` of ``calibrate_window.CalibrateWindow``.
"""
