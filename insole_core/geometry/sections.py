"""Cuts of a mesh: by a plane, along a level of a field, and lines of equal height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh, numbered_edges


def section_segments(mesh: TriangleMesh, origin: FloatArray, normal: FloatArray) -> FloatArray:
    """Cut a mesh with a plane.

    Parameters
    ----------
    origin : (3,) float64, mm, frame of the mesh
        A point of the plane.
    normal : (3,) float64, frame of the mesh
        Normal of the plane, of any length.

    Returns
    -------
    (k, 2, 3) float64, mm, frame of the mesh
        Start and end of one segment for each triangle that crosses the plane, in no particular
        order, counter-clockwise round the inside as seen from the side to which the normal points.
    """
    height = (mesh.vertices - origin) @ normal
    return _segments(mesh.vertices, height, mesh.triangles)


class ParallelSections:
    """Sections of a mesh by parallel planes, each in a fraction of the time of a single one.

    Parameters
    ----------
    normal : (3,) float64, frame of the mesh
        Normal of the planes, of any length.
    """

    def __init__(self, mesh: TriangleMesh, normal: FloatArray) -> None:
        self._vertices, self._triangles, self._normal = mesh.vertices, mesh.triangles, normal
        self._height = mesh.vertices @ normal
        corners = self._height[mesh.triangles]
        self._lowest, self._highest = corners.min(axis=1), corners.max(axis=1)

    def through(self, origin: FloatArray) -> FloatArray:
        """Return the section (k, 2, 3) through a point (3,), as `section_segments` does."""
        level = float(origin @ self._normal)
        reached = (self._lowest <= level) & (self._highest >= level)
        return _segments(self._vertices, self._height - level, self._triangles[reached])


def _segments(vertices: FloatArray, height: FloatArray, triangles: IndexArray) -> FloatArray:
    """Return the segments (k, 2, 3) in which triangles cross height (n,) zero."""
    above = height >= 0
    count = above[triangles].sum(axis=1)
    cut = triangles[(count == 1) | (count == 2)]
    # The corner that is alone on its side comes first: both edges that are cut start there.
    lonely = above[cut].sum(axis=1) == 1
    alone = np.where(lonely[:, None], above[cut], ~above[cut]).argmax(axis=1)
    corner = cut[np.arange(len(cut))[:, None], (alone[:, None] + np.arange(3)) % 3]
    first, others = corner[:, :1], np.where(lonely[:, None], corner[:, 1:], corner[:, :0:-1])
    share = height[first] / (height[first] - height[others])
    start, end = vertices[first], vertices[others]
    return np.asarray(start + share[..., None] * (end - start))


def boundary_crossings(mesh: TriangleMesh, origin: FloatArray, normal: FloatArray) -> FloatArray:
    """Find where the boundary of an open mesh crosses a plane: the ends of its section.

    Parameters
    ----------
    origin, normal : (3,) float64
        As of `section_segments`.

    Returns
    -------
    (k, 3) float64, mm, frame of the mesh
    """
    edges, sharing = mesh.links.edges
    start, end = np.moveaxis(mesh.vertices[edges[sharing == 1]], 1, 0)
    from_start, from_end = (start - origin) @ normal, (end - origin) @ normal
    cut = (from_start >= 0) != (from_end >= 0)
    share = from_start[cut] / (from_start[cut] - from_end[cut])
    return np.asarray(start[cut] + share[:, None] * (end - start)[cut])


@dataclass(frozen=True, eq=False)
class _LevelCut:
    """The part of a mesh where a field is not negative.

    Parameters
    ----------
    triangles : (m, 3) int32
        Indices of the mesh's own vertices, continued by those of the cut.
    source : (m,) int64
        Triangle of the mesh that each is part of.
    ends : (k, 2) int64
        Edge of the mesh on which each vertex of the cut lies.
    share : (k,) float64
        Where on the edge, 0 to 1.
    """

    triangles: IndexArray
    source: IntArray
    ends: IntArray
    share: FloatArray

    def extended(self, values: FloatArray) -> FloatArray:
        """Continue values (n, ...) at the mesh's vertices by those at the vertices of the cut."""
        start, end = values[self.ends[:, 0]], values[self.ends[:, 1]]
        share = self.share.reshape(-1, *[1] * (values.ndim - 1))
        return np.concatenate([values, start + share * (end - start)])


