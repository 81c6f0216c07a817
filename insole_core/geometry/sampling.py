"""Deterministic, even sampling of triangle meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_STEPS = (0.7548776662466927, 0.5698402909980532)
"""Of the additive sequence R2 (Roberts 2018), which fills a square evenly."""


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
    middle = (index // columns[triangle] + 0.5) / rows[triangle]
    v = middle - 1 / (12 * rows[triangle] ** 2 * (1 - middle))  # centroid of the row
    u = (index % columns[triangle] + 0.5) / columns[triangle] * (1 - v)
    points = (
        corners[triangle, 0] + u[:, None] * edges[triangle, 0] + v[:, None] * edges[triangle, 1]
    )
    return SurfaceSamples(points, triangle, (twice_area / count)[triangle] * (1 - middle))


def area_samples(mesh: TriangleMesh, area_mm2: float) -> tuple[FloatArray, IntArray]:
    """Sample a mesh so that every point represents the same area.

    Neither time nor memory grow with the triangles by more than their areas; the points do not
    depend on the winding of the triangles.

    Parameters
    ----------
    area_mm2
        Largest area of one point.

    Returns
    -------
    points : (n, 3) float64, mm
    triangle : (n,) int64
        Index of the triangle of each point.
    """
    reached = np.cumsum(mesh.triangle_areas_mm2)
    count = max(int(np.ceil(reached[-1] / area_mm2)), 1)
    steps = (np.arange(count) + 0.5) * (reached[-1] / count)
    triangle = np.minimum(np.searchsorted(reached, steps), len(reached) - 1)
    a, b, c = np.moveaxis(mesh.vertices[np.sort(mesh.triangles[triangle], axis=1)], 1, 0)
    u, v = (np.arange(1, count + 1)[:, None] * np.array(_STEPS) % 1.0).T
    beyond = u + v > 1
    u, v = np.where(beyond, 1 - u, u), np.where(beyond, 1 - v, v)
    return np.asarray(a + u[:, None] * (b - a) + v[:, None] * (c - a)), triangle


def _longest_edge_first(corners: FloatArray) -> FloatArray:
    """Order the corners (n, 3, 3) so that the longest edge runs from the first to the second."""
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    order = (lengths.argmax(axis=1)[:, None] + np.arange(3)) % 3
    return np.asarray(np.take_along_axis(corners, order[:, :, None], axis=1))


def boundary_points(mesh: TriangleMesh, step_mm: float) -> FloatArray:
    """Return points along the boundary of an open mesh.

    Parameters
    ----------
    step_mm
        Greatest distance between neighbouring points.

    Returns
    -------
    (k, 3) float64, mm, frame of the mesh
        None for a closed mesh.
    """
    edges, sharing = mesh.links.edges
    start, end = np.moveaxis(mesh.vertices[edges[sharing == 1]], 1, 0)
    parts = np.ceil(np.linalg.norm(end - start, axis=1) / step_mm).astype(np.int64) + 1
    edge = np.repeat(np.arange(len(start)), parts)
    index = np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts)
    share = (index + 0.5) / parts[edge]
    return np.asarray(start[edge] + share[:, None] * (end - start)[edge])
