"""Capturing a foot with live sensors.

``capture_window.CAPTURE_ACTIONS`` of ``capture_window.CaptureWindow``.
"""
