"""How far behind the front edge of an insole a place lies, without creases."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.primitives.outline_curve import evenly_spread

_AHEAD = 0.6  # y of the outward normal: the front edge turns by at most 53 degrees
_STEEPEST = np.sqrt(1 - _AHEAD**2) / _AHEAD
_PITCH_MM, _SIGMA_MM = 0.5, 3.0


def behind_front_mm(outline: FloatArray, field: HeightField) -> FloatArray:
    """Measure how far the nodes of a field lie behind the front edge of an outline.

    The distance is exact along a straight edge and to first order along a bent one. It has no
    creases, unlike the distance to the nearest point; beside the front edge it goes on straight.

    Parameters
    ----------
    outline : (n, 2) float64, mm, frame of `field`
        Counter-clockwise; the first point is not repeated.

    Returns
    -------
    (ny, nx) float64, mm
        Negative ahead of the edge.
    """
    x, y = _front(outline).T
    front = np.interp(field.x_mm, x, y)
    ends = (y[1] - y[0]) / (x[1] - x[0]), (y[-1] - y[-2]) / (x[-1] - x[-2])
    slopes = np.clip(ends, -_STEEPEST, _STEEPEST)
    front += slopes[0] * np.minimum(field.x_mm - x[0], 0)
    front += slopes[1] * np.maximum(field.x_mm - x[-1], 0)
    sigma = _SIGMA_MM / field.step_mm
    slope = scipy.ndimage.gaussian_filter1d(
        np.gradient(front, field.step_mm), sigma, mode="nearest"
    )
    return np.asarray((front - field.y_mm[:, None]) / np.hypot(1.0, slope))


def _front(outline: FloatArray) -> FloatArray:
    """Return the points (n, 2) about the foremost one whose normals point ahead, by x."""
    length_mm = np.hypot(*(np.roll(outline, -1, axis=0) - outline).T).sum()
    points = evenly_spread(outline, max(int(length_mm / _PITCH_MM), 16))
    points = np.roll(points, -int(points[:, 1].argmax()), axis=0)
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    ahead = -along[:, 0] / np.hypot(*along.T) > _AHEAD
    onward, back = (_run(run) for run in (ahead, ahead[:0:-1]))
    edge = np.concatenate([points[len(points) - back :], points[:onward]])[::-1]
    edge = np.asarray(edge[np.concatenate([[True], np.diff(edge[:, 0]) > 0])])
    if len(edge) > 1:
        return edge
    return np.asarray(points[0] + [[-_PITCH_MM, 0.0], [_PITCH_MM, 0.0]])  # a sharp tip


def _run(holds: FloatArray) -> int:
    """Return for how many values from the first one on a condition holds."""
    return int(holds.argmin()) if not holds.all() else len(holds)
