"""Smooth disparity where it is continuous, and the surface's angle to the rays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.reconstruct.fusion.depth_view import DepthView

_SIGMA_PX = 1.5
_REACH_PX = 3
_JUMP_RAW = 8.0
_LEAST_SUPPORT = 2.5
"""Sum of weights below which a pixel has almost no neighbours; the kernel's full sum is 13.6."""
_UNKNOWN_COSINE = 0.2


@dataclass(frozen=True, eq=False)
class SmoothDepth:
    """The smoothed depth of one view.

    Parameters
    ----------
    depth_mm : (height, width) float64, NaN = no surface
    cosine : (height, width) float64
        Of the angle between ray and surface normal.
    """

    depth_mm: FloatArray
    cosine: FloatArray


def smooth_depth(reading: DepthView) -> SmoothDepth:
    """Smooth a reading by a Gaussian that stops at jumps; pixels without neighbours are dropped."""
    raw, support = _smooth(reading.raw.astype(np.float32))
    raw = np.where(support > _LEAST_SUPPORT, raw, np.nan)
    points = reading.points(raw)
    normals = np.cross(_difference(points, 1), _difference(points, 0))
    rays = points - reading.origin_mm
    lengths = np.linalg.norm(normals, axis=-1) * np.linalg.norm(rays, axis=-1)
    cosine = np.abs(np.einsum("vuc,vuc->vu", normals, rays)) / np.maximum(lengths, 1e-12)
    return SmoothDepth(
        reading.depth_along(points), np.where(np.isfinite(cosine), cosine, _UNKNOWN_COSINE)
    )


def _smooth(raw: Float32Array) -> tuple[FloatArray, Float32Array]:
    height, width = raw.shape
    known = np.isfinite(raw)
    values = np.pad(np.where(known, raw, np.inf), _REACH_PX, constant_values=np.inf)
    total, support = np.zeros_like(raw), np.zeros_like(raw)
    steps = range(2 * _REACH_PX + 1)
    profile = np.exp(-((np.arange(2 * _REACH_PX + 1) - _REACH_PX) ** 2) / (2 * _SIGMA_PX**2))
    center = np.where(known, raw, 0)
    for dv in steps:
        for du in steps:
            difference = values[dv : dv + height, du : du + width] - center
            weight = np.float32(profile[dv] * profile[du])
            near = np.abs(difference) < _JUMP_RAW
            total += np.where(near, weight * difference, 0)
            support += np.where(near, weight, 0)
    smooth = center.astype(float) + total / np.maximum(support, 1e-9)
    return np.where(known, smooth, np.nan), support * known


def _difference(points: FloatArray, axis: int) -> FloatArray:
    """Compute central differences, one-sided beside a gap, NaN without a neighbour."""
    ahead, behind = np.full_like(points, np.nan), np.full_like(points, np.nan)
    low = tuple(slice(None, -1) if i == axis else slice(None) for i in range(3))
    high = tuple(slice(1, None) if i == axis else slice(None) for i in range(3))
    ahead[low] = points[high] - points[low]
    behind[high] = points[high] - points[low]
    central = (ahead + behind) / 2
    return np.where(np.isfinite(central), central, np.where(np.isfinite(ahead), ahead, behind))
