"""The triangles of a scan put right: equal vertices merged, spikes drawn back, facing outwards."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from insole_core.formats.texture import mean_colors
from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.lengths import lengths
from insole_core.geometry.mesh import TriangleMesh

_MIX = np.uint64(0x9E3779B97F4A7C15)  # odd and without pattern (Knuth's multiplicative hashing)
_BLOCK = 2**14
_ROUNDS = 2
_LEAST_DEGREE = 4
_LEAST_VERTICES = 1000  # with fewer of them a corner of the form itself may look like a spike
_LEAST_SLENDERNESS = 2.2
"""Height of a spike over the radius of its base: no toe is a cone of less than 50
degrees. The radius counts as the usual length of an edge at least."""
INSIDE_OUT = "The surface was inside out and has been turned."


def merged(mesh: TriangleMesh) -> TriangleMesh:
    """Merge vertices in the same place.

    Their colours are averaged: at the seam of a texture they hardly differ.
    """
    first, kind = _equal_vertices(mesh.vertices)
    if len(first) == len(mesh.vertices):
        return mesh
    colors = None if mesh.colors is None else mean_colors(kind, mesh.colors, len(first))
    return TriangleMesh(mesh.vertices[first], kind[mesh.triangles], colors, mesh.touches)


def first_of_each_place(points: FloatArray) -> IntArray:
    """Return the first (m,) of the points (n, 3) in each place, in their order."""
    return _equal_vertices(points)[0]


def without_flat_triangles(mesh: TriangleMesh) -> TriangleMesh:
    """Drop triangles without area, and vertices without triangle."""
    solid = mesh.triangle_areas_mm2 > 0
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.triangles[solid]] = True
    if solid.all() and used.all():
        return mesh
    return replace(mesh, triangles=mesh.triangles[solid]).part(used)


def without_double_triangles(mesh: TriangleMesh) -> TriangleMesh:
    """Keep the first of the triangles with the same corners, as of a surface with two sides."""
    corners = np.sort(mesh.triangles.astype(np.int64), axis=1)
    count = len(mesh.vertices)  # below 2 million, so that the keys are below 2**63
    keys = (corners[:, 0] * count + corners[:, 1]) * count + corners[:, 2]
    first = np.unique(keys, return_index=True)[1]
    if len(first) == len(keys):
        return mesh
    return replace(mesh, triangles=mesh.triangles[np.sort(first)])


def _equal_vertices(vertices: FloatArray) -> tuple[IntArray, IndexArray]:
    """Return the first vertex of each place, and every vertex's place.

    The vertices are sorted by a hash, which is several times faster than by their coordinates.
    """
    order, is_new = _grouped(vertices)
    first = np.minimum.reduceat(order, np.flatnonzero(is_new))
    rank = np.empty(len(first), dtype=np.int32)
    rank[np.argsort(first)] = np.arange(len(first))
    kind = np.empty(len(order), dtype=np.int32)
    kind[order] = rank[np.cumsum(is_new, dtype=np.int32) - 1]
    return np.sort(first), kind


def _grouped(vertices: FloatArray) -> tuple[IntArray, BoolArray]:
    """Return an order (n,) in which equal vertices follow each other, and where a place begins.

    The index of each vertex takes the place of the lowest bits of its hash, so that plain numbers
    are sorted, which is several times faster than to sort indices. The few places that share the
    bits which are left are sorted by their coordinates.
    """
    bits = np.uint64(len(vertices).bit_length())
    low = (np.uint64(1) << bits) - np.uint64(1)
    keys = _hash(vertices)
    keys &= ~low
    keys |= np.arange(len(vertices), dtype=np.uint64)
    keys.sort()
    order = (keys & low).astype(np.int64)
    keys >>= bits
    is_new = _differs_from_previous(vertices, order)
    mixed = is_new[1:] & (keys[1:] == keys[:-1])
    if mixed.any():
        rows = np.flatnonzero(np.isin(keys, keys[1:][mixed]))
        chosen = vertices[order[rows]]
        order[rows] = order[rows][np.lexsort((*chosen.T, keys[rows]))]
        is_new = _differs_from_previous(vertices, order)
    return order, is_new


def _differs_from_previous(vertices: FloatArray, order: IntArray) -> BoolArray:
    """Return which vertices (n,) in this order differ from the one before; the first does."""
    differs = np.ones(len(order), dtype=bool)
    differs[1:] = False
    for start in range(0, len(order) - 1, _BLOCK):
        rows = np.take(vertices, order[start : start + _BLOCK + 1], axis=0)
        part = differs[start + 1 : start + _BLOCK + 1]
        for column in rows.T:
            part |= column[1:] != column[:-1]
    return differs


def _hash(vertices: FloatArray) -> npt.NDArray[np.uint64]:
    """Mix the coordinates to one number (n,) a vertex; equal ones have equal numbers."""
    total = np.zeros(len(vertices), dtype=np.uint64)
    for start in range(0, len(total), _BLOCK):  # as many as the processor's cache holds
        part = total[start : start + _BLOCK]
        for column in vertices[start : start + _BLOCK].T:
            part ^= (column + 0.0).view(np.uint64)  # + 0.0 makes -0.0 into 0.0
            part *= _MIX
            part ^= part >> np.uint64(29)
    return total


def without_spikes(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """Move the tips of spikes to the middle of their neighbours.

    Returns
    -------
    mesh : TriangleMesh
        With the same triangles.
    moved : int
        Number of vertices.
    """
    moved = np.zeros(len(mesh.vertices), dtype=bool)
    if len(moved) < _LEAST_VERTICES:
        return mesh, 0
    for _ in range(_ROUNDS):
        middle, is_spike = _spikes(mesh)
        if not is_spike.any():
            break
        mesh = replace(mesh, vertices=np.where(is_spike[:, None], middle, mesh.vertices))
        moved |= is_spike
    return mesh, int(moved.sum())


def _spikes(mesh: TriangleMesh) -> tuple[FloatArray, BoolArray]:
    """Return the middle (n, 3) of the neighbours of each spike, and whether it is one (n,).

    Medians, since among the neighbours there may be other spikes. They are only computed where the
    mean of the neighbours is far off, which on most surfaces is nowhere.
    """
    links, vertices = mesh.links, mesh.vertices
    starts, ends = links.edges[0].T
    usual = float(np.median(lengths(vertices[starts] - vertices[ends])))
    off = lengths(links.mean @ vertices - vertices)
    middle, is_spike = vertices.copy(), np.zeros(len(vertices), dtype=bool)
    suspects = np.flatnonzero((off > usual) & ~links.is_boundary)
    if len(suspects) == 0:
        return middle, is_spike
    involved = np.unique(np.concatenate([suspects, links.adjacency[suspects].indices]))
    rows = links.adjacency[involved]
    degree = np.diff(rows.indptr)
    owner = np.repeat(np.arange(len(involved)), degree)
    around = vertices[rows.indices]
    middle[involved] = np.column_stack([_medians(column, owner, degree) for column in around.T])
    radius = np.zeros(len(vertices))
    from_middle = lengths(around - middle[involved][owner])
    radius[involved] = _medians(from_middle, owner, degree)
    height = lengths(vertices - middle)
    typical = np.zeros(len(vertices))
    typical[involved] = _medians(height[rows.indices], owner, degree)
    least = np.maximum(_LEAST_SLENDERNESS * np.maximum(radius, usual), 3 * typical)
    found = suspects[(height > least)[suspects]]
    found = found[degree[np.searchsorted(involved, found)] >= _LEAST_DEGREE]
    is_spike[found] = True
    return middle, is_spike


def _medians(values: FloatArray, owner: IntArray, degree: IntArray) -> FloatArray:
    """Return the lower median (n,) of each owner's values; each has at least one."""
    order = np.lexsort((values, owner))
    firsts = np.cumsum(degree) - degree
    return np.asarray(values[order[firsts + (degree - 1) // 2]])


def faces_outwards(mesh: TriangleMesh) -> bool:
    """Return whether the triangles face outwards on the whole, of an open surface as well.

    By the flux of the vectors from the middle: for a closed surface it is three times the volume,
    wherever the middle lies.
    """
    areas_mm2 = mesh.triangle_areas_mm2
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    middle = areas_mm2 @ centres / mesh.area_mm2
    flux = np.einsum("i,ij,ij->", areas_mm2, mesh.triangle_normals, centres - middle)
    return bool(flux >= 0)
