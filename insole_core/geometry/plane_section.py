"""Intersection of a mesh with a plane."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh


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
