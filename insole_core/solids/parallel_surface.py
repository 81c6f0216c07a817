"""A surface at a distance below another: the lower face of a shell of even thickness."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.height_field import HeightField


def parallel_below(field: HeightField, distance_mm: float) -> FloatArray:
    """Give the highest surface that keeps a distance from the field, and stays above z = 0.

    A ball rolled under the field, its centre on the result, never cuts into it (erosion of the
    field by the ball): no place is nearer than the distance, and no loop can arise in a hollow.

    Returns
    -------
    (ny, nx) float64, mm
        Heights at the nodes of the field.
    """
    heights, step = field.heights_mm, field.step_mm
    rows, columns = heights.shape
    reach = int(distance_mm / step)
    ring = np.pad(heights, reach, mode="edge")
    lowest = np.full_like(heights, np.inf)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            below2 = distance_mm**2 - (i * i + j * j) * step**2
            if below2 >= 0:
                part = ring[reach + i : reach + i + rows, reach + j : reach + j + columns]
                np.minimum(lowest, part - np.sqrt(below2), out=lowest)
    return np.maximum(lowest, 0.0)
