"""Move a point of an outline so that its neighbours follow and the edge stays fair."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.outline_curve import closed_curve

_LEAST_REACH_MM = 40.0
_MOST_BEND = 0.01
"""Greatest change of the edge's curvature by a drag, per mm; the least radius is 1 / 0.053 mm."""
_BELL_BEND = 6.0  # second derivative of the bell at its top


def drag_weights(points: FloatArray, number: int, shift: FloatArray) -> FloatArray:
    """Compute the share of a drag that each point of a closed outline follows.

    The share falls along the edge like (1 - u²)³, with continuous curvature. The farther the drag,
    the farther it reaches, so that it never bends the edge by more than a radius of 100 mm does.

    Parameters
    ----------
    points : (n, 2) float64, mm
        Of the outline before the drag, in order; the first is not repeated.
    number
        Index of the point that is dragged.
    shift : (2,) float64, mm
        By how much it is dragged.

    Returns
    -------
    (n,) float64
        1 at the dragged point, 0 beyond the reach.
    """
    away_mm = _along_mm(points, number)
    share = np.clip(away_mm / drag_reach_mm(shift), 0, 1)
    return np.asarray((1 - share * share) ** 3)


def drag_reach_mm(shift: FloatArray) -> float:
    """Return how far along the edge, to either side, a drag (2,) moves it, in mm."""
    return max(_LEAST_REACH_MM, float(np.sqrt(_BELL_BEND / _MOST_BEND * np.hypot(*shift))))


def _along_mm(points: FloatArray, number: int) -> FloatArray:
    """Return the distance (n,) of each point from one of them, the shorter way along the edge."""
    curve = closed_curve(points)
    steps_mm = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T)
    at_mm = np.concatenate([[0.0], steps_mm.cumsum()])[:-1][:: len(curve) // len(points)]
    way_mm = np.abs(at_mm - at_mm[number])
    return np.asarray(np.minimum(way_mm, steps_mm.sum() - way_mm))
