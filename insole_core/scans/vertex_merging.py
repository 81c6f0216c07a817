"""Merge the equal vertices of a surface; every format but PLY and OBJ repeats them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.scans.texture import mean_colors

_MIX = np.uint64(0x9E3779B97F4A7C15)  # odd and without pattern (Knuth's multiplicative hashing)


def merged(mesh: TriangleMesh) -> TriangleMesh:
    """Merge vertices in the same place.

    Their colours are averaged: at the seam of a texture they hardly differ.
    """
    first, kind = _equal_vertices(mesh.vertices)
    if len(first) == len(mesh.vertices):
        return mesh
    colors = None if mesh.colors is None else mean_colors(kind, mesh.colors, len(first))
    return TriangleMesh(mesh.vertices[first], kind[mesh.triangles], colors, mesh.touches)


def without_flat_triangles(mesh: TriangleMesh) -> TriangleMesh:
    """Drop triangles without area, and vertices without triangle."""
    solid = mesh.triangle_areas_mm2 > 0
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.triangles[solid]] = True
    if solid.all() and used.all():
        return mesh
    return replace(mesh, triangles=mesh.triangles[solid]).part(used)


def _equal_vertices(vertices: FloatArray) -> tuple[IntArray, IndexArray]:
    """Return the first vertex of each place, and every vertex's place.

    The vertices are sorted by a hash, which is several times faster than by their coordinates.
    """
    order = _ordered(_hash(vertices))
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = False
    for column in vertices.T:
        is_new[1:] |= np.diff(column[order]) != 0
    first = np.minimum.reduceat(order, np.flatnonzero(is_new))
    rank = np.empty(len(first), dtype=np.int32)
    rank[np.argsort(first)] = np.arange(len(first))
    kind = np.empty(len(order), dtype=np.int32)
    kind[order] = rank[np.cumsum(is_new) - 1]
    return np.sort(first), kind


def _ordered(hashes: npt.NDArray[np.uint64]) -> IntArray:
    """Return the order (n,) in which equal hashes follow each other.

    The index of each takes the place of its lowest bits, so that plain numbers are sorted, which is
    several times faster than to sort indices. Hashes that differ in these bits only are put right.
    """
    bits = np.uint64(len(hashes).bit_length())
    low = (np.uint64(1) << bits) - np.uint64(1)
    keys = np.sort((hashes & ~low) | np.arange(len(hashes), dtype=np.uint64))
    order = (keys & low).astype(np.int64)
    high, in_order = keys >> bits, hashes[order]
    mixed = (high[1:] == high[:-1]) & (in_order[1:] != in_order[:-1])
    if mixed.any():
        rows = np.flatnonzero(np.isin(high, high[1:][mixed]))
        order[rows] = order[rows][np.argsort(in_order[rows], kind="stable")]
    return order


def _hash(vertices: FloatArray) -> npt.NDArray[np.uint64]:
    """Mix the coordinates to one number (n,) a vertex; equal ones have equal numbers."""
    total = np.zeros(len(vertices), dtype=np.uint64)
    for column in vertices.T:
        bits = (column + 0.0).view(np.uint64)  # + 0.0 makes -0.0 into 0.0
        total = (total ^ bits) * _MIX
        total ^= total >> np.uint64(29)
    return total
