"""What lies far from the origin, as in the coordinates of a map, is brought near it.

Numbers have the more digits before the point the farther they are from zero, and the fewer behind
it: squares and products of them lose tenths of a millimetre some metres away.
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray

_EXTENTS = 10.0
"""Steps of the new origin, in extents of what lies far away: what is near stays where it is."""
_LEAST_POINTS, _SAMPLE = 500, 50_000
_ODD = 0.05  # of a step, by which the places of a lattice may be off


def far_origin(points: FloatArray) -> FloatArray:
    """Return a place (3,) near points (n, 3) that lie far from the origin; else the origin.

    It depends little on the points, so that copies of one thing that lie alike stay alike.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    step = _EXTENTS * float((high - low).max())
    if not (step > 0 and np.isfinite(step)):
        return np.zeros(3)
    return np.asarray(np.round((low + high) / 2 / step) * step)


def coordinate_step(points: FloatArray) -> float:
    """Return the step in which coordinates of points (n, 3) far away were rounded; 0 for none.

    Parameters
    ----------
    points
        Near the origin, as many as a foot has; with few of them there is no telling.
    """
    if len(points) < _LEAST_POINTS:
        return 0.0
    sample = points[:: max(1, len(points) // _SAMPLE)]
    return max(_axis_step(column) for column in sample.T)


def _axis_step(values: FloatArray) -> float:
    """Return the distance of the lattice on which all values (n,) lie; 0 where they do not."""
    steps = np.diff(np.unique(values))
    if len(steps) == 0:
        return 0.0
    least = float(steps.min())
    return least if (np.abs(steps / least - np.round(steps / least)) < _ODD).all() else 0.0
