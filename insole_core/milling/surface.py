"""What a cutter from above may touch: solids in a block, sampled on a grid, with their edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_OFF_LATTICE = 1.7e-3
"""Share of a step by which the nodes lie beside round numbers, on which edges often lie."""
Heights = TypeVar("Heights", Float32Array, FloatArray)
_SHARP_DEG = 5.0
"""An edge that is bent by more is touched by samples of its own."""
_EVEN_DEG = 1.0
"""The same, where a sharp edge meets it."""


def raise_to_triangles(
    corners_mm: FloatArray, first_mm: FloatArray, step_mm: float, heights: Heights
) -> None:
    """Raise heights (nx, ny), mm, to those of triangles (n, 3, 3) above the same nodes.

    Each triangle is cut by the lines of the grid; between its two edges on a line, the nodes get
    the height of its plane.

    Parameters
    ----------
    first_mm : (2,) float64
        x and y of the node [0, 0].
    """
    corners = corners_mm.copy()
    corners[:, :, :2] = (corners[:, :, :2] - first_mm) / step_mm - _OFF_LATTICE
    order = np.argsort(corners[:, :, 0], axis=1, kind="stable")
    a, b, c = np.moveaxis(np.take_along_axis(corners, order[:, :, None], axis=1), 1, 0)
    first = np.maximum(np.ceil(a[:, 0]).astype(int), 0)
    last = np.minimum(np.floor(c[:, 0]).astype(int), heights.shape[0] - 1)
    of, line = _counted(first, last)
    beyond = (line > b[of, 0])[:, None]
    one = _along(a[of], c[of], line)
    other = _along(np.where(beyond, b[of], a[of]), np.where(beyond, c[of], b[of]), line)
    swap = (other[:, 0] < one[:, 0])[:, None]
    low, high = np.where(swap, other, one), np.where(swap, one, other)
    start = np.maximum(np.ceil(low[:, 0]).astype(int), 0)
    end = np.minimum(np.floor(high[:, 0]).astype(int), heights.shape[1] - 1)
    piece, node = _counted(start, end)
    width = np.maximum(high[piece, 0] - low[piece, 0], 1e-12)
    share = (node - low[piece, 0]) / width
    level = low[piece, 1] * (1 - share) + high[piece, 1] * share
    np.maximum.at(heights, (line[piece], node), level.astype(heights.dtype))


def _counted(first: IntArray, last: IntArray) -> tuple[IntArray, IntArray]:
    """Return the owner of each whole number of the ranges from first to last, and the number."""
    counts = np.maximum(last - first + 1, 0)
    owner = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, first[owner] + within


def _along(start: FloatArray, end: FloatArray, x: IntArray) -> FloatArray:
    """Return y and z (n, 2) at x of straight pieces (n, 3) that do not fall along x."""
    length = end[:, 0] - start[:, 0]
    share = ((x - start[:, 0]) / np.where(length > 0, length, 1))[:, None]
    return np.asarray(start[:, 1:] * (1 - share) + end[:, 1:] * share)


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
    edge_normals : (k, 2, 3) float64
        Of the surface on both sides of each.
    peaks_mm : (m, 3) float64
        Ends of the sharp edges.
    """

    step_mm: float
    first_mm: FloatArray
    heights_mm: Float32Array
    inside: BoolArray
    edges_mm: FloatArray
    edge_normals: FloatArray
    peaks_mm: FloatArray
    solids: tuple[TriangleMesh, ...]
    floor_mm: float

    @cached_property
    def x_mm(self) -> FloatArray:
        """(nx,) places of the lines."""
        return np.asarray(self.first_mm[0] + self.step_mm * np.arange(self.inside.shape[0]))

    @cached_property
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

    @cached_property
    def nearest(self) -> IntArray:
        """(nx, ny) indices, in the flattened grid, of the node inside that is nearest to each."""
        _, labels = cv2.distanceTransformWithLabels(
            np.asarray(~self.inside, np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
        )
        node = np.zeros(int(labels.max()) + 1, np.int64)
        node[labels[self.inside]] = np.flatnonzero(self.inside)
        return np.asarray(node[labels])

    def beyond_rim(self, heights_mm: Float32Array) -> Float32Array:
        """Let heights (nx, ny) of the nodes inside go on outside, each as at the nearest node."""
        return np.asarray(heights_mm.ravel()[self.nearest], np.float32)

    def steps_in(self, length_mm: float) -> int:
        """Return how many steps of the grid fit into a length, at least one."""
        return max(int(length_mm / self.step_mm + 1e-9), 1)

    def with_floor(self, floor_mm: float | Float32Array) -> Surface:
        """Return the surface with other heights beside the solids: one, or that of each node."""
        floor = np.broadcast_to(np.float32(floor_mm), self.inside.shape)
        heights = np.where(self.inside, self.heights_mm, floor)
        return replace(self, heights_mm=heights, floor_mm=float(floor.min()))


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
    seen = np.full(tuple(count), -np.inf, np.float32)
    for solid in solids:
        _sample_heights(solid, low, step_mm, seen)
    inside = seen > -np.inf
    heights = np.where(inside, seen, np.float32(0))
    parts = [_sharp_edges(solid, step_mm) for solid in solids]
    edges, normals, peaks = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Surface(step_mm, low, heights, inside, edges, normals, peaks, tuple(solids), 0.0)


def _sample_heights(
    solid: TriangleMesh, first_mm: FloatArray, step_mm: float, heights: Float32Array
) -> None:
    """Raise the heights of the grid to those of one solid."""
    upward = solid.triangle_normals[:, 2] > 0
    raise_to_triangles(solid.vertices[solid.triangles[upward]], first_mm, step_mm, heights)


def _sharp_edges(solid: TriangleMesh, step_mm: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return samples (k, 3) of the ridges, normals (k, 2, 3) beside them, and their ends (m, 3)."""
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
    opposite = solid.vertices[solid.triangles[second // 3, (second % 3 + 2) % 3]]
    fall = ((opposite - solid.vertices[ends[first, 0]]) * normals[first // 3]).sum(axis=1)
    convex = upward & (fall < 0)
    bent = convex & (cosine < np.cos(np.radians(_SHARP_DEG)))
    at_peak = np.zeros(count, bool)
    at_peak[ends[first[bent]]] = True
    beside = at_peak[ends[first]].any(axis=1) & (cosine < np.cos(np.radians(_EVEN_DEG)))
    ridge = bent | (convex & beside)
    sharp = first[ridge]
    sides = np.stack([normals[first // 3], normals[second // 3]], axis=1)[ridge]
    a, b = np.moveaxis(solid.vertices[ends[sharp]], 1, 0)
    pieces = np.ceil(np.linalg.norm(b - a, axis=1) / step_mm).astype(int) + 1
    edge = np.repeat(np.arange(len(a)), pieces)
    within = np.arange(len(edge)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = (within / np.maximum(pieces - 1, 1)[edge])[:, None]
    samples = a[edge] * (1 - share) + b[edge] * share
    return samples, sides[edge], solid.vertices[at_peak]
