"""Calibrating sensors, in a window of its own.

``calibrate_window.CALIBRATE_ACTIONS`` of ``calibrate_window.CalibrateWindow``.
"""
