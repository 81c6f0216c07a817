"""Subdivision of a mesh along the smooth surface that it approximates."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh


def subdivided(mesh: TriangleMesh) -> tuple[TriangleMesh, np.ndarray]:
    """Split every triangle into four; vertices stay, edges are split at the middle of a curve.

    The middle of an edge lies on the cubic of the curved PN triangle (Vlachos 2001), which is
    perpendicular to the vertex normals at both ends.

    Returns
    -------
    mesh : TriangleMesh
        Without colours.
    ends : (n, 2) int64
        The two given vertices that each vertex lies between; twice the same one for a vertex that
        was given.
    """
    sides = mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].astype(np.int64)
    low, high = sides.min(2), sides.max(2)
    count = len(mesh.vertices)
    key, middle = np.unique(low * count + high, return_inverse=True)
    ends = np.stack(np.divmod(key, count), axis=1)
    vertices = np.concatenate([mesh.vertices, _middles(mesh, ends)])
    ab, bc, ca = (middle.reshape(-1, 3) + count).T
    a, b, c = mesh.triangles.T
    quarters = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    triangles = np.concatenate([np.stack(corners, axis=1) for corners in quarters])
    own = np.repeat(np.arange(count)[:, None], 2, axis=1)
    return TriangleMesh(vertices, triangles.astype(np.int32)), np.concatenate([own, ends])


def _middles(mesh: TriangleMesh, ends: np.ndarray) -> FloatArray:
    start, end = mesh.vertices[ends[:, 0]], mesh.vertices[ends[:, 1]]
    way = end - start
    bend = np.zeros_like(way)
    for i, sign in ((0, 1), (1, -1)):
        normal = mesh.vertex_normals[ends[:, i]]
        bend += sign * np.einsum("nc,nc->n", way, normal)[:, None] * normal
    return np.asarray((start + end) / 2 - bend / 8)
