"""The shortest way along a surface between two of its points, as a tape is laid on it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree

_PITCH_MM = 1.0
"""Between points of a way at most: a chord of this length is as long as its arc on a foot."""
_FIRST_POINTS = 9
_STEPS, _PULL = 40, 8.0
"""How often a way is pulled tight with each number of points, and how much at once."""
_FACES = 12
"""Nearest triangles, by their centres, among which is the one on which a point comes to lie."""
_AWAY = -0.3
"""Cosine of the angle to the sides of both ends, below which a triangle is the back of a shell."""
_LIKELY = 1.6
"""A way is rarely longer than this, relative to the straight one; others are looked for later."""


def shortest_path(mesh: TriangleMesh, start: FloatArray, end: FloatArray) -> FloatArray | None:
    """Return the shortest way along a surface, found from the shortest one along its edges.

    A way between two places of the same side stays on it, where it can: what is pulled tight over
    the arch of a thin shell would else come to lie on its back.

    Parameters
    ----------
    mesh : mm
    start, end : (3,) float64, mm
        On the surface.

    Returns
    -------
    (n, 3) float64, mm, or None
        Points of the way, at most 1 mm apart, from start to end; None if the two lie on parts that
        do not hang together.
    """
    if np.array_equal(start, end):
        return np.stack([start, end])
    for part in (_same_side(mesh, start, end), mesh):
        rough = _along_edges(part, start, end)
        if rough is not None:
            return _shortened(_Surface(part), rough)
    return None


def _same_side(mesh: TriangleMesh, start: FloatArray, end: FloatArray) -> TriangleMesh:
    """Return the mesh without what faces away from both ends; the whole if they face apart."""
    first, last = mesh.vertex_normals[_nearest_corners(mesh, start, end)]
    side = (first + last) / 2
    if first @ last < 0:
        return mesh
    is_seen = mesh.triangle_normals @ side > _AWAY * np.linalg.norm(side)
    return replace(mesh, triangles=mesh.triangles[is_seen])


def _shortened(surface: _Surface, rough: FloatArray) -> FloatArray:
    """Return the shortest way near a rough one, its points at most 1 mm apart."""
    count = _FIRST_POINTS
    way = resampled(rough, count)
    while True:
        way = _pulled_tight(surface, way)
        if path_length_mm(way) <= _PITCH_MM * (count - 1):
            return way
        count = 2 * count - 1
        way = surface.nearest(resampled(way, count))


def path_length_mm(path: FloatArray) -> float:
    """Return the length of a polyline (n, 3), mm."""
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


class _Surface:
    """Brings points to the nearest place of a surface."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._corners = mesh.vertices[mesh.triangles]
        self._centres = point_tree(self._corners.mean(axis=1))

    def nearest(self, points: FloatArray) -> FloatArray:
        """Return the points of the surface (n, 3) nearest to given ones; both ends stay."""
        inner = points[1:-1]
        few = min(_FACES, self._centres.n)
        number = np.asarray(self._centres.query(inner, k=few)[1]).reshape(len(inner), few)
        found = _nearest_in(self._corners[number], inner)
        best = ((found - inner[:, None]) ** 2).sum(axis=2).argmin(axis=1)
        return np.concatenate([points[:1], found[np.arange(len(inner)), best], points[-1:]])


def _nearest_in(triangles: FloatArray, points: FloatArray) -> FloatArray:
    """Return the points (n, k, 3) of triangles (n, k, 3, 3) nearest to points (n, 3)."""
    from trimesh.triangles import closest_point

    each = np.repeat(points, triangles.shape[1], axis=0)
    found = closest_point(triangles.reshape(-1, 3, 3), each)
    return np.asarray(found).reshape(triangles.shape[:3])


def _pulled_tight(surface: _Surface, way: FloatArray) -> FloatArray:
    """Shorten a way whose ends stay: pull its points towards each other, and back to the surface.

    An implicit step of the flow by which a curve on a surface becomes shortest.
    """
    bands = np.full((3, len(way)), -_PULL)
    bands[1] = 1 + 2 * _PULL
    bands[1, [0, -1]], bands[0, 1], bands[2, -2] = 1.0, 0.0, 0.0
    for _ in range(_STEPS):
        way = surface.nearest(scipy.linalg.solve_banded((1, 1), bands, way))
    return way


def resampled(way: FloatArray, count: int) -> FloatArray:
    """Return a number of points at equal distances along a polyline (n, d), mm."""
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    stops = np.linspace(0.0, at[-1], count)
    return np.stack([np.interp(stops, at, axis) for axis in way.T], axis=1)


def _along_edges(mesh: TriangleMesh, start: FloatArray, end: FloatArray) -> FloatArray | None:
    """Return the shortest way along edges, between the corners nearest to start and end."""
    first, last = _nearest_corners(mesh, start, end)
    a, b = mesh.links.edges[0].T
    lengths = np.linalg.norm(mesh.vertices[a] - mesh.vertices[b], axis=1)
    shape = (len(mesh.vertices),) * 2
    graph = scipy.sparse.csr_array((lengths, (a, b)), shape=shape)
    straight_mm = float(np.linalg.norm(mesh.vertices[first] - mesh.vertices[last]))
    for limit in (_LIKELY * straight_mm, np.inf):
        away, before = scipy.sparse.csgraph.dijkstra(
            graph, directed=False, indices=[first], return_predecessors=True, limit=limit
        )
        if np.isfinite(away[0, last]):
            between = mesh.vertices[_steps(before[0], first, last)]
            return np.concatenate([start[None], between, end[None]])
    return None


def _nearest_corners(mesh: TriangleMesh, *places: FloatArray) -> list[int]:
    """Return the numbers of the corners nearest to places."""
    return [int(((mesh.vertices - place) ** 2).sum(axis=1).argmin()) for place in places]


def _steps(before: IntArray, first: int, last: int) -> list[int]:
    """Return the numbers of the corners from the first to the last, given that before each."""
    way = [last]
    while way[-1] != first:
        way.append(int(before[way[-1]]))
    return way[::-1]