def level_cut(mesh: TriangleMesh, field: FloatArray) -> _LevelCut:
    """Keep the part of a mesh where a field (n,) is not negative."""
    kept = field >= 0
    count = kept[mesh.triangles].sum(axis=1)
    whole, one, two = (np.flatnonzero(count == number) for number in (3, 1, 2))
    # The corner that is alone on its side comes first: both edges that are cut start there.
    alone = np.concatenate([kept[mesh.triangles[one]], ~kept[mesh.triangles[two]]]).argmax(axis=1)
    cut = mesh.triangles[np.concatenate([one, two])].astype(np.int64)
    corner = cut[np.arange(len(cut))[:, None], (alone[:, None] + np.arange(3)) % 3]
    edges = np.sort(corner[:, [[0, 1], [0, 2]]], axis=-1).reshape(-1, 2)
    ends, number = numbered_edges(edges, len(mesh.vertices))
    first, second = (number.reshape(-1, 2) + len(mesh.vertices)).T
    tips, bases = slice(0, len(one)), slice(len(one), None)
    triangles = np.concatenate(
        [
            mesh.triangles[whole],
            np.stack([corner[tips, 0], first[tips], second[tips]], axis=1),
            np.stack([first[bases], corner[bases, 1], corner[bases, 2]], axis=1),
            np.stack([first[bases], corner[bases, 2], second[bases]], axis=1),
        ]
    )
    from_start, from_end = field[ends].T
    return _LevelCut(
        triangles.astype(np.int32),
        np.concatenate([whole, one, two, two]),
        ends,
        from_start / (from_start - from_end),
    )


def cut_off(mesh: TriangleMesh, field: FloatArray) -> TriangleMesh:
    """Return the part of a mesh where a field (n,) is not negative, cut along its zero level."""
    cut = level_cut(mesh, field)
    vertices = cut.extended(mesh.vertices)
    colors = (
        None if mesh.colors is None else cut.extended(mesh.colors.astype(float)).astype(np.uint8)
    )
    used = np.zeros(len(vertices), dtype=bool)
    used[cut.triangles] = True
    return TriangleMesh(vertices, cut.triangles, colors).part(used)


@dataclass(frozen=True, eq=False)
class _LevelLines:
    """Segments of the lines of equal height, in no particular order.

    Parameters
    ----------
    segments : (k, 2, 3) float64, mm, frame of the mesh
    number : (k,) int64
        Level of each segment, in steps.
    triangle : (k,) int64
        Triangle that it crosses.
    """

    segments: FloatArray
    number: IntArray
    triangle: IntArray


def level_lines(vertices: FloatArray, triangles: IndexArray, step_mm: float) -> _LevelLines:
    """Find where a mesh has a height (z) that is a multiple of a step.

    Parameters
    ----------
    vertices : (n, 3) float64, mm
    triangles : (m, 3) int32
    step_mm
        Distance of the levels.

    Returns
    -------
    LevelLines
        In the frame of the vertices.
    """
    corners = vertices[triangles]
    order = corners[..., 2].argsort(axis=1)
    low, middle, high = np.moveaxis(np.take_along_axis(corners, order[..., None], axis=1), 1, 0)
    first = np.floor(low[:, 2] / step_mm).astype(np.int64) + 1
    count = np.floor(high[:, 2] / step_mm).astype(np.int64) - first + 1
    triangle = np.repeat(np.arange(len(triangles)), count)
    number = np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count) + first[triangle]
    level = number * step_mm
    low, middle, high = low[triangle], middle[triangle], high[triangle]
    is_lower = (level < middle[:, 2])[:, None]
    start = _at_level(low, high, level)
    end = _at_level(np.where(is_lower, low, middle), np.where(is_lower, middle, high), level)
    return _LevelLines(np.stack([start, end], axis=1), number, triangle)


def _at_level(low: FloatArray, high: FloatArray, level: FloatArray) -> FloatArray:
    """Return the points (k, 3) at a height on edges that reach it; the upper end of level ones."""
    rise = high[:, 2] - low[:, 2]
    share = np.divide(level - low[:, 2], rise, out=np.ones_like(rise), where=rise > 0)
    return np.asarray(low + share[:, None] * (high - low))
