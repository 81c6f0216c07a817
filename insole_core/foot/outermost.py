"""The part of a surface that reaches farthest, by areas instead of single points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.weighted import outermost_mean

_OUTERMOST_MM2 = 4.0  # whose mean is how far a surface reaches: a point alone may be noise


@dataclass(frozen=True, eq=False)
class Border:
    """Points of a surface, mm, each of which represents an area.

    Parameters
    ----------
    points, normals : (n, 3) float64
    area_mm2 : (n,) float64
    """

    points: FloatArray
    normals: FloatArray
    area_mm2: FloatArray

    def part(self, keep: BoolArray) -> Border:
        """Keep only the points with `keep` (n,) true."""
        return Border(self.points[keep], self.normals[keep], self.area_mm2[keep])

    def weighted(self, shares: FloatArray) -> Border:
        """Let each point count for a share (n,) of its area; without those that do not count."""
        return Border(self.points, self.normals, self.area_mm2 * shares).part(shares > 0)

    def turned(self, a2b: FloatArray) -> Border:
        """Rotate the points by `a2b` (3, 3)."""
        return Border(self.points @ a2b.T, self.normals @ a2b.T, self.area_mm2)


def reach(along: FloatArray, area_mm2: FloatArray) -> float:
    """Return how far a surface reaches, mm: the mean of its outermost 4 mm².

    Parameters
    ----------
    along : (n,) float64, mm
        How far each point reaches.
    area_mm2 : (n,) float64
    """
    return outermost_mean(along, area_mm2, _OUTERMOST_MM2)


def cap(points: FloatArray, rated: FloatArray, area_mm2: FloatArray, depth_mm: float) -> FloatArray:
    """Return the middle (3,) of the part of a surface that reaches farthest.

    Unlike the farthest point itself, it moves little when the surface changes little.

    Parameters
    ----------
    points : (n, 3) float64, mm
    rated : (n,) float64, mm
        How far each point reaches.
    area_mm2 : (n,) float64
    depth_mm
        Of the part; its deepest points have no weight.
    """
    weights = area_mm2 * np.maximum(rated - reach(rated, area_mm2) + depth_mm, 0.0)
    return np.asarray(weights @ points / weights.sum())


def ramp(values: FloatArray | float, between: tuple[float, float]) -> FloatArray:
    """Return 0 below a range, 1 above it, and the share of it in between."""
    low, high = between
    return np.asarray(np.clip((np.asarray(values) - low) / (high - low), 0.0, 1.0))
