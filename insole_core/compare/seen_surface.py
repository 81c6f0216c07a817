"""The side of a mesh to compare: the sole of a foot, the upper side of an insole or mould."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import inverse, rigid, transform

_BASE_MM = 0.05
_BASE_SHARE = 0.6
_FOOT_HEIGHT_MM = 60.0
_ONE_SIDED = 0.15
_OFF_LATTICE = 0.3137
"""Offset of rays from round coordinates, relative to the pitch: lattices have vertices there."""
STEEPEST = 0.5
"""Least z of a unit normal where heights are compared; steeper than 60 degrees is a wall."""


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points on the seen side of a mesh.

    Parameters
    ----------
    points, normals : (n, 3) float64, mm
        The normals point to the viewer.
    """

    points: FloatArray
    normals: FloatArray

    def transformed(self, a2b: FloatArray) -> SurfacePoints:
        """Transform points and normals from frame a to frame b."""
        return SurfacePoints(self.points @ a2b[:3, :3].T + a2b[:3, 3], self.normals @ a2b[:3, :3].T)

    def every(self, step: int) -> SurfacePoints:
        """Return every `step`-th point."""
        return SurfacePoints(self.points[::step], self.normals[::step])


@dataclass(frozen=True)
class Grid:
    """Square pixels in the (x, y)-plane.

    Parameters
    ----------
    first_mm
        Centre of the pixel (row 0, column 0).
    shape
        Rows (along y) and columns (along x).
    """

    first_mm: tuple[float, float]
    pitch_mm: float
    shape: tuple[int, int]

    @property
    def places(self) -> FloatArray:
        """(rows, columns, 2) centres of the pixels."""
        x = self.first_mm[0] + self.pitch_mm * np.arange(self.shape[1])
        y = self.first_mm[1] + self.pitch_mm * np.arange(self.shape[0])
        return np.stack(np.meshgrid(x, y), axis=-1)


def grid_over(mesh: TriangleMesh, pitch_mm: float) -> Grid:
    """Return pixels of this pitch that cover a mesh."""
    low, high = mesh.bounds_mm[:, :2]
    return _grid(low, high, pitch_mm)


def _grid(low: FloatArray, high: FloatArray, pitch_mm: float) -> Grid:
    """Return pixels of this pitch that cover what lies between two corners (2,)."""
    first = (np.floor(low / pitch_mm) - 1 + _OFF_LATTICE) * pitch_mm
    columns, rows = (int(n) for n in np.ceil((high - first) / pitch_mm) + 1)
    return Grid((float(first[0]), float(first[1])), pitch_mm, (rows, columns))


def facing(mesh: TriangleMesh) -> FloatArray:
    """Return the unit vector (3,) in which the side to compare faces.

    An open surface faces as its triangles do. A solid in one of the product's frames faces upwards
    if it stands on a flat base (insole, block, mould) or is as flat as an insole; otherwise it is a
    foot, whose sole faces down.
    """
    mean = _mean_normal(mesh)
    if is_one_sided(mesh):
        return np.asarray(mean / np.linalg.norm(mean))
    height = np.ptp(mesh.vertices[:, 2])
    stands = _has_flat_base(mesh)
    return np.array([0.0, 0.0, 1.0 if stands or height < _FOOT_HEIGHT_MM else -1.0])


def is_one_sided(mesh: TriangleMesh) -> bool:
    """Return whether a surface is open, so that its triangles tell the side to compare."""
    return float(np.linalg.norm(_mean_normal(mesh))) > _ONE_SIDED


def _mean_normal(mesh: TriangleMesh) -> FloatArray:
    areas = mesh.triangle_areas_mm2
    return np.asarray(areas @ mesh.triangle_normals / areas.sum())


def _has_flat_base(mesh: TriangleMesh) -> bool:
    areas = mesh.triangle_areas_mm2
    heights = mesh.vertices[mesh.triangles, 2]
    lowest = (heights < mesh.vertices[:, 2].min() + _BASE_MM).all(axis=1)
    downward = mesh.triangle_normals[:, 2] < -STEEPEST
    return bool(areas[lowest & downward].sum() > _BASE_SHARE * areas[downward].sum())


