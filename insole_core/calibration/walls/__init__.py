"""Walls: from raw numbers to millimetres, and the map of the distortion.

``captures.WallCapture`` is one wall; ``disparity_fit.linear_inverse_near`` and
``distortion.calibrate_distortion`` fit.
"""
