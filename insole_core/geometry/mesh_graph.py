"""How the vertices of a mesh are joined: neighbours, pieces, borders, and smoothing over them."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import connected_components

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_SHRINK, _GROW = 0.5, -0.52


def pieces(mesh: TriangleMesh) -> tuple[int, IntArray]:
    """Give the number of connected pieces, and the piece of each vertex (n,)."""
    count, piece = connected_components(mesh.links.adjacency, directed=False)
    return int(count), np.asarray(piece)


def in_large_pieces(mesh: TriangleMesh, least_share: float) -> BoolArray:
    """Tell which vertices (n,) lie in connected pieces with such a share of all triangles."""
    count, piece = pieces(mesh)
    size = np.bincount(piece[mesh.triangles[:, 0]], minlength=count)
    return np.asarray(size[piece] > least_share * len(mesh.triangles))


def relaxed(mesh: TriangleMesh, rounds: int) -> FloatArray:
    """Smooth the vertices (n, 3) without shrinking, Taubin 1995; the border stays."""
    mean = mesh.links.mean
    inner = ~mesh.links.is_boundary[:, None]
    vertices = mesh.vertices
    for _ in range(rounds):
        for step in (_SHRINK, _GROW):
            vertices = vertices + step * inner * (mean @ vertices - vertices)
    return vertices


def smoothed_normals(mesh: TriangleMesh, rounds: int) -> FloatArray:
    """Average the vertex normals (n, 3) over their neighbours, some rounds; unit length."""
    mean = mesh.links.mean
    normals = mesh.vertex_normals
    for _ in range(rounds):
        normals = 0.3 * normals + 0.7 * (mean @ normals)
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return normals
