"""The designed rim and toe zone, and the plate that joins them to the scan.

``finished.finished`` does all of it, ``rim_curve.RimCurve`` is the curve of the rim; its module
moves its stations, too.
"""
