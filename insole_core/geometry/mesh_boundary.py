"""The boundary of an open mesh: narrow gaps closed, and one ring of triangles added beyond it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from math import atan2, radians, sqrt, tau
from typing import TypeAlias

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.lengths import directions
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.point_tree import point_tree

_NORMAL_ROUNDS = 3
_MOST_RAD = radians(150.0)
"""Greatest angle of the gap at a vertex: what is flatter is a boundary, and no gap."""
_LEAST_COSINE = 0.3
"""Least cosine between a triangle and the surface at its corners: opposite walls stay apart."""
_ANGLE_SHARE = 0.3
"""Weight of the length alone against that of length times angle, in the order of the ears."""
_Point: TypeAlias = tuple[float, float, float]
_Ear: TypeAlias = tuple[float, int, int, int]
"""Rank, then the vertex at the tip, its predecessor and its successor on the boundary."""
_EVENING_ROUNDS = 3
_LEAST_DISTANCE = 0.7
"""Least distance of the ring's vertices from all others, as a share of the ring's width."""


def gap_triangles(mesh: TriangleMesh, width_mm: FloatArray) -> IndexArray:
    """Triangulate the narrow gaps of an open mesh, without new vertices.

    Gaps are left open between surfaces that face each other, and at vertices in which boundaries
    touch. The time grows with the length of the boundary.

    Parameters
    ----------
    width_mm : (n,) float64
        Greatest width of a gap to be closed, at each vertex of the mesh.

    Returns
    -------
    (k, 3) int32
        Triangles between boundary vertices, oriented like the surface.
    """
    return _Zip(mesh, width_mm).close()


class _Zip:
    """The boundary of a mesh while its gaps are being closed.

    Plain floats and lists: one ear depends on the one before, and numpy is slow on single values.
    """

    def __init__(self, mesh: TriangleMesh, width_mm: FloatArray) -> None:
        ends, count = mesh.links.ends, len(mesh.vertices)
        starts, stops = (np.bincount(ends[:, end], minlength=count) for end in (0, 1))
        ends = ends[((starts == 1) & (stops == 1))[ends].all(axis=1)]
        at, number = np.unique(ends, return_inverse=True)
        self._vertex = at
        self._after = [-1] * len(at)
        self._before = [-1] * len(at)
        for start, stop in number.reshape(-1, 2).tolist():
            self._after[start], self._before[stop] = stop, start
        self._points: list[_Point] = [(x, y, z) for x, y, z in mesh.vertices[at].tolist()]
        normals = smoothed_normals(mesh, _NORMAL_ROUNDS)[at].tolist() if len(at) else []
        self._normals: list[_Point] = [(x, y, z) for x, y, z in normals]
        self._width_mm: list[float] = width_mm[at].tolist()
        edges = mesh.links.edges[0]
        place = np.full(count, -1)
        place[at] = np.arange(len(at))
        near = place[edges[(place[edges] >= 0).all(axis=1)]]
        self._edges = {(low, high) for low, high in near.tolist()}
        """Edges between boundary vertices, lower vertex first: none gets a third triangle."""

    def close(self) -> IndexArray:
        """Cut off ears until none is left; return them as triangles (k, 3)."""
        ears = [ear for tip in range(len(self._points)) if (ear := self._ear(tip)) is not None]
        heapify(ears)
        triangles: list[tuple[int, int, int]] = []
        while ears:
            _, tip, before, after = heappop(ears)
            if self._before[tip] != before or self._after[tip] != after:
                continue  # changed by a neighbouring ear
            triangles.append((before, after, tip))
            for vertex in self._cut(tip, before, after):
                ear = self._ear(vertex)
                if ear is not None:
                    heappush(ears, ear)
        return self._vertex[np.array(triangles, dtype=np.int64).reshape(-1, 3)].astype(np.int32)

    def _cut(self, tip: int, before: int, after: int) -> tuple[int, ...]:
        """Take a vertex off the boundary; return the vertices whose gap has changed."""
        self._before[tip] = self._after[tip] = -1
        if self._after[after] == before:  # the last triangle of a hole
            for vertex in (before, after):
                self._before[vertex] = self._after[vertex] = -1
            return ()
        self._edges.add((min(before, after), max(before, after)))
        self._after[before], self._before[after] = after, before
        return before, after

    def _ear(self, tip: int) -> _Ear | None:
        """Return the ear at a vertex; None where there is no narrow gap."""
        before, after = self._before[tip], self._after[tip]
        if before < 0 or after < 0 or before == after:
            return None
        closes = self._after[after] == before
        if not closes and (min(before, after), max(before, after)) in self._edges:
            return None
        point, start, stop = self._points[tip], self._points[before], self._points[after]
        length_mm = _length(_minus(stop, start))
        if length_mm > min(self._width_mm[before], self._width_mm[after]):
            return None
        backward, forward = _minus(start, point), _minus(stop, point)
        cross = _cross(backward, forward)
        angle = atan2(_dot(self._normals[tip], cross), _dot(backward, forward)) % tau
        least = _LEAST_COSINE * _length(cross)
        if angle > _MOST_RAD or least == 0.0:
            return None
        if any(_dot(self._normals[vertex], cross) < least for vertex in (tip, before, after)):
            return None
        return length_mm * (_ANGLE_SHARE + angle), tip, before, after


def _minus(a: _Point, b: _Point) -> _Point:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: _Point, b: _Point) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: _Point, b: _Point) -> _Point:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _length(a: _Point) -> float:
    return sqrt(_dot(a, a))


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


_Course: TypeAlias = Callable[[Boundary], tuple[BoolArray, FloatArray]]
"""Return which boundary vertices (n,) to extend, and the curvature of the extension (n,), 1/mm.

Positive curvature bends it away from the normal.
"""


def _straight_on(border: Boundary) -> tuple[BoolArray, FloatArray]:
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
    mesh: TriangleMesh, width_mm: float, course: _Course = _straight_on
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
        np.add.at(total, end, directions(aside))
    total = directions(total)
    for _ in range(_EVENING_ROUNDS):
        sums = total.copy()
        np.add.at(sums, a, total[b])
        np.add.at(sums, b, total[a])
        total = directions(sums)
    outwards = np.zeros_like(mesh.vertices)
    outwards[border] = total
    return outwards
