"""Thin out a mesh that is finer than its use needs, by clustering its vertices.

Vertex clustering (Rossignac and Borrel 1993) takes two passes over the vertices, where edge
collapse takes a priority queue: three million triangles in a second instead of seven. A cluster
here is a connected patch of the surface within a cube, so that two toes which nearly touch are
not welded together.
"""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh


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
