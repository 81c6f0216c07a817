"""Lines of equal height on a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray


@dataclass(frozen=True, eq=False)
class LevelLines:
    """Segments of the lines of equal height, in no particular order.

    Parameters
    ----------
    segments : (k, 2, 3) float64, mm, frame of the mesh
    number : (k,) int64
        Level of each segment, in steps.
    triangle : (k,) int64
        Triangle that it crosses.
    """

    segments: FloatArray
    number: IntArray
    triangle: IntArray


def level_lines(vertices: FloatArray, triangles: IndexArray, step_mm: float) -> LevelLines:
    """Find where a mesh has a height (z) that is a multiple of a step.

    Parameters
    ----------
    vertices : (n, 3) float64, mm
    triangles : (m, 3) int32
    step_mm
        Distance of the levels.

    Returns
    -------
    LevelLines
        In the frame of the vertices.
    """
    corners = vertices[triangles]
    order = corners[..., 2].argsort(axis=1)
    low, middle, high = np.moveaxis(np.take_along_axis(corners, order[..., None], axis=1), 1, 0)
    first = np.floor(low[:, 2] / step_mm).astype(np.int64) + 1
    count = np.floor(high[:, 2] / step_mm).astype(np.int64) - first + 1
    triangle = np.repeat(np.arange(len(triangles)), count)
    number = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count) + first[triangle]
    level = number * step_mm
    low, middle, high = low[triangle], middle[triangle], high[triangle]
    is_lower = (level < middle[:, 2])[:, None]
    start = _at_level(low, high, level)
    end = _at_level(np.where(is_lower, low, middle), np.where(is_lower, middle, high), level)
    return LevelLines(np.stack([start, end], axis=1), number, triangle)


def _at_level(low: FloatArray, high: FloatArray, level: FloatArray) -> FloatArray:
    """Return the points (k, 3) at a height on edges that reach it; the upper end of level ones."""
    rise = high[:, 2] - low[:, 2]
    share = np.divide(level - low[:, 2], rise, out=np.ones_like(rise), where=rise > 0)
    return np.asarray(low + share[:, None] * (high - low))
