"""From raw numbers to depth, from pixels to rays.

``sensor.Sensor``, ``pinhole_camera.PinholeCamera``, ``disparity.DisparityModel``,
``correction.DisparityCorrection``.
"""
