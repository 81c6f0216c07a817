"""Deterministic, even sampling of triangle meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class SurfaceSamples:
    """Points on a mesh.

    Parameters
    ----------
    points : (n, 3) float64, mm, frame of the mesh
    triangle : (n,) int64
        Index of the triangle that each point lies on.
    area_mm2 : (n,) float64
        Area that each point represents; they add up to the area of the mesh.
    """

    points: FloatArray
    triangle: IntArray
    area_mm2: FloatArray


def sample_triangles(mesh: TriangleMesh, pitch_mm: float) -> SurfaceSamples:
    """Sample every triangle in rows parallel to its longest edge.

    The number of points follows the area, so needle-shaped triangles are cheap; every triangle
    gets at least one.

    Parameters
    ----------
    pitch_mm
        Largest distance of neighbouring points in a triangle.

    Returns
    -------
    SurfaceSamples
        Ordered by triangle.
    """
    corners = _longest_edge_first(mesh.vertices[mesh.triangles])
    edges = corners[:, 1:] - corners[:, :1]
    base = np.linalg.norm(edges[:, 0], axis=1)
    twice_area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    height = np.divide(twice_area, base, out=np.zeros_like(base), where=base > 0)
    columns, rows = (
        np.ceil(np.maximum(length / pitch_mm, 1)).astype(np.int64) for length in (base, height)
    )
    count = columns * rows
    triangle = np.repeat(np.arange(len(count)), count)
    index = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    v = (index // columns[triangle] + 0.5) / rows[triangle]
    u = (index % columns[triangle] + 0.5) / columns[triangle] * (1 - v)
    points = (
        corners[triangle, 0] + u[:, None] * edges[triangle, 0] + v[:, None] * edges[triangle, 1]
    )
    return SurfaceSamples(points, triangle, (twice_area / count)[triangle] * (1 - v))


def _longest_edge_first(corners: FloatArray) -> FloatArray:
    """Order the corners (n, 3, 3) so that the longest edge runs from the first to the second."""
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    order = (lengths.argmax(axis=1)[:, None] + np.arange(3)) % 3
    return np.asarray(np.take_along_axis(corners, order[:, :, None], axis=1))