def height_map(mesh: TriangleMesh, grid: Grid, from_above: bool) -> FloatArray:
    """Compute the heights of a surface that is looked at once: see `SeenMesh.heights`."""
    return SeenMesh(mesh).heights(grid, from_above)


class SeenMesh:
    """A mesh that is looked at along rays, from several directions.

    Parameters
    ----------
    mesh : mm
        At least one triangle.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self.mesh = mesh

    def heights(
        self, grid: Grid, from_above: bool, mesh2grid: FloatArray | None = None
    ) -> FloatArray:
        """Compute the heights of the surface seen along z.

        Parameters
        ----------
        from_above
            Whether to look down; otherwise up from below.
        mesh2grid : (4, 4) float64, mm
            To the frame of the grid; None where the mesh lies in it.

        Returns
        -------
        (rows, columns) float64, mm
            NaN beside the mesh and on its walls.
        """
        points, normals, ray = self._cast(
            grid, from_above, np.eye(4) if mesh2grid is None else mesh2grid
        )
        heights = np.full(grid.shape[0] * grid.shape[1], np.nan)
        flat = np.abs(normals[:, 2]) >= STEEPEST
        heights[ray[flat]] = points[flat, 2]
        return heights.reshape(grid.shape)

    def points(self, direction: FloatArray, pitch_mm: float) -> SurfacePoints:
        """Sample the side of the mesh that faces a direction, evenly as seen from there.

        Parameters
        ----------
        direction : (3,)
            In the frame of the mesh.
        pitch_mm
            Of the samples, across the direction.

        Returns
        -------
        SurfacePoints
            In the frame of the mesh; walls are left out.
        """
        up = _frame_looking_up(direction)
        seen = self.mesh.vertices @ up[:2].T
        grid = _grid(seen.min(axis=0), seen.max(axis=0), pitch_mm)
        points, normals, _ = self._cast(grid, True, rigid(up, np.zeros(3)))
        normals = normals * np.where(normals[:, 2] < 0, -1, 1)[:, None]
        flat = normals[:, 2] >= STEEPEST
        return SurfacePoints(points[flat] @ up, normals[flat] @ up)

    @cached_property
    def _caster(self) -> RayCaster:
        return RayCaster(self.mesh)

    def _cast(
        self, grid: Grid, from_above: bool, mesh2grid: FloatArray
    ) -> tuple[FloatArray, FloatArray, IntArray]:
        """Return points and normals (n, 3), frame of the grid, where rays along z first hit.

        The third array (n,) is the pixel of each.
        """
        sign, mesh = 1.0 if from_above else -1.0, self.mesh
        height = mesh.vertices @ mesh2grid[2, :3] + mesh2grid[2, 3]
        start = (height * sign).max() + 10.0
        places = grid.places.reshape(-1, 2)
        origins = np.column_stack([places, np.full(len(places), sign * start)])
        origins = transform(inverse(mesh2grid), origins)
        hits = self._caster.cast(origins, np.broadcast_to(-sign * mesh2grid[2, :3], origins.shape))
        corners = mesh.vertices[mesh.triangles[hits.triangle]]
        points = transform(mesh2grid, np.einsum("nk,nkc->nc", hits.weights, corners))
        return points, mesh.triangle_normals[hits.triangle] @ mesh2grid[:3, :3].T, hits.ray


def _frame_looking_up(direction: FloatArray) -> FloatArray:
    """Return the rotation (3, 3) that brings a unit vector to +z; the identity for +z itself."""
    up = direction / np.linalg.norm(direction)
    helper = np.array([0.0, 1.0, 0.0]) if abs(up[1]) < 0.9 else np.array([1.0, 0.0, 0.0])
    right = np.cross(helper, up)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(up, right), up])
