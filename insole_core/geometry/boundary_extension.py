"""Extend a mesh by one ring of triangles beyond its boundary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.point_tree import point_tree

_EVENING_ROUNDS = 3
_LEAST_DISTANCE = 0.7
"""Least distance of the ring's vertices from all others, as a share of the ring's width."""


@dataclass(frozen=True, eq=False)
class Boundary:
    """The boundary vertices of a mesh and the surface at each of them.

    Parameters
    ----------
    vertices : (n, 3) float64, mm, frame of the mesh
    normals : (n, 3) float64
        Unit normals of the surface.
    outwards : (n, 3) float64
        Unit directions away from the surface, tangential to it.
    """

    vertices: FloatArray
    normals: FloatArray
    outwards: FloatArray


Course: TypeAlias = Callable[[Boundary], tuple[BoolArray, FloatArray]]
"""Return which boundary vertices (n,) to extend, and the curvature of the extension (n,), 1/mm.

Positive curvature bends it away from the normal.
"""


def straight_on(border: Boundary) -> tuple[BoolArray, FloatArray]:
    """Extend every boundary vertex tangentially.

    Returns
    -------
    extended : (n,) bool
    curvature : (n,) float64, 1/mm
        Zero.
    """
    count = len(border.vertices)
    return np.ones(count, dtype=bool), np.zeros(count)


def extend_boundary(
    mesh: TriangleMesh, width_mm: float, course: Course = straight_on
) -> TriangleMesh:
    """Add a ring of triangles along every boundary.

    Nothing is added where boundaries touch each other in one vertex, or where the ring would run
    into the surface on the other side of a narrow gap.

    Parameters
    ----------
    width_mm
        Width of the ring.
    course
        Which boundary vertices to extend and how the extension curves; see `Course`.

    Returns
    -------
    TriangleMesh
        The given vertices first, then those of the ring; without colours.
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
    near, _ = point_tree(mesh.vertices).query(points)
    return np.asarray(near > _LEAST_DISTANCE * width_mm)


def _outwards(mesh: TriangleMesh, ends: IntArray, normals: FloatArray) -> FloatArray:
    """Return directions (n, 3) away from the boundary, tangential and smoothed; 0 elsewhere."""
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
