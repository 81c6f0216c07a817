"""What a cutter from above may touch: solids in a block, sampled on a grid, with their edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster

_SHARP_DEG = 8.0
"""Between nodes of the grid an edge sharper than this is touched by samples of its own."""
_FLAT_MM = 0.008
"""An edge that rises less above the grid needs no samples."""
_OFF_LATTICE = 1.7e-3
"""Rays beside the round numbers on which the edges of triangles lie."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Solids seen from above. The first index of a grid runs along x, the second along y.

    Parameters
    ----------
    step_mm
        Of the grid, along both axes.
    first_mm : (2,) float64
        x and y of the node [0, 0], in the block's frame.
    heights_mm : (nx, ny) float32
        Above the bottom of the block; the floor beside the solids.
    inside : (nx, ny) bool
        Where a solid is.
    edges_mm : (k, 3) float64
        Samples of the sharp edges, no farther apart than the nodes.
    """

    step_mm: float
    first_mm: FloatArray
    heights_mm: Float32Array
    inside: BoolArray
    edges_mm: FloatArray
    floor_mm: float

    @property
    def x_mm(self) -> FloatArray:
        """(nx,) places of the lines."""
        return np.asarray(self.first_mm[0] + self.step_mm * np.arange(self.inside.shape[0]))

    @property
    def y_mm(self) -> FloatArray:
        """(ny,) places of the nodes of a line."""
        return np.asarray(self.first_mm[1] + self.step_mm * np.arange(self.inside.shape[1]))

    @cached_property
    def beside_mm(self) -> Float32Array:
        """(nx, ny) horizontal distances from the solids; 0 inside."""
        outside = np.asarray(~self.inside, np.uint8)
        pixels = cv2.distanceTransform(outside, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        return np.asarray(pixels * self.step_mm, np.float32)

    def index_of(self, places_mm: FloatArray) -> tuple[FloatArray, ...]:
        """Return the nodes nearest to places (n, 2), those beyond the grid at its edge."""
        index = np.rint((places_mm - self.first_mm) / self.step_mm).astype(int)
        return tuple(np.clip(index, 0, np.array(self.inside.shape) - 1).T)

    def with_floor(self, floor_mm: float) -> Surface:
        """Return the surface with another height beside the solids."""
        heights = np.where(self.inside, self.heights_mm, np.float32(floor_mm))
        return Surface(self.step_mm, self.first_mm, heights, self.inside, self.edges_mm, floor_mm)


def sample_surface(
    solids: Sequence[TriangleMesh],
    block_mm: tuple[float, float, float],
    margin_mm: float,
    step_mm: float,
) -> Surface:
    """Sample solids in a block from above.

    Parameters
    ----------
    solids : mm
        In the block's frame: a corner at the origin, width along x, length along y.
    block_mm
        Width, length, height.
    margin_mm
        Of the grid round the solids, as far as the block goes.
    step_mm
        Of the grid.
    """
    bounds = np.array([solid.bounds_mm[:, :2] for solid in solids])
    low = np.maximum(bounds[:, 0].min(axis=0) - margin_mm, 0.0)
    high = np.minimum(bounds[:, 1].max(axis=0) + margin_mm, np.array(block_mm[:2]))
    count = np.floor((high - low) / step_mm).astype(int) + 1
    heights = np.full(tuple(count), np.nan, np.float32)
    for solid in solids:
        _cast(solid, low, step_mm, heights)
    inside = np.isfinite(heights)
    heights[~inside] = 0
    edges = np.concatenate([_sharp_edges(solid, step_mm) for solid in solids])
    edges = edges[_rise(edges, low, step_mm, heights) > _FLAT_MM]
    return Surface(step_mm, low, heights, inside, edges, 0.0)


def _rise(
    places: FloatArray, first_mm: FloatArray, step_mm: float, heights: Float32Array
) -> FloatArray:
    """Return by how much places (n, 3) lie above the heights of the grid round them."""
    node = (places[:, :2] - first_mm) / step_mm
    low = np.clip(np.floor(node).astype(int), 0, np.array(heights.shape) - 2)
    i, j = low.T
    u, v = (node - low).T
    along = heights[i, j] * (1 - v) + heights[i, j + 1] * v
    beyond = heights[i + 1, j] * (1 - v) + heights[i + 1, j + 1] * v
    return np.asarray(places[:, 2] - along * (1 - u) - beyond * u)


def _cast(solid: TriangleMesh, first_mm: FloatArray, step_mm: float, heights: Float32Array) -> None:
    """Fill in the heights of one solid where it is the highest."""
    low, high = (solid.bounds_mm[:, :2] - first_mm) / step_mm
    start = np.maximum(np.floor(low).astype(int), 0)
    end = np.minimum(np.ceil(high).astype(int) + 1, heights.shape)
    nodes = np.stack(
        np.meshgrid(*(np.arange(a, b) for a, b in zip(start, end, strict=True)), indexing="ij"), -1
    )
    flat = first_mm + step_mm * nodes.reshape(-1, 2) + _OFF_LATTICE * step_mm
    origins = np.column_stack([flat, np.full(len(flat), solid.bounds_mm[1, 2] + 10)])
    hits = RayCaster(solid).cast(origins, np.broadcast_to([0.0, 0, -1], origins.shape))
    seen = np.full(len(flat), np.nan, np.float32)
    corners = solid.vertices[solid.triangles[hits.triangle], 2]
    seen[hits.ray] = (hits.weights * corners).sum(axis=1)
    part = heights[start[0] : end[0], start[1] : end[1]]
    np.fmax(part, seen.reshape(part.shape), out=part)


def _sharp_edges(solid: TriangleMesh, step_mm: float) -> FloatArray:
    """Return samples (k, 3) of the edges at which the surface bends."""
    count = len(solid.vertices)
    start = solid.triangles.astype(np.int64)
    ends = np.sort(np.stack([start, np.roll(start, -1, axis=1)], axis=-1), axis=-1).reshape(-1, 2)
    key = ends[:, 0] * count + ends[:, 1]
    order = np.argsort(key, kind="stable")
    pair = np.flatnonzero(key[order][1:] == key[order][:-1])
    first, second = order[pair], order[pair + 1]
    normals = solid.triangle_normals
    cosine = (normals[first // 3] * normals[second // 3]).sum(axis=1)
    upward = np.maximum(normals[first // 3, 2], normals[second // 3, 2]) > 0
    sharp = first[(cosine < np.cos(np.radians(_SHARP_DEG))) & upward]
    a, b = np.moveaxis(solid.vertices[ends[sharp]], 1, 0)
    pieces = np.ceil(np.linalg.norm(b - a, axis=1) / step_mm).astype(int) + 1
    edge = np.repeat(np.arange(len(a)), pieces)
    within = np.arange(len(edge)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = (within / np.maximum(pieces - 1, 1)[edge])[:, None]
    return np.asarray(a[edge] * (1 - share) + b[edge] * share)
