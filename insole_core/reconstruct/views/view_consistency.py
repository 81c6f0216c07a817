"""How many views see each point of the foot, and how far they differ there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.smoothing import smooth_depth

_LEAST_COSINE = 0.2
_FARTHEST_MM = 10.0


@dataclass(frozen=True, eq=False)
class ViewConsistency:
    """Number of views at every vertex of a mesh, and their disagreement.

    Parameters
    ----------
    views : (n,) int64
        Number of views that see each vertex.
    spread_mm : (n,) float64
        Distance between the lowest and the highest of their surfaces along the normal; NaN where
        fewer than two views see the vertex.
    """

    views: IntArray
    spread_mm: FloatArray


def view_consistency(mesh: TriangleMesh, readings: Iterable[DepthView]) -> ViewConsistency:
    """Compare the views with each other at the vertices of a mesh.

    Parameters
    ----------
    mesh : mm, reference frame
    readings
        Depth views whose poses are known.

    Returns
    -------
    ViewConsistency
    """
    count = np.zeros(len(mesh.vertices), dtype=np.int64)
    low, high = np.full(len(count), np.inf), np.full(len(count), -np.inf)
    for reading in readings:
        above_mm = _heights(mesh, reading)
        seen = np.isfinite(above_mm)
        count += seen
        low[seen] = np.minimum(low, above_mm)[seen]
        high[seen] = np.maximum(high, above_mm)[seen]
    return ViewConsistency(count, np.where(count > 1, high - low, np.nan))


def _heights(mesh: TriangleMesh, reading: DepthView) -> FloatArray:
    """Compute a view's height above each vertex along the normal, mm; NaN = not seen."""
    depth_mm = smooth_depth(reading).depth_mm
    way = reading.origin_mm - mesh.vertices
    cosine = np.einsum("nc,nc->n", mesh.vertex_normals, way) / np.linalg.norm(way, axis=1)
    u, v = np.rint(reading.project(mesh.vertices)).astype(np.int64).T
    height, width = depth_mm.shape
    inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
    measured = depth_mm[np.clip(v, 0, height - 1), np.clip(u, 0, width - 1)]
    above_mm = (reading.depth_along(mesh.vertices) - measured) * cosine
    seen = inside & (cosine > _LEAST_COSINE) & (np.abs(above_mm) < _FARTHEST_MM)
    return np.where(seen, above_mm, np.nan)
