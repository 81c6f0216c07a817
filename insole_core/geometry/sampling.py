"""Even sampling of surfaces: deterministic, and by their shape, not by their triangles."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.lengths import directions, lengths
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.transforms import MIRROR, transform
from insole_core.memo import Memo

_STEPS = (0.7548776662466927, 0.5698402909980532)
"""Of the additive sequence R2 (Roberts 2018), which fills a square evenly."""
_CELL_MM = 1.5
_PITCH = 2 / 3  # of the samples, as a share of a cell
_MOST_CELLS = 6_000_000  # of the box around a surface: what is no foot gets larger cells
_AT_ONCE = 300_000  # triangles
_LEAST_MM2 = 0.3  # of a surface in a cell that it does not only touch
_LEAST_NORMAL = 0.4
"""Least length of a cell's mean normal; it is shorter where two walls meet in the cell."""
_RIM_MM = 10.0  # greatest distance from the boundary that is computed
_MOST_DERIVED = 4  # of each kind
_PATCH_MM, _SAME_DEG = 8.0, 0.1  # about a point, and the angle within which normals are the same


@dataclass(frozen=True, eq=False)
class _SurfaceSamples:
    """Points on a mesh.

    Parameters
    ----------
    points : (n, 3) float64, mm, frame of the mesh
    triangle : (n,) int64
        Index of the triangle that each point lies on.
    area_mm2 : (n,) float64
        Area that each point represents; they add up to the area of the mesh.
    """

    points: FloatArray
    triangle: IntArray
    area_mm2: FloatArray


def sample_triangles(mesh: TriangleMesh, pitch_mm: float) -> _SurfaceSamples:
    """Sample every triangle in rows parallel to its longest edge.

    The number of points follows the area, so needle-shaped triangles are cheap; every triangle
    gets at least one.

    Parameters
    ----------
    pitch_mm
        Largest distance of neighbouring points in a triangle.

    Returns
    -------
    SurfaceSamples
        Ordered by triangle.
    """
    corners = _longest_edge_first(mesh.vertices[mesh.triangles])
    edges = corners[:, 1:] - corners[:, :1]
    base = lengths(edges[:, 0])
    twice_area = lengths(np.cross(edges[:, 0], edges[:, 1]))
    height = np.divide(twice_area, base, out=np.zeros_like(base), where=base > 0)
    columns, rows = (
        np.ceil(np.maximum(length / pitch_mm, 1)).astype(np.int64) for length in (base, height)
    )
    count = columns * rows
    # The value of each point's triangle, in order, which is quicker than by index.
    of_each = partial(np.repeat, repeats=count, axis=0)
    index = np.arange(count.sum()) - of_each(np.cumsum(count) - count)
    row, column = np.divmod(index, of_each(columns))
    middle = (row + 0.5) / of_each(rows)
    v = middle - 1 / (12 * of_each(rows) ** 2 * (1 - middle))  # centroid of the row
    u = (column + 0.5) / of_each(columns) * (1 - v)
    points = (
        of_each(corners[:, 0])
        + u[:, None] * of_each(edges[:, 0])
        + v[:, None] * of_each(edges[:, 1])
    )
    triangle = of_each(np.arange(len(count)))
    return _SurfaceSamples(points, triangle, of_each(twice_area / count) * (1 - middle))


def area_samples(mesh: TriangleMesh, area_mm2: float) -> tuple[FloatArray, IntArray]:
    """Sample a mesh so that every point represents the same area.

    Neither time nor memory grow with the triangles by more than their areas; the points do not
    depend on the winding of the triangles.

    Parameters
    ----------
    area_mm2
        Largest area of one point.

    Returns
    -------
    points : (n, 3) float64, mm
    triangle : (n,) int64
        Index of the triangle of each point.
    """
    reached = np.cumsum(mesh.triangle_areas_mm2)
    count = max(int(np.ceil(reached[-1] / area_mm2)), 1)
    steps = (np.arange(count) + 0.5) * (reached[-1] / count)
    triangle = np.minimum(np.searchsorted(reached, steps), len(reached) - 1)
    a, b, c = np.moveaxis(mesh.vertices[np.sort(mesh.triangles[triangle], axis=1)], 1, 0)
    u, v = (np.arange(1, count + 1)[:, None] * np.array(_STEPS) % 1.0).T
    beyond = u + v > 1
    u, v = np.where(beyond, 1 - u, u), np.where(beyond, 1 - v, v)
    return np.asarray(a + u[:, None] * (b - a) + v[:, None] * (c - a)), triangle


