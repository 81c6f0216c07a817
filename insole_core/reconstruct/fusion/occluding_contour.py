"""The occluding contour of the foot in a colour image, to a fraction of a pixel, and its rays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.silhouette import Silhouette

_EVENED_PX = 2.0
_STEP_PX = 0.25
_ACROSS_PX = np.arange(-7.0, 5.0 + _STEP_PX / 2, _STEP_PX)
"""Positions across the outline, outwards, at which the colours are looked up."""
_INSIDE_PX, _OUTSIDE_PX = (-2.5, -1.0), 3.0
"""Range of positions where the skin's colour is sampled, close to the edge because the skin is
shaded towards it, and position from which on the background is sampled."""
_LEVEL = 0.37
"""Share of skin where the search for the edge begins, coming from outside."""
_SHADED_PX = (-4.0, -1.5)
"""Range of positions, from the edge, that tell how the skin is shaded up to it."""
_BLUR_PX = 0.8
"""Standard deviation of the picture's blur."""
_HALF = 0.42
"""What a blurred picture shows at an edge of even skin: less than a half, because the skin of a
round foot darkens the more, the nearer its edge is."""
_DARKEST = 0.15
"""Least share of skin at an edge."""
_ABOVE_NOISE = 2.0
"""How far the level lies above the background, in shares of its spread; noise would be the edge."""
_ROUNDS = 3
"""After which an edge and the shade up to it hardly move each other any more."""
_LEAST_CONTRAST = 30.0
_ROUGHEST = 0.25
"""Largest spread of the background, per contrast; beyond, the edge may be a different one."""
_FARTHEST_PX = 3.0
_REACH_PX = 12.0
_STRETCH_PX = 3
_DECIMALS = 6
"""Rounding of distances, so that a vertex moved onto the contour lies exactly on it."""


@dataclass(frozen=True, eq=False)
class Beyond:
    """How far points lie beyond the contour of one view; only those near it.

    Parameters
    ----------
    eye_mm : (3,) float64, reference frame
        Centre of the colour camera.
    vertex : (m,) int64
        Index of the point.
    stretch : (m,) int64
        Number of the nearest stretch of the contour.
    outward, rays : (m, 3) float64, reference frame
        Unit vectors: the direction in which the distance grows, and the touching ray.
    beyond_mm : (m,) float64
        Distance from the plane of the touching rays, negative inside.
    """

    eye_mm: FloatArray
    vertex: IntArray
    stretch: IntArray
    outward: FloatArray
    rays: FloatArray
    beyond_mm: FloatArray

    @cached_property
    def outermost(self) -> IntArray:
        """Index, into these arrays, of the outermost point of each stretch."""
        order = np.lexsort((-self.beyond_mm, self.stretch))
        first = np.ones(len(order), dtype=bool)
        first[1:] = np.diff(self.stretch[order]) > 0
        return np.asarray(order[first])

    def facing(self, directions: FloatArray) -> FloatArray:
        """Compute the cosines (m,) between directions of all points (n, 3) and outwards."""
        return np.asarray(np.einsum("mc,mc->m", directions[self.vertex], self.outward))

    def on_ray(self, chosen: IntArray, places: FloatArray) -> FloatArray:
        """Return the points of the touching rays that are nearest to some of the points.

        Parameters
        ----------
        chosen : (k,) int64
            Index into these arrays.
        places : (n, 3) float64, mm, reference frame
            All points.

        Returns
        -------
        (k, 3) float64, mm, reference frame
        """
        rays = self.rays[chosen]
        far = np.einsum("mc,mc->m", places[self.vertex[chosen]] - self.eye_mm, rays)
        return np.asarray(self.eye_mm + far[:, None] * rays)


@dataclass(frozen=True, eq=False)
class OccludingContour:
    """The rays of a view that touch the foot.

    Parameters
    ----------
    reading
    pixels : (k, 2) float64, px
        Positions on the contour in the colour image.
    stretch : (k,) int64
        Number of the stretch, a few pixels long, in which each lies.
    rays, outward : (k, 3) float64, reference frame
        Unit vectors: along the rays, and away from the foot across the contour.
    """

    reading: DepthView
    pixels: FloatArray
    stretch: IntArray
    rays: FloatArray
    outward: FloatArray

    @cached_property
    def _tree(self) -> scipy.spatial.cKDTree:
        return point_tree(self.pixels)

    @property
    def eye_mm(self) -> FloatArray:
        """(3,) centre of the colour camera, reference frame."""
        return np.asarray(self.reading.color2reference[:3, 3])

    def against(self, points: FloatArray) -> Beyond:
        """Measure how far points (n, 3), mm, reference frame, lie beyond the contour near them."""
        camera = self.reading.sensor.color_camera
        pixels = camera.project(transform(inverse(self.reading.color2reference), points))
        found = self._tree.query(pixels, distance_upper_bound=_REACH_PX)
        away_px, nearest = (np.asarray(part) for part in found)
        vertex = np.flatnonzero(np.isfinite(away_px))
        sample = nearest[vertex]
        way = points[vertex] - self.eye_mm
        beyond_mm = np.round(np.einsum("nc,nc->n", way, self.outward[sample]), _DECIMALS)
        across_px = beyond_mm * camera.fx / np.linalg.norm(way, axis=1)
        next_to = away_px[vertex] ** 2 - across_px**2 < _STRETCH_PX**2
        vertex, sample = vertex[next_to], sample[next_to]
        return Beyond(
            self.eye_mm, vertex, self.stretch[sample], self.outward[sample], self.rays[sample],
            beyond_mm[next_to],
        )  # fmt: skip


