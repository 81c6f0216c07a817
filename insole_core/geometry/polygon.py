"""Closed polygons in the plane."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray


def signed_area_mm2(polygon: FloatArray) -> float:
    """Return the area of a polygon (n, 2), mm; positive if it runs counter-clockwise."""
    x, y = polygon.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)
