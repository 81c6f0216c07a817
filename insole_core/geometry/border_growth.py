"""A mesh grown by one ring of triangles beyond its border."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals

_EVENING_ROUNDS = 3


def grown(mesh: TriangleMesh, width_mm: float) -> TriangleMesh:
    """Add a ring of triangles along every border, tangential to the surface.

    Where borders touch each other in one vertex nothing is added.

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
    simple = np.bincount(ends.ravel(), minlength=count) == 2
    new = np.full(count, -1, dtype=np.int64)
    new[simple] = count + np.arange(simple.sum())
    ring = mesh.vertices[simple] + width_mm * _outwards(mesh, ends)[simple]
    a, b = ends[simple[ends].all(1)].T
    added = np.concatenate([np.stack([b, a, new[a]], 1), np.stack([b, new[a], new[b]], 1)])
    triangles = np.concatenate([mesh.triangles, added.astype(np.int32)])
    return TriangleMesh(np.concatenate([mesh.vertices, ring]), triangles)


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
