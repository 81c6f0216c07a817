"""What an insole is drawn with: height fields, closed curves, soft steps.

``height_field.HeightField``, ``outline_curve.closed_curve``, ``blending.smooth_step``.
"""
