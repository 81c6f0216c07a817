"""Connectivity of a triangle mesh, independent of vertex positions."""

from __future__ import annotations

from functools import cached_property
from typing import TypeAlias

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, IndexArray, IntArray

_Matrix: TypeAlias = "scipy.sparse.csr_array[np.float64]"


class MeshTopology:
    """Edges and neighbours; shared by all meshes that differ only in vertex positions.

    Parameters
    ----------
    triangles : (m, 3) int32
    count
        Number of vertices, n.
    """

    def __init__(self, triangles: IndexArray, count: int) -> None:
        self._triangles = triangles
        self._count = count

    @cached_property
    def corners(self) -> _Matrix:
        """(n, m) with a 1 where a vertex is a corner of a triangle."""
        corner = self._triangles.ravel()
        first = np.arange(0, len(corner) + 1, 3, dtype=corner.dtype)
        shape = (self._count, len(self._triangles))
        # By columns they are there already: nothing to sort.
        by_triangle = scipy.sparse.csc_array((np.ones(len(corner)), corner, first), shape)
        return scipy.sparse.csr_array(by_triangle)

    @cached_property
    def _sides(self) -> _Matrix:
        """(n, n) number of triangles that traverse the edge from one vertex to another."""
        start = self._triangles.ravel()
        end = self._triangles[:, [1, 2, 0]].ravel()
        shape = (self._count, self._count)
        return scipy.sparse.csr_array((np.ones(len(start)), (start, end)), shape)

    @cached_property
    def _both_ways(self) -> _Matrix:
        return scipy.sparse.csr_array(self._sides + self._sides.T)

    @cached_property
    def edges(self) -> tuple[IntArray, IntArray]:
        """Every edge once, and the number of its triangles.

        Returns
        -------
        edges : (k, 2) int64
            Lower vertex index first, in ascending order.
        sharing : (k,) int64
            Number of triangles with this edge.
        """
        start, end = _entries(self._both_ways)
        once = start < end
        sharing = self._both_ways.data[once].astype(np.int64)
        return np.stack([start[once], end[once]], axis=1), sharing

    @cached_property
    def ends(self) -> IntArray:
        """(k, 2) directed boundary edges: those that no triangle traverses in reverse."""
        sides = self._sides.copy()
        sides.data[:] = 1
        apart = scipy.sparse.csr_array(sides - sides.T)
        return np.stack(_entries(apart), axis=1)[apart.data > 0]

    @cached_property
    def adjacency(self) -> _Matrix:
        """(n, n) symmetric, with a 1 for every edge."""
        links = self._both_ways.copy()
        links.data[:] = 1
        return links

    @cached_property
    def is_boundary(self) -> BoolArray:
        """(n,) whether a vertex lies on an edge with only one triangle."""
        border = np.zeros(self._count, dtype=bool)
        border[_entries(self._both_ways)[0][self._both_ways.data == 1]] = True
        return border

    @cached_property
    def mean(self) -> _Matrix:
        """(n, n) averages over the neighbours; a zero row for a vertex without any."""
        mean = self.adjacency.copy()
        degree = np.diff(mean.indptr)
        mean.data /= np.repeat(degree, degree)
        return mean

    @cached_property
    def laplacian(self) -> _Matrix:
        """(n, n) uniform Laplacian: mean of the neighbours minus the vertex itself."""
        return scipy.sparse.csr_array(self.mean - scipy.sparse.eye_array(self._count, format="csr"))


def _entries(matrix: _Matrix) -> tuple[IntArray, IntArray]:
    """Return row and column of the stored entries of a matrix, in storage order."""
    rows = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    return rows, matrix.indices.astype(np.int64)
