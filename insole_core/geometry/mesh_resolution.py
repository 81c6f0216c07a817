"""Meshes finer or coarser: subdivided along the smooth surface, or thinned out by clusters."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh, numbered_edges


def thinned(mesh: TriangleMesh, pitch_mm: float) -> TriangleMesh:
    """Replace the vertices of each patch within a cube by their mean.

    Parameters
    ----------
    pitch_mm
        Edge of the cubes. On a surface that bends with the radius r the new one lies about
        pitch² / 12 r deeper.

    Returns
    -------
    TriangleMesh
        Of the vertices whose patches have neighbours; colours are averaged.
    """
    count, patch = _patches(mesh, pitch_mm)
    size = np.bincount(patch, minlength=count)[:, None]
    colors = None if mesh.colors is None else _sums(mesh.colors, patch, count) / size
    used, triangles = np.unique(_between_patches(patch[mesh.triangles]), return_inverse=True)
    return TriangleMesh(
        (_sums(mesh.vertices, patch, count) / size)[used],
        triangles.reshape(-1, 3).astype(np.int32),
        None if colors is None else np.rint(colors[used]).astype(np.uint8),
        mesh.touches,
    )


def _patches(mesh: TriangleMesh, pitch_mm: float) -> tuple[int, IntArray]:
    """Return the number of patches and the patch (n,) of each vertex."""
    cube = ((mesh.vertices - mesh.vertices.min(axis=0)) / pitch_mm).astype(np.int64)
    reach = cube.max(axis=0) + 1
    key = (cube[:, 0] * reach[1] + cube[:, 1]) * reach[2] + cube[:, 2]
    starts, ends = _links_within(mesh.triangles, key)
    links = (np.ones(len(starts), dtype=np.int8), (starts, ends))
    graph = scipy.sparse.coo_array(links, shape=(len(key), len(key)))
    count, patch = scipy.sparse.csgraph.connected_components(graph, directed=False)
    return int(count), np.asarray(patch)


def _links_within(triangles: IndexArray, key: IntArray) -> tuple[IndexArray, IndexArray]:
    """Return both ends (k,) of edges within a cube; two of a triangle link its three corners."""
    a, b, c = (np.ascontiguousarray(column) for column in triangles.T)
    key_a, key_b, key_c = key[a], key[b], key[c]
    ab, bc = key_a == key_b, key_b == key_c
    ca = (key_c == key_a) & ~ab
    return np.concatenate([a[ab], b[bc], c[ca]]), np.concatenate([b[ab], c[bc], a[ca]])


def _between_patches(triangles: IntArray) -> IntArray:
    """Keep each triangle of three different patches once, and none whose back is there too.

    A patch with only two neighbours would become a flap of two triangles, back to back.
    """
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    corners = np.sort(triangles, axis=1)
    order = np.lexsort(corners.T)
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (corners[order[1:]] != corners[order[:-1]]).any(axis=1)
    group = np.empty(len(order), dtype=np.int64)
    group[order] = np.cumsum(is_new) - 1
    turning = np.bincount(group, _turns(triangles))
    keep = order[is_new][turning != 0]
    return np.asarray(triangles[np.sort(keep)])


def _turns(triangles: IntArray) -> FloatArray:
    """Tell triangles (m, 3) with ascending corners, cyclically, (+1) from descending ones (-1)."""
    a, b, c = triangles.T
    ascending = ((a < b) & (b < c)) | ((b < c) & (c < a)) | ((c < a) & (a < b))
    return np.where(ascending, 1.0, -1.0)


def _sums(values: FloatArray | ByteArray, patch: IntArray, count: int) -> FloatArray:
    return np.column_stack([np.bincount(patch, column, count) for column in values.T])


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
    count = len(mesh.vertices)
    ends, middle = numbered_edges(np.sort(sides, axis=2).reshape(-1, 2), count)
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