def _longest_edge_first(corners: FloatArray) -> FloatArray:
    """Order the corners (n, 3, 3) so that the longest edge runs from the first to the second."""
    x, y, z = np.moveaxis(corners.take((1, 2, 0), axis=1) - corners, 2, 0)
    first = np.sqrt(x * x + y * y + z * z).argmax(axis=1)
    order = 3 * np.arange(len(corners))[:, None] + (first[:, None] + np.arange(3)) % 3
    return np.asarray(corners.reshape(-1, 3).take(order, axis=0))


def boundary_points(mesh: TriangleMesh, step_mm: float) -> FloatArray:
    """Return points along the boundary of an open mesh.

    Parameters
    ----------
    step_mm
        Greatest distance between neighbouring points.

    Returns
    -------
    (k, 3) float64, mm, frame of the mesh
        None for a closed mesh.
    """
    edges, sharing = mesh.links.edges
    start, end = np.moveaxis(mesh.vertices[edges[sharing == 1]], 1, 0)
    parts = np.ceil(lengths(end - start) / step_mm).astype(np.int64) + 1
    edge = np.repeat(np.arange(len(start)), parts)
    index = np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts)
    share = (index + 0.5) / parts[edge]
    return np.asarray(start[edge] + share[:, None] * (end - start)[edge])


@dataclass(frozen=True, eq=False)
class EvenSurface:
    """Points of a surface, about one for every cell of 1.5 mm that it runs through.

    Parameters
    ----------
    points : (n, 3) float64, mm, frame of the mesh
    normals : (n, 3) float64
        Unit normals, averaged over some millimetres.
    area_mm2 : (n,) float64
        Area that each point represents.
    facets : (n, 3) float64
        Unit normals of the triangles, averaged over a cell only.
    rim_mm : (n,) float64
        Distance from the boundary of an open surface; infinite from 10 mm on.
    derived
        What was computed from these points, for as long as they are kept.
    """

    points: FloatArray
    normals: FloatArray
    area_mm2: FloatArray
    facets: FloatArray
    rim_mm: FloatArray
    derived: Memo = field(default_factory=lambda: Memo(_MOST_DERIVED), init=False, repr=False)

    @staticmethod
    def of(mesh: TriangleMesh) -> EvenSurface:
        """Spread points over a mesh.

        The time grows with triangles and area; the memory hardly does.
        """
        lattice = _Lattice(mesh.bounds_mm)
        for first in range(0, len(mesh.triangles), _AT_ONCE):
            part = TriangleMesh(mesh.vertices, mesh.triangles[first : first + _AT_ONCE])
            samples = sample_triangles(part, _PITCH * lattice.cell_mm)
            normals = part.triangle_normals.take(samples.triangle, axis=0)
            lattice.add(samples.points, normals, samples.area_mm2)
        points, facets, normals, area_mm2 = lattice.result()
        return EvenSurface(points, normals, area_mm2, facets, _rim_distance(mesh, points))

    def part(self, keep: BoolArray) -> EvenSurface:
        """Keep only the points with `keep` (n,) true."""
        return EvenSurface(
            self.points[keep],
            self.normals[keep],
            self.area_mm2[keep],
            self.facets[keep],
            self.rim_mm[keep],
        )

    def transformed(self, a2b: FloatArray) -> EvenSurface:
        """Return the same points in frame b, given a rigid transform (4, 4) from their frame a."""
        rotation = a2b[:3, :3].T
        return replace(
            self,
            points=transform(a2b, self.points),
            normals=np.asarray(self.normals @ rotation),
            facets=np.asarray(self.facets @ rotation),
        )

    def mirrored(self) -> EvenSurface:
        """Return the mirror image in x."""
        return replace(
            self,
            points=self.points * MIRROR,
            normals=self.normals * MIRROR,
            facets=self.facets * MIRROR,
        )

    def facet_mm2(self, point: FloatArray) -> float:
        """Return the mean area of the plane facets about a point (3,), however they are cut.

        Facets larger than about 100 mm² count as that. Of a fine surface it is the area of a cell.
        """
        near = lengths(self.points - point) < _PATCH_MM
        facets, area_mm2 = self.facets[near], self.area_mm2[near]
        if len(area_mm2) == 0:
            return 0.0
        same = facets @ facets.T > np.cos(np.radians(_SAME_DEG))
        return float(area_mm2 @ same @ area_mm2 / area_mm2.sum())


