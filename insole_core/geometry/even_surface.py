"""A surface as evenly spread points, which depend on its shape and not on its triangles.

The surface is sampled by area, and the samples are averaged in the cells of a lattice: the same
surface gives nearly the same points however it is cut into triangles, coarse or fine.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.sampling import boundary_points, sample_triangles
from insole_core.geometry.transforms import transform

_CELL_MM = 1.5
_PITCH = 2 / 3  # of the samples, as a share of a cell
_MOST_CELLS = 6_000_000  # of the box around a surface: what is no foot gets larger cells
_AT_ONCE = 300_000  # triangles
_LEAST_MM2 = 0.3  # of a surface in a cell that it does not only touch
_LEAST_NORMAL = 0.4
"""Least length of a cell's mean normal; it is shorter where two walls meet in the cell."""
_RIM_MM = 10.0  # greatest distance from the boundary that is computed
_PATCH_MM, _SAME_DEG = 8.0, 0.1  # about a point, and the angle within which normals are the same


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
    """

    points: FloatArray
    normals: FloatArray
    area_mm2: FloatArray
    facets: FloatArray
    rim_mm: FloatArray

    @staticmethod
    def of(mesh: TriangleMesh) -> EvenSurface:
        """Spread points over a mesh.

        The time grows with triangles and area; the memory hardly does.
        """
        lattice = _Lattice(mesh.bounds_mm)
        for first in range(0, len(mesh.triangles), _AT_ONCE):
            part = TriangleMesh(mesh.vertices, mesh.triangles[first : first + _AT_ONCE])
            samples = sample_triangles(part, _PITCH * lattice.cell_mm)
            normals = part.triangle_normals[samples.triangle]
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

    def facet_mm2(self, point: FloatArray) -> float:
        """Return the mean area of the plane facets about a point (3,), however they are cut.

        Facets larger than about 100 mm² count as that. Of a fine surface it is the area of a cell.
        """
        near = np.linalg.norm(self.points - point, axis=1) < _PATCH_MM
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
        columns = (np.ones(len(points)), *points.T, *normals.T)
        occupied = np.flatnonzero(np.bincount(key, area_mm2, minlength=self._size))
        sums = [np.bincount(key, area_mm2 * column)[occupied] for column in columns]
        self._parts.append(np.stack([occupied, *sums], axis=1))

    def result(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return points, mean and smoothed normals, and areas of the cells that are clear."""
        rows = np.concatenate(self._parts)
        occupied, number = np.unique(rows[:, 0].astype(np.int64), return_inverse=True)
        area_mm2, *sums = (
            np.bincount(number, column).astype(np.float64) for column in rows[:, 1:].T
        )
        means = np.stack(sums, axis=1) / area_mm2[:, None]
        points, normals = means[:, :3], means[:, 3:]
        clear = (np.linalg.norm(normals, axis=1) > _LEAST_NORMAL) & (area_mm2 > _LEAST_MM2)
        facets = _unit(normals)
        smoothed = self._smoothed(occupied, facets, area_mm2)
        return points[clear], facets[clear], smoothed[clear], area_mm2[clear]

    def _smoothed(
        self, occupied: IntArray, normals: FloatArray, area_mm2: FloatArray
    ) -> FloatArray:
        """Average normals (n, 3) over neighbouring cells that face the same way; unit normals."""
        place = np.full(self._size, -1, dtype=np.int32)
        place[occupied] = np.arange(len(occupied))
        steps = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        total = np.zeros_like(normals)
        for step in steps @ self._strides:
            other = place[occupied + step]
            filled = np.flatnonzero(other >= 0)  # a surface runs through few of the neighbours
            other = other[filled]
            theirs = normals[other]
            like = np.einsum("nc,nc->n", theirs, normals[filled])
            weight = area_mm2[other] * np.maximum(like, 0.0)
            total[filled] += weight[:, None] * theirs
        return _unit(total)


def _unit(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12))


def _rim_distance(mesh: TriangleMesh, points: FloatArray) -> FloatArray:
    """Return the distance (n,) of points from the boundary of a mesh, mm."""
    rim = boundary_points(mesh, _CELL_MM)
    if len(rim) == 0:
        return np.full(len(points), np.inf)
    return np.asarray(point_tree(rim).query(points, distance_upper_bound=_RIM_MM)[0])
