"""A mesh grown by one ring of triangles beyond its border."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals

_EVENING_ROUNDS = 3
_LEAST_DISTANCE = 0.7
"""Share of the ring's width that its vertices keep from all others."""


@dataclass(frozen=True, eq=False)
class Boundary:
    """What a border is like.

    Parameters
    ----------
    vertices, normals, outwards : (n, 3) float64
        Those that lie on it, with the normals of the surface and the ways off its border.
    """

    vertices: FloatArray
    normals: FloatArray
    outwards: FloatArray


Course: TypeAlias = Callable[[Boundary], tuple[BoolArray, FloatArray]]
"""Tells which vertices (n,) of a border go on, and how far they bend off the normal (n,), 1/mm."""


def straight_on(border: Boundary) -> tuple[BoolArray, FloatArray]:
    """Let the whole border go on tangentially."""
    count = len(border.vertices)
    return np.ones(count, dtype=bool), np.zeros(count)


def extend_boundary(
    mesh: TriangleMesh, width_mm: float, course: Course = straight_on
) -> TriangleMesh:
    """Add a ring of triangles along every border.

    Nothing is added where borders touch each other in one vertex, or where the ring would run
    into the surface on the other side of a narrow gap.

    Parameters
    ----------
    mesh
    width_mm
        Of the ring.
    course
        How it leaves the border.

    Returns
    -------
    The given vertices first, without colours.
    """
    count = len(mesh.vertices)
    ends = mesh.links.ends
    free = np.bincount(ends.ravel(), minlength=count) == 2
    normals = smoothed_normals(mesh, _EVENING_ROUNDS)
    outwards = _outwards(mesh, ends, normals)
    ring = mesh.vertices.copy()
    at = np.flatnonzero(free)
    free[at], curvature = course(Boundary(ring[at], normals[at], outwards[at]))
    turn = (width_mm * curvature / 2)[:, None]
    ring[at] += width_mm * (np.cos(turn) * outwards[at] - np.sin(turn) * normals[at])
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


def _outwards(mesh: TriangleMesh, ends: IntArray, normals: FloatArray) -> FloatArray:
    """Directions (n, 3) off the border in the surface, evened along it; 0 away from it."""
    border, number = np.unique(ends, return_inverse=True)
    places, normals = mesh.vertices[border], normals[border]
    a, b = number.reshape(-1, 2).T
    aside = np.cross(places[b] - places[a], normals[a] + normals[b])
    total = np.zeros_like(places)
    for end in (a, b):
        np.add.at(total, end, _unit(aside))
    total = _unit(total)
    for _ in range(_EVENING_ROUNDS):
        sums = total.copy()
        np.add.at(sums, a, total[b])
        np.add.at(sums, b, total[a])
        total = _unit(sums)
    outwards = np.zeros_like(mesh.vertices)
    outwards[border] = total
    return outwards


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(length, 1e-12))
