"""Triangle mesh as an immutable value, with its connectivity and its contour constraints."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np
import scipy

from insole_core.geometry.arrays import (
    BoolArray,
    ByteArray,
    FloatArray,
    IndexArray,
    IntArray,
)
from insole_core.geometry.lengths import lengths
from insole_core.geometry.transforms import MIRROR, transform

_Matrix: TypeAlias = "scipy.sparse.csr_array[np.float64]"
PLY_ELEMENT = "touch"
"""Name of the PLY element that holds the constraints, beside vertices and faces."""


class _MeshTopology:
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


def numbered_edges(ends: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Find the different edges among those given, which may come several times.

    Parameters
    ----------
    ends : (n, 2) int
        Vertices of each edge, in an order that is the same whenever it comes.
    count
        Number of vertices.

    Returns
    -------
    edges : (k, 2) int64
        Every edge once, in ascending order.
    number : (n,) int64
        Which of them each given edge is.
    """
    # By one number each: rows are compared byte by byte, which takes four times as long.
    keys = ends[:, 0].astype(np.int64) * count + ends[:, 1]
    found, number = np.unique(keys, return_inverse=True)
    return np.stack(np.divmod(found, count), axis=1), number


@dataclass(frozen=True, eq=False)
class ContourConstraints:
    """Planes through lines of sight that are tangent to the surface.

    Across the plane a picture locates the surface to a fraction of a pixel; the position of the
    point of contact along the line of sight is known no better than the surface itself.

    Parameters
    ----------
    points : (k, 3) float64, mm
        Approximate points of contact.
    normals : (k, 3) float64
        Unit normals of the planes, away from the surface.
    """

    points: FloatArray
    normals: FloatArray

    def transformed(self, a2b: FloatArray) -> ContourConstraints:
        """Return the constraints in frame b, given a rigid transform (4, 4) from their frame a."""
        return ContourConstraints(
            transform(a2b, self.points), np.asarray(self.normals @ a2b[:3, :3].T)
        )

    def scaled(self, factor: float) -> ContourConstraints:
        """Return the constraints with their points multiplied by `factor`, to change the unit."""
        return ContourConstraints(self.points * factor, self.normals)

    def mirrored(self) -> ContourConstraints:
        """Return the mirror image in x: of what is seen from the other side, as surely."""
        return ContourConstraints(self.points * MIRROR, self.normals * MIRROR)


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """Vertices, triangles, and optionally a colour for every vertex.

    Parameters
    ----------
    vertices : (n, 3) float64, mm
    triangles : (m, 3) int32
        Vertex indices, counter-clockwise seen from outside.
    colors : (n, 3) uint8, optional
        RGB.
    touches : optional
        Constraints from the outlines of the surface in pictures.
    """

    vertices: FloatArray
    triangles: IndexArray
    colors: ByteArray | None = None
    touches: ContourConstraints | None = None

    @cached_property
    def links(self) -> _MeshTopology:
        """Connectivity of the vertices, shared by meshes that differ only in vertex positions."""
        return _MeshTopology(self.triangles, len(self.vertices))

    @cached_property
    def triangle_normals(self) -> FloatArray:
        """(m, 3) unit normals; zero for a triangle without area."""
        return _unit(self._triangle_cross)

    @cached_property
    def triangle_areas_mm2(self) -> FloatArray:
        """(m,) areas."""
        return np.asarray(lengths(self._triangle_cross) / 2)

    @cached_property
    def vertex_normals(self) -> FloatArray:
        """(n, 3) unit normals, area-weighted over the triangles of each vertex."""
        return _unit(np.asarray(self.links.corners @ self._triangle_cross))

    def normals_at(self, vertices: IntArray) -> FloatArray:
        """Return the `vertex_normals` (k, 3) of some vertices, by the triangles around them alone.

        Parameters
        ----------
        vertices : (k,) int64
            Their numbers.
        """
        around = self.links.corners[vertices]
        touched = np.zeros(len(self.triangles), dtype=bool)
        touched[around.indices] = True
        cross = np.zeros((len(self.triangles), 3))
        cross[touched] = replace(self, triangles=self.triangles[touched])._triangle_cross
        return _unit(np.asarray(around @ cross))

    @cached_property
    def vertex_areas(self) -> FloatArray:
        """(n,) a third of the area of the triangles around each vertex, mm²."""
        return np.asarray(self.links.corners @ (self.triangle_areas_mm2 / 3))

    @cached_property
    def bounds_mm(self) -> FloatArray:
        """(2, 3) smallest and largest coordinates."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @cached_property
    def area_mm2(self) -> float:
        """Area of all triangles."""
        return float(self.triangle_areas_mm2.sum())

    @cached_property
    def volume_mm3(self) -> float:
        """Signed volume of a closed mesh; positive when the triangles face outwards."""
        a, b, c = (self.vertices[self.triangles[:, corner]] for corner in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    @cached_property
    def is_closed(self) -> bool:
        """Whether every edge has exactly two triangles that traverse it in opposite directions."""
        if len(self.triangles) == 0:
            return False
        starts, ends = self.triangles.ravel(), self.triangles[:, [1, 2, 0]].ravel()
        shape = len(self.vertices), len(self.vertices)
        edges = scipy.sparse.csr_array(
            (np.ones(len(starts), np.int32), (starts, ends)), shape=shape
        )
        back = edges.T.tocsr()
        return bool(
            (edges.data == 1).all()
            and np.array_equal(edges.indptr, back.indptr)
            and np.array_equal(edges.indices, back.indices)
        )

    def transformed(self, a2b: FloatArray) -> TriangleMesh:
        """Transform the mesh by `a2b` (4, 4), rigid, from frame a to frame b."""
        touches = None if self.touches is None else self.touches.transformed(a2b)
        mesh = replace(self, vertices=transform(a2b, self.vertices), touches=touches)
        return mesh._knowing(self, {"links", "triangle_areas_mm2"} & self.__dict__.keys())

    def moved(self, vertices: FloatArray) -> TriangleMesh:
        """Return a mesh of the same triangles with other vertices (n, 3), mm; drop all else."""
        return TriangleMesh(vertices, self.triangles)._knowing(
            self, {"links"} & self.__dict__.keys()
        )

    def with_attributes(
        self, *, colors: ByteArray | None = None, touches: ContourConstraints | None = None
    ) -> TriangleMesh:
        """Replace the colours, the contour constraints, or both; what is None stays.

        Parameters
        ----------
        colors : (n, 3) uint8, optional
            RGB.
        touches : optional
            In the frame of the mesh.

        Returns
        -------
        TriangleMesh
            Of the same surface, with the quantities already computed for it.
        """
        mesh = replace(
            self,
            colors=self.colors if colors is None else colors,
            touches=self.touches if touches is None else touches,
        )
        return mesh._knowing(self, self.__dict__.keys() - mesh.__dict__.keys())

    def part(self, keep: BoolArray) -> TriangleMesh:
        """Keep only the vertices with `keep` (n,) true, and the triangles between them."""
        index = np.cumsum(keep, dtype=np.int32) - 1
        triangles = self.triangles[keep[self.triangles].all(axis=1)]
        colors = None if self.colors is None else self.colors[keep]
        return TriangleMesh(self.vertices[keep], index[triangles], colors, self.touches)

    def mirrored(self) -> TriangleMesh:
        """Return the mirror image in x, facing outwards as this one."""
        touches = None if self.touches is None else self.touches.mirrored()
        return replace(self, vertices=self.vertices * MIRROR, touches=touches).flipped()

    def flipped(self) -> TriangleMesh:
        """Turn the mesh inside out."""
        return replace(self, triangles=np.ascontiguousarray(self.triangles[:, ::-1]))

    def _knowing(self, other: TriangleMesh, cached: Set[str]) -> TriangleMesh:
        """Copy cached properties of another mesh that also hold for this one."""
        self.__dict__.update({name: other.__dict__[name] for name in cached})
        return self

    @cached_property
    def _triangle_cross(self) -> FloatArray:
        # Coordinate by coordinate: several times as quick as with rows and `np.cross`.
        a, b, c = self.triangles.T.astype(np.intp, order="C")
        coordinates = np.ascontiguousarray(self.vertices.T)
        u = [values.take(b) - values.take(a) for values in coordinates]
        v = [values.take(c) - values.take(a) for values in coordinates]
        pairs = ((1, 2), (2, 0), (0, 1))
        return np.stack([u[i] * v[j] - u[j] * v[i] for i, j in pairs], axis=1)


def _unit(vectors: FloatArray) -> FloatArray:
    """Scale vectors (n, 3) to length 1; those without length stay."""
    length = lengths(vectors)[:, None]
    return np.asarray(np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0))
