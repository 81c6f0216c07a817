"""A mesh grown by one ring of triangles beyond its border."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals

_EVENING_ROUNDS = 3
_LEAST_DISTANCE = 0.7
"""Share of the ring's width that its vertices keep from all others."""


def grown(mesh: TriangleMesh, width_mm: float) -> TriangleMesh:
    """Add a ring of triangles along every border, tangential to the surface.

    Nothing is added where borders touch each other in one vertex, or where the ring would run
    into the surface on the other side of a narrow gap.

    Parameters
    ----------
    mesh
    width_mm
        Of the ring.

    Returns
    -------
    The given vertices first, without colours.
    """
    count = len(mesh.vertices)
    ends = _border_edges(mesh)
    free = np.bincount(ends.ravel(), minlength=count) == 2
    ring = mesh.vertices + width_mm * _outwards(mesh, ends)
    free[free] = _is_free(ring[free], mesh, width_mm)
    a, b = ends[free[ends].all(1)].T
    source = np.unique([a, b])
    new = np.full(count, -1, dtype=np.int64)
    new[source] = count + np.arange(len(source))
    added = np.concatenate([np.stack([b, a, new[a]], 1), np.stack([b, new[a], new[b]], 1)])
    triangles = np.concatenate([mesh.triangles, added.astype(np.int32)])
    return TriangleMesh(np.concatenate([mesh.vertices, ring[source]]), triangles)


def _is_free(points: FloatArray, mesh: TriangleMesh, width_mm: float) -> BoolArray:
    near, _ = cKDTree(mesh.vertices).query(points)
    return np.asarray(near > _LEAST_DISTANCE * width_mm)


def _border_edges(mesh: TriangleMesh) -> IntArray:
    """Edges (n, 2) with one triangle, in the direction in which that runs through them."""
    sides = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    count = len(mesh.vertices)
    forth, back = sides @ [count, 1], sides[:, ::-1] @ [count, 1]
    return np.asarray(sides[~np.isin(forth, back)])


def _outwards(mesh: TriangleMesh, ends: IntArray) -> FloatArray:
    """Directions (n, 3) off the border in the surface, evened along it; 0 away from it."""
    a, b = ends.T
    normals = smoothed_normals(mesh, _EVENING_ROUNDS)
    aside = np.cross(mesh.vertices[b] - mesh.vertices[a], normals[a] + normals[b])
    total = np.zeros_like(mesh.vertices)
    for end in (a, b):
        np.add.at(total, end, _unit(aside))
    total = _unit(total)
    for _ in range(_EVENING_ROUNDS):
        sums = total.copy()
        np.add.at(sums, a, total[b])
        np.add.at(sums, b, total[a])
        total = _unit(sums)
    return total


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(length, 1e-12))
