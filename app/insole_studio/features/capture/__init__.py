"""Capturing a foot with live sensors.

``actions.CAPTURE_ACTIONS`` of ``capture_window.CaptureWindow``.
"""
