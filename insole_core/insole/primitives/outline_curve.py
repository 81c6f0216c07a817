"""Closed curves through a few points: the outlines of insoles and of free-hand pads."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray

_LEAST_POINTS, _LEAST_PER_SPAN = 720, 8


def closed_curve(points: Sequence[tuple[float, float]] | FloatArray) -> FloatArray:
    """Interpolate a closed curve with continuous tangent through points (Catmull-Rom).

    Parameters
    ----------
    points : (n, 2)
        At least three; the first is not repeated.

    Returns
    -------
    (m, 2) float64
        At least 720 points; starts with the first point, which is not repeated at the end.
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
    """Return whether the closed polygon through points (n, 2) crosses itself."""
    start = np.asarray(points, dtype=float)
    end = np.roll(start, -1, axis=0)
    # The signs say on which side of the line through each edge the ends of all edges lie.
    along = end - start
    from_start = _cross(along[:, None], start[None] - start[:, None])
    from_end = _cross(along[:, None], end[None] - start[:, None])
    parted = from_start * from_end < 0
    return bool((parted & parted.T).any())


def inside_curve(curve: FloatArray, places: FloatArray) -> BoolArray:
    """Test which points lie in a closed polygon, by the even-odd rule.

    Parameters
    ----------
    curve : (n, 2)
        Corners of the polygon; the first is not repeated.
    places : (..., 2)
        Points, in the unit of `curve`.

    Returns
    -------
    (...) bool
    """
    by_y = places[..., 1].argsort(axis=None)
    x, y = places.reshape(-1, 2)[by_y].T
    start, end = curve, np.roll(curve, -1, axis=0)
    # An edge meets the horizontal lines of a run of places: few of all pairs have to be looked at.
    first = y.searchsorted(np.minimum(start[:, 1], end[:, 1]))
    count = y.searchsorted(np.maximum(start[:, 1], end[:, 1])) - first
    edge = np.repeat(np.arange(len(curve)), count)
    place = np.arange(len(edge)) + np.repeat(first - count.cumsum() + count, count)
    (x1, y1), (x2, y2) = start[edge].T, end[edge].T
    crossing = x1 + (y[place] - y1) / (y2 - y1) * (x2 - x1)
    inside = np.zeros(len(by_y), dtype=bool)
    inside[by_y] = np.bincount(place[crossing > x[place]], minlength=len(by_y)) % 2 == 1
    return inside.reshape(places.shape[:-1])


def way_round(curve: FloatArray) -> FloatArray:
    """Return the share of the arc length at each point of a closed curve, (n + 1,), up to 1."""
    steps = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T)
    return np.concatenate([[0.0], steps.cumsum() / steps.sum()])


def evenly_spread(curve: FloatArray, count: int) -> FloatArray:
    """Resample a closed curve at even arc lengths.

    Parameters
    ----------
    curve : (n, 2)
        The first point is not repeated.

    Returns
    -------
    (count, 2) float64
        The first point is that of `curve`.
    """
    closed, even = np.vstack([curve, curve[:1]]), np.arange(count) / count
    return np.column_stack([np.interp(even, way_round(curve), axis) for axis in closed.T])


def smoothed_along(curve: FloatArray, sigma_mm: float) -> FloatArray:
    """Smooth a closed curve by a Gaussian along its arc length.

    Parameters
    ----------
    curve : (n, 2) float64, mm
        Evenly spaced points; the first is not repeated.

    Returns
    -------
    (n, 2) float64, mm
    """
    step_mm = float(np.hypot(*(curve[1] - curve[0])))
    return np.asarray(
        scipy.ndimage.gaussian_filter1d(curve, sigma_mm / step_mm, axis=0, mode="wrap")
    )


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
