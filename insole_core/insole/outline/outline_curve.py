"""Closed curves through a few places: the outlines of insoles and of free-hand pads."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import gaussian_filter1d

from insole_core.geometry.arrays import BoolArray, FloatArray

_LEAST_POINTS, _LEAST_PER_SPAN = 720, 8


def closed_curve(points: Sequence[tuple[float, float]] | FloatArray) -> FloatArray:
    """Lay a closed curve with continuous direction through places (Catmull-Rom).

    Parameters
    ----------
    points
        At least three; the first is not repeated.

    Returns
    -------
    (m, 2) float64
        At least 720 points; begins with the first place, which is not repeated at the end.
    """
    p1 = np.asarray(points, dtype=float)
    p0, p2, p3 = np.roll(p1, 1, axis=0), np.roll(p1, -1, axis=0), np.roll(p1, -2, axis=0)
    per_span = max(_LEAST_PER_SPAN, -(-_LEAST_POINTS // len(p1)))
    t = (np.arange(per_span) / per_span)[:, None, None]
    curve = 0.5 * (
        2 * p1
        + (p2 - p0) * t
        + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2
        + (3 * p1 - p0 - 3 * p2 + p3) * t**3
    )
    return np.asarray(curve.transpose(1, 0, 2).reshape(-1, 2))


def crosses_itself(points: Sequence[tuple[float, float]] | FloatArray) -> bool:
    """Whether the closed polygon through places crosses itself."""
    start = np.asarray(points, dtype=float)
    end = np.roll(start, -1, axis=0)
    # Which side of the line through each edge do the ends of all edges lie on?
    along = end - start
    from_start = _cross(along[:, None], start[None] - start[:, None])
    from_end = _cross(along[:, None], end[None] - start[:, None])
    parted = from_start * from_end < 0
    return bool((parted & parted.T).any())


def inside_curve(curve: FloatArray, places: FloatArray) -> BoolArray:
    """Whether places (..., 2) lie in the closed polygon (n, 2), by the even-odd rule."""
    x, y = places[..., 0, None], places[..., 1, None]
    x1, y1 = curve.T
    x2, y2 = np.roll(curve, -1, axis=0).T
    spans = (y1 > y) != (y2 > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = x1 + (y - y1) / (y2 - y1) * (x2 - x1)
    return np.asarray((spans & (crossing > x)).sum(axis=-1) % 2 == 1)


def way_round(curve: FloatArray) -> FloatArray:
    """Share of the way round at each place of a closed curve, (n + 1,); the last is 1."""
    steps = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T)
    return np.concatenate([[0.0], steps.cumsum() / steps.sum()])


def evenly_spread(curve: FloatArray, count: int) -> FloatArray:
    """Give places (count, 2) at even ways along a closed curve; the first is the same."""
    closed, even = np.vstack([curve, curve[:1]]), np.arange(count) / count
    return np.column_stack([np.interp(even, way_round(curve), axis) for axis in closed.T])


def smoothed_along(curve: FloatArray, sigma_mm: float) -> FloatArray:
    """Even out an evenly spread closed curve by Gaussian weights along it."""
    step_mm = float(np.hypot(*(curve[1] - curve[0])))
    return np.asarray(gaussian_filter1d(curve, sigma_mm / step_mm, axis=0, mode="wrap"))


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
