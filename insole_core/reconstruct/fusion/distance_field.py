"""A signed distance field of all views (Curless & Levoy 1996), near the surface only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.surface_nets import surface_nets
from insole_core.reconstruct.fusion.prepared_view import PreparedView, SmoothDepth
from insole_core.reconstruct.parallel import for_views

_BLOCK_CELLS = 2
_LEAST_COSINE = 0.1
_SAME_SURFACE_MM = 10.0


@dataclass(frozen=True)
class FieldLimits:
    """The lattice of the distance field.

    Parameters
    ----------
    cell_mm
        Distance of neighbouring lattice points.
    truncation_mm
        Largest distance before the surface; points farther behind it than this are unknown.
    """

    cell_mm: float = 2.0
    truncation_mm: float = 6.0


def mesh_views(views: list[PreparedView], limits: FieldLimits = FieldLimits()) -> TriangleMesh:
    """Mesh the surface on which all views agree best.

    The signed distance at each lattice point is the mean of its distances before the surfaces of
    the views, weighted by cos² of the angle of incidence.

    Parameters
    ----------
    views
        At least one.
    limits

    Returns
    -------
    TriangleMesh, mm, reference frame
    """
    placed = [
        view.reading.origin_mm + view.depth.depth_mm[..., None] * view.reading.rays
        for view in views
    ]
    points = np.concatenate([p[np.isfinite(p[..., 2])] for p in placed])
    reach = _BLOCK_CELLS * limits.cell_mm
    origin = points.min(0) - 2 * reach
    near = _near_cells(points, origin, limits)
    where = np.argwhere(near)
    lattice = origin + limits.cell_mm * where
    total, weight = np.zeros(len(where)), np.zeros(len(where))
    for at, before_mm, certainty in for_views(
        lambda view: _distances(view, lattice, limits.truncation_mm), views
    ):
        total[at] += certainty * before_mm
        weight[at] += certainty
    values, known = np.zeros(near.shape), np.zeros(near.shape, dtype=bool)
    values[near] = total / np.maximum(weight, 1e-12)
    known[near] = weight > 0
    return surface_nets(values, known, origin, limits.cell_mm)


def _near_cells(points: FloatArray, origin: FloatArray, limits: FieldLimits) -> BoolArray:
    """Return which lattice points (i, j, k) lie in or beside a block that holds a point."""
    block = np.floor((points - origin) / (_BLOCK_CELLS * limits.cell_mm)).astype(np.int64)
    occupied = np.zeros(block.max(0) + 3, dtype=bool)
    occupied[tuple(block.T)] = True
    for axis in range(3):
        before = np.moveaxis(occupied, axis, 0)
        grown = before.copy()
        grown[1:] |= before[:-1]
        grown[:-1] |= before[1:]
        occupied = np.moveaxis(grown, 0, axis).repeat(_BLOCK_CELLS, axis)
    return occupied


def _distances(
    view: PreparedView, lattice: FloatArray, truncation_mm: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the lattice points that a view measured, their distances before it, and weights."""
    at, surface_mm, cosine = _look_up(view.reading.project(lattice), view.depth)
    before_mm = surface_mm - view.reading.depth_along(lattice[at])
    seen = before_mm > -truncation_mm
    certainty = np.maximum(cosine[seen], _LEAST_COSINE) ** 2
    return at[seen], np.minimum(before_mm[seen], truncation_mm), certainty


def _look_up(pixels: FloatArray, depth: SmoothDepth) -> tuple[IntArray, FloatArray, FloatArray]:
    """Interpolate depth and cosine at positions (n, 2), but not across jumps.

    Returns
    -------
    at : (k,) int64
        Index of the positions on the surface.
    depth_mm, cosine : (k,) float64
    """
    known = np.isfinite(depth.depth_mm)
    height, width = known.shape
    u, v = np.rint(pixels).astype(np.int64).T
    at = np.flatnonzero((u >= 1) & (u < width - 1) & (v >= 1) & (v < height - 1))
    at = at[known[v[at], u[at]]]
    center = depth.depth_mm[v[at], u[at]]
    low = np.floor(pixels[at]).astype(np.int64)
    share = pixels[at] - low
    sums = np.zeros((3, len(at)))
    for du, dv in ((0, 0), (0, 1), (1, 0), (1, 1)):
        row, column = low[:, 1] + dv, low[:, 0] + du
        value = depth.depth_mm[row, column]
        part = np.abs(1 - du - share[:, 0]) * np.abs(1 - dv - share[:, 1])
        part = np.where(np.abs(value - center) < _SAME_SURFACE_MM, part, 0)
        sums += part * np.stack([np.ones(len(at)), np.nan_to_num(value), depth.cosine[row, column]])
    return at, sums[1] / sums[0], sums[2] / sums[0]