def find_occluding_contour(reading: DepthView, silhouette: Silhouette) -> OccludingContour | None:
    """Locate the contour of the foot to a fraction of a pixel.

    It is left out where the background has nearly the foot's colour or is uneven.

    Parameters
    ----------
    reading
    silhouette
        The outline to the nearest pixel.

    Returns
    -------
    OccludingContour or None
        None when no part of the contour is certain.
    """
    traced, outwards = _traced(silhouette)
    start = traced + np.array(silhouette.corner)
    across_px, sure = _edges(reading.color, start, outwards)
    if not sure.any():
        return None
    outwards = outwards[sure]
    pixels = start[sure] + across_px[sure, None] * outwards
    along = outwards[:, ::-1] * [1.0, -1.0]
    rays, beside, beyond = (_rays(reading, pixels + way) for way in (0.0, along, outwards))
    normals = np.cross(rays, beside)
    normals *= np.sign(np.einsum("kc,kc->k", normals, beyond))[:, None]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return OccludingContour(reading, pixels, np.flatnonzero(sure) // _STRETCH_PX, rays, normals)


def _traced(silhouette: Silhouette) -> tuple[FloatArray, FloatArray]:
    """Return the outline's pixels (k, 2) in order, in the silhouette's part, and its normals."""
    inside = (silhouette.outside_px < 0).astype(np.uint8)
    outlines, _ = cv2.findContours(inside, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    if not outlines:
        return np.zeros((0, 2)), np.zeros((0, 2))
    traced = max(outlines, key=len)[:, 0, :]
    down, right = np.gradient(cv2.GaussianBlur(silhouette.outside_px, (0, 0), _EVENED_PX))
    u, v = traced.T
    ways = np.stack([right[v, u], down[v, u]], axis=1).astype(float)
    return traced.astype(float), ways / np.maximum(np.linalg.norm(ways, axis=1), 1e-9)[:, None]


def _edges(
    color: ByteArray, start: FloatArray, outwards: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Return how far outwards of each pixel the edge lies (k,), px, and whether it is certain."""
    if len(start) == 0:
        return np.zeros(0), np.zeros(0, dtype=bool)
    where = (start[:, None] + _ACROSS_PX[:, None] * outwards[:, None]).astype(np.float32)
    profile = cv2.remap(
        color, where[..., 0], where[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    ).astype(float)
    beside = profile[:, _ACROSS_PX >= _OUTSIDE_PX]
    background = beside.mean(axis=1)
    skin = profile[:, (_INSIDE_PX[0] <= _ACROSS_PX) & (_INSIDE_PX[1] >= _ACROSS_PX)].mean(axis=1)
    contrast = np.linalg.norm(skin - background, axis=1)
    rough = np.sqrt(((beside - background[:, None]) ** 2).sum(axis=2).mean(axis=1))
    share = np.einsum("kpc,kc->kp", profile - background[:, None], skin - background)
    share /= np.maximum(contrast, 1e-9)[:, None] ** 2
    least = np.minimum(_ABOVE_NOISE * rough / np.maximum(contrast, 1e-9), _LEVEL)
    edges = _outermost_crossing(share, np.full(len(share), _LEVEL))
    for _ in range(_ROUNDS):
        edges = _outermost_crossing(share, np.maximum(_level_of_shaded(share, edges), least))
    sure = (contrast > _LEAST_CONTRAST) & (rough < _ROUGHEST * contrast)
    return edges, sure & (np.abs(edges) < _FARTHEST_PX)


def _level_of_shaded(share: FloatArray, edges: FloatArray) -> FloatArray:
    """Return the share of skin (k,) that a blurred picture shows at the edge of shaded skin.

    Skin darkens towards its edge, about linearly over a few pixels: s(d) = s0 + s1 d, at a depth d.
    Blurred, with nothing beyond, it is s0 / 2 + s1 σ / √(2π) at the edge.
    """
    depth = edges[:, None] - _ACROSS_PX
    weights = ((depth >= -_SHADED_PX[1]) & (depth <= -_SHADED_PX[0])).astype(float)
    total = np.maximum(weights.sum(axis=1), 1.0)
    middle = (weights * depth).sum(axis=1) / total
    mean = (weights * share).sum(axis=1) / total
    away = weights * (depth - middle[:, None])
    slope = (away * share).sum(axis=1) / np.maximum((away * depth).sum(axis=1), 1e-9)
    slope = np.maximum(slope, 0.0)
    at_edge = np.maximum(mean - slope * middle, _DARKEST)
    return np.asarray(_HALF * at_edge + slope * _BLUR_PX / np.sqrt(2 * np.pi))


def _outermost_crossing(share: FloatArray, level: FloatArray) -> FloatArray:
    """Find where, coming from outside, the share of skin first exceeds a level, px."""
    inner = share.shape[1] - 1 - np.argmax(share[:, ::-1] > level[:, None], axis=1)
    inner = np.minimum(inner, share.shape[1] - 2)
    row = np.arange(len(share))
    here, outside = share[row, inner], share[row, inner + 1]
    part = np.clip((here - level) / np.maximum(here - outside, 1e-9), 0, 1)
    return np.asarray(_ACROSS_PX[inner] + part * _STEP_PX)


def _rays(reading: DepthView, pixels: FloatArray) -> FloatArray:
    camera = reading.sensor.color_camera
    ahead = np.column_stack([camera.normalised(pixels), np.ones(len(pixels))])
    rays = ahead @ reading.color2reference[:3, :3].T
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))
