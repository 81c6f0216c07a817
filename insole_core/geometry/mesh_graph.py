"""Connected pieces of a mesh, and smoothing over neighbouring vertices."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.lengths import directions, lengths
from insole_core.geometry.mesh import TriangleMesh

_SHRINK, _GROW = 0.5, -0.52
_SAMPLES = 1500  # vertices by which the noise is estimated
_LEAST_SAMPLES = 100
_NOISY_MM, _DENSE_MM = 0.15, 4.5
"""Noise from which on a surface is smoothed to be measured, and greatest distance of its vertices
with which noise can be told from shape."""
_SCALE_MM, _ROUNDS = 8.0, (8.0, 40.0)
"""Least wavelength that smoothing keeps, and its iterations, by which that grows with the distance
of the vertices and the fourth root of their number."""


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
        normals = directions(0.3 * normals + 0.7 * (mean @ normals))
    return normals


def noise_mm(mesh: TriangleMesh) -> float:
    """Estimate the standard deviation of the noise of the vertices along the surface's normal.

    A surface bends evenly from a vertex to its neighbours and theirs; what does not is noise.

    Returns
    -------
    float
        0 where the vertices are so far apart that noise cannot be told from shape.
    """
    near = _about_some(mesh)
    if not 0 < _step_mm(near) <= _DENSE_MM:
        return 0.0
    twice: Any = scipy.sparse.csr_array(near.links.laplacian @ near.links.laplacian)
    gain = np.sqrt(np.asarray(twice.multiply(twice).sum(axis=1)).ravel())
    rim = near.links.is_boundary.astype(float)
    inside = (rim + near.links.adjacency @ rim == 0) & (gain > 0)
    if inside.sum() < _LEAST_SAMPLES:
        return 0.0
    bent = np.einsum("nc,nc->n", twice @ near.vertices, near.vertex_normals)[inside]
    return float(1.48 * np.median(np.abs(bent / gain[inside])))


def without_noise(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh smoothed to the scale on which its noise averages out, to be measured.

    A tape and an outermost point pick the noise up. A mesh with little noise, or with contours, is
    returned as it is: a fused surface is smooth already.
    """
    if mesh.touches is not None or noise_mm(mesh) < _NOISY_MM:
        return mesh
    rounds = (_SCALE_MM / (2.2 * _step_mm(_about_some(mesh)))) ** 4
    return mesh.moved(relaxed(mesh, round(float(np.clip(rounds, *_ROUNDS)))))


def _step_mm(mesh: TriangleMesh) -> float:
    """Return the median distance of neighbouring vertices; 0 without triangles."""
    corners = mesh.vertices[mesh.triangles]
    steps_mm = lengths(corners - np.roll(corners, 1, axis=1))
    return float(np.median(steps_mm)) if len(steps_mm) else 0.0


def _about_some(mesh: TriangleMesh) -> TriangleMesh:
    """Return some vertices with their neighbours and theirs, from all over the mesh."""
    count = len(mesh.vertices)
    chosen = np.zeros(count, dtype=bool)
    chosen[np.linspace(0, count - 1, min(count, _SAMPLES)).astype(int)] = True
    for _ in range(2):
        near = chosen[mesh.triangles].any(axis=1)
        chosen[mesh.triangles[near]] = True
    return mesh.part(chosen)