class _Lattice:
    """Sums over the cells of a lattice.

    Parameters
    ----------
    bounds_mm : (2, 3) float64
        Of all points.
    """

    def __init__(self, bounds_mm: FloatArray) -> None:
        size = np.ptp(bounds_mm, axis=0)
        self.cell_mm = max(_CELL_MM, float(np.cbrt(size.prod() / _MOST_CELLS)))
        self._first = np.floor(bounds_mm[0] / self.cell_mm).astype(np.int64) - 1
        # An empty cell on either side, for the neighbours.
        shape = np.floor(bounds_mm[1] / self.cell_mm).astype(np.int64) - self._first + 2
        self._strides = np.array([shape[1] * shape[2], shape[2], 1])
        self._size = int(shape.prod())
        self._parts: list[FloatArray] = []

    def add(self, points: FloatArray, normals: FloatArray, area_mm2: FloatArray) -> None:
        """Add points (n, 3), normals (n, 3) and the areas (n,) that they represent."""
        cell = np.floor(points / self.cell_mm).astype(np.int64) - self._first
        key = cell @ self._strides
        area = np.bincount(key, area_mm2, minlength=self._size)
        occupied = np.flatnonzero(area)
        number = self._numbers(occupied, 0)[key]  # of the few cells that are occupied
        columns = (*points.T, *normals.T)
        count = len(occupied)  # none where all is without area
        sums = [np.bincount(number, area_mm2 * column)[:count] for column in columns]
        self._parts.append(np.stack([occupied, area[occupied], *sums], axis=1))

    def _numbers(self, occupied: IntArray, others: int) -> IndexArray:
        """Return the number of each cell among those that are occupied."""
        numbers = np.full(self._size, others, dtype=np.int32)
        numbers[occupied] = np.arange(len(occupied))
        return numbers

    def result(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return points, mean and smoothed normals, and areas of the cells that are clear."""
        rows = np.concatenate(self._parts)
        occupied, number = np.unique(rows[:, 0].astype(np.int64), return_inverse=True)
        area_mm2, *sums = (
            np.bincount(number, column).astype(np.float64) for column in rows[:, 1:].T
        )
        means = np.stack(sums, axis=1) / area_mm2[:, None]
        points, normals = means[:, :3], means[:, 3:]
        clear = (lengths(normals) > _LEAST_NORMAL) & (area_mm2 > _LEAST_MM2)
        facets = directions(normals)
        smoothed = self._smoothed(occupied, facets, area_mm2)
        return points[clear], facets[clear], smoothed[clear], area_mm2[clear]

    def _smoothed(
        self, occupied: IntArray, normals: FloatArray, area_mm2: FloatArray
    ) -> FloatArray:
        """Average normals (n, 3) over neighbouring cells that face the same way; unit normals."""
        place = self._numbers(occupied, -1)
        steps = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        weighted = area_mm2[:, None] * normals
        total = weighted.copy()
        for step in steps[len(steps) // 2 + 1 :] @ self._strides:  # the others lead back
            there = place[occupied + step]
            here = np.flatnonzero(there >= 0)  # a surface runs through few of the neighbours
            there = there[here]
            like = np.einsum("nc,nc->n", normals.take(there, axis=0), normals.take(here, axis=0))
            like = np.maximum(like, 0.0)[:, None]
            total[here] += like * weighted.take(there, axis=0)
            total[there] += like * weighted.take(here, axis=0)
        return directions(total)


def _rim_distance(mesh: TriangleMesh, points: FloatArray) -> FloatArray:
    """Return the distance (n,) of points from the boundary of a mesh, mm."""
    rim = boundary_points(mesh, _CELL_MM)
    if len(rim) == 0:
        return np.full(len(points), np.inf)
    return np.asarray(point_tree(rim).query(points, distance_upper_bound=_RIM_MM)[0])
