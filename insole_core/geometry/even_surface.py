"""A surface as evenly spread points, which depend on its shape and not on its triangles.

The surface is sampled by area, and the samples are averaged in the cells of a lattice: the same
surface gives nearly the same points however it is cut into triangles, coarse or fine.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform

_CELL_MM = 1.5
_SAMPLES_PER_CELL = 6
_STEPS = (0.7548776662466927, 0.5698402909980532)
"""Of the additive sequence R2 (Roberts 2018), which fills a square evenly."""
_LEAST_SAMPLES = 2  # of a cell that the surface does not only touch
_LEAST_NORMAL = 0.4
"""Least length of a cell's mean normal; it is shorter where two walls meet in the cell."""
_RIM_MM = 10.0  # greatest distance from the boundary that is computed
_NORMAL_ROUNDS = 2


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
    rim_mm : (n,) float64
        Distance from the boundary of an open surface; infinite from 10 mm on.
    """

    points: FloatArray
    normals: FloatArray
    area_mm2: FloatArray
    rim_mm: FloatArray

    @staticmethod
    def of(mesh: TriangleMesh) -> EvenSurface:
        """Sample a mesh."""
        points, triangle = area_samples(mesh, _CELL_MM**2 / _SAMPLES_PER_CELL)
        lattice = _Lattice(np.floor(points / _CELL_MM).astype(np.int64))
        mean = lattice.mean(points)
        normals = lattice.mean(mesh.triangle_normals[triangle])
        clear = np.linalg.norm(normals, axis=1) > _LEAST_NORMAL
        clear &= lattice.count >= _LEAST_SAMPLES
        share = mesh.area_mm2 / len(points)
        return EvenSurface(
            mean[clear],
            lattice.smoothed(normals)[clear],
            lattice.count[clear] * share,
            _rim_distance(mesh, mean[clear]),
        )

    def part(self, keep: BoolArray) -> EvenSurface:
        """Keep only the points with `keep` (n,) true."""
        return EvenSurface(
            self.points[keep], self.normals[keep], self.area_mm2[keep], self.rim_mm[keep]
        )

    def transformed(self, a2b: FloatArray) -> EvenSurface:
        """Return the same points in frame b, given a rigid transform (4, 4) from their frame a."""
        normals = np.asarray(self.normals @ a2b[:3, :3].T)
        return replace(self, points=transform(a2b, self.points), normals=normals)


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
    reached = np.cumsum(mesh.triangle_areas)
    count = max(int(np.ceil(reached[-1] / area_mm2)), 1)
    steps = (np.arange(count) + 0.5) * (reached[-1] / count)
    triangle = np.minimum(np.searchsorted(reached, steps), len(reached) - 1)
    a, b, c = np.moveaxis(mesh.vertices[np.sort(mesh.triangles[triangle], axis=1)], 1, 0)
    u, v = (np.arange(1, count + 1)[:, None] * np.array(_STEPS) % 1.0).T
    beyond = u + v > 1
    u, v = np.where(beyond, 1 - u, u), np.where(beyond, 1 - v, v)
    return np.asarray(a + u[:, None] * (b - a) + v[:, None] * (c - a)), triangle


class _Lattice:
    """The occupied cells of a lattice.

    Parameters
    ----------
    cell : (n, 3) int64
        Of each sample.
    """

    def __init__(self, cell: IntArray) -> None:
        cell = cell - cell.min(axis=0) + 1  # an empty cell on either side, for the neighbours
        shape = cell.max(axis=0) + 2
        self._strides = np.array([shape[1] * shape[2], shape[2], 1])
        key = cell @ self._strides
        counts = np.bincount(key, minlength=int(shape.prod()))
        self._occupied = np.flatnonzero(counts)
        self.count = counts[self._occupied]
        self._place = np.full(len(counts), -1)
        self._place[self._occupied] = np.arange(len(self._occupied))
        self._of_sample = self._place[key]

    def mean(self, values: FloatArray) -> FloatArray:
        """Return the mean (m, 3) of the values (n, 3) of the samples in each cell."""
        size = len(self._occupied)
        sums = [np.bincount(self._of_sample, column, minlength=size) for column in values.T]
        return np.asarray(np.stack(sums, axis=1) / self.count[:, None])

    def smoothed(self, normals: FloatArray) -> FloatArray:
        """Average normals (m, 3) over neighbouring cells that face the same way; unit normals."""
        steps = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        normals = _unit(normals)
        for _ in range(_NORMAL_ROUNDS):
            total = np.zeros_like(normals)
            for step in steps @ self._strides:
                other = self._place[self._occupied + step]
                theirs = normals[other]
                like = np.einsum("nc,nc->n", theirs, normals)
                weight = np.where(other < 0, 0.0, self.count[other] * np.maximum(like, 0.0))
                total += weight[:, None] * theirs
            normals = _unit(total)
        return normals


def _unit(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12))


def _rim_distance(mesh: TriangleMesh, points: FloatArray) -> FloatArray:
    """Return the distance (n,) of points from the boundary of a mesh, mm."""
    edges, sharing = mesh.links.edges
    start, end = np.moveaxis(mesh.vertices[edges[sharing == 1]], 1, 0)
    if len(start) == 0:
        return np.full(len(points), np.inf)
    pieces = np.ceil(np.linalg.norm(end - start, axis=1) / _CELL_MM).astype(np.int64) + 1
    edge = np.repeat(np.arange(len(start)), pieces)
    index = np.arange(len(edge)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = (index + 0.5) / pieces[edge]
    rim = start[edge] + share[:, None] * (end - start)[edge]
    return np.asarray(cKDTree(rim).query(points, distance_upper_bound=_RIM_MM)[0])
