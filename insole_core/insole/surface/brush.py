"""Free-hand brush strokes on the surface: push, pull and smooth along a path, with fall-off."""

from __future__ import annotations

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import BrushStroke
from insole_core.insole.primitives.blending import gaussian_hill

_PITCH = 1 / 40  # of the radius, between the points that sample the path
_SIGMA = 1 / 3  # of the radius: standard deviation of the smoothing
HALO = 4 * _SIGMA
"""How far beyond its radius a smoothing stroke reads heights, in radii."""


def stroke_weight(stroke: BrushStroke, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
    """Compute the weight of a stroke on the nodes of a grid.

    Parameters
    ----------
    x_mm, y_mm : (nx,), (ny,) float64
        Coordinates of the columns and rows, insole frame.

    Returns
    -------
    (ny, nx) float64
        1 on the path of the stroke, falling to 0 at its radius.
    """
    way = _dense(np.array(stroke.points_mm, dtype=float), _PITCH * stroke.radius_mm)
    x, y = np.meshgrid(x_mm, y_mm)
    distance, _ = scipy.spatial.cKDTree(way).query(
        np.stack([x, y], axis=-1), distance_upper_bound=10_000.0
    )
    return gaussian_hill(np.asarray(distance) / stroke.radius_mm)


def stroked(heights: FloatArray, weight: FloatArray, stroke: BrushStroke, step_mm: float) -> None:
    """Apply a stroke to heights in place; nothing changes where its weight is 0.

    Parameters
    ----------
    heights : (ny, nx) float64, mm
    weight : (ny, nx) float64
        From `stroke_weight`.
    step_mm
        Pitch of the grid.
    """
    if stroke.mode == "smooth":
        even = _even(heights, _SIGMA * stroke.radius_mm / step_mm)
        heights += np.where(weight > 0, weight * stroke.strength * (even - heights), 0.0)
    else:
        sign = 1.0 if stroke.mode == "push" else -1.0
        heights += sign * stroke.strength * weight


def _even(heights: FloatArray, sigma: float) -> FloatArray:
    """Smooth with a Gaussian up to 4 sigma; OpenCV needs a tenth of the time of SciPy."""
    size = 2 * int(4 * sigma + 0.5) + 1
    border = cv2.BORDER_REPLICATE
    return np.asarray(cv2.GaussianBlur(heights.copy(), (size, size), sigma, borderType=border))


def _dense(way: FloatArray, pitch_mm: float) -> FloatArray:
    """Resample a polyline, its points at most one pitch apart."""
    lengths = np.hypot(*np.diff(way, axis=0).T) if len(way) > 1 else np.zeros(0)
    pieces = [way[:1]]
    for start, end, length in zip(way[:-1], way[1:], lengths, strict=True):
        share = np.linspace(0, 1, int(np.ceil(length / pitch_mm)) + 1)[1:, None]
        pieces.append(start + share * (end - start))
    return np.concatenate(pieces)
