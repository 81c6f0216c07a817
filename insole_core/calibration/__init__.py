"""Calibration of sensors, from boards, walls and markers.

``least_squares.least_squares`` solves all of it; ``stored_correction.apply_correction`` puts what
was found into a ``depth_sensor.DepthSensor``.
"""
