"""Connected pieces of a mesh, and smoothing over neighbouring vertices."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_SHRINK, _GROW = 0.5, -0.52


def pieces(mesh: TriangleMesh) -> tuple[int, IntArray]:
    """Find the connected pieces of a mesh.

    Returns
    -------
    count : int
    piece : (n,) int32
        Index of the piece of each vertex.
    """
    count, piece = scipy.sparse.csgraph.connected_components(mesh.links.adjacency, directed=False)
    return int(count), np.asarray(piece)


def in_large_pieces(mesh: TriangleMesh, least_share: float) -> BoolArray:
    """Find the vertices in connected pieces that hold enough of the triangles.

    Parameters
    ----------
    least_share
        Of all triangles, 0 to 1; a piece needs more than that.

    Returns
    -------
    (n,) bool
    """
    count, piece = pieces(mesh)
    size = np.bincount(piece[mesh.triangles[:, 0]], minlength=count)
    return np.asarray(size[piece] > least_share * len(mesh.triangles))


def relaxed(mesh: TriangleMesh, rounds: int) -> FloatArray:
    """Smooth a mesh without shrinking it (Taubin 1995); boundary vertices stay.

    Parameters
    ----------
    rounds
        Iterations, each a shrinking and an inflating step.

    Returns
    -------
    (n, 3) float64, mm
        The new vertices.
    """
    mean = mesh.links.mean
    inner = ~mesh.links.is_boundary[:, None]
    vertices = mesh.vertices
    for _ in range(rounds):
        for step in (_SHRINK, _GROW):
            vertices = vertices + step * inner * (mean @ vertices - vertices)
    return vertices


def smoothed_normals(mesh: TriangleMesh, rounds: int) -> FloatArray:
    """Average the vertex normals over their neighbours.

    Parameters
    ----------
    rounds
        Iterations; every iteration reaches one ring of neighbours further.

    Returns
    -------
    (n, 3) float64
        Unit normals.
    """
    mean = mesh.links.mean
    normals = mesh.vertex_normals
    for _ in range(rounds):
        normals = 0.3 * normals + 0.7 * (mean @ normals)
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return normals
