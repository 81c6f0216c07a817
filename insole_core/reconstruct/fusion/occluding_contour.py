"""The outline of the foot between the pixels of a colour image, and the planes it touches."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.silhouette import Silhouette

_EVENED_PX = 2.0
_STEP_PX = 0.25
_ACROSS_PX = np.arange(-4.0, 5.0 + _STEP_PX / 2, _STEP_PX)
"""Positions across the outline, outwards, at which the colours are looked up."""
_INSIDE_PX, _OUTSIDE_PX = (-2.5, -1.0), 3.0
"""The skin is taken from between these positions, next to the edge, because it is shaded towards
it; the background from there on."""
_LEVEL = 0.37
"""Share of skin at the edge, counted from outside: below a half, as the skin grows darker to the
very edge, which a blurred picture shows farther in."""
_LEAST_CONTRAST = 30.0
_ROUGHEST = 0.25
"""Spread of the background in shares of the contrast, from which on the edge may be another one."""
_FARTHEST_PX = 3.0
_REACH_PX = 12.0
_STRETCH_PX = 3
_DECIMALS = 6
"""What was drawn onto an outline lies on it, and not on either side by its last bits."""


@dataclass(frozen=True, eq=False)
class Beyond:
    """How far places lie beyond the outline of one view; only those near it.

    Parameters
    ----------
    eye_mm : (3,) float64, reference frame
    vertex : (m,) int64
        Index of the place.
    stretch : (m,) int64
        Number of the stretch of the outline that is next.
    outward, rays : (m, 3) float64
        Direction in which the distance grows, and of the ray that touches, unit length.
    beyond_mm : (m,) float64
    """

    eye_mm: FloatArray
    vertex: IntArray
    stretch: IntArray
    outward: FloatArray
    rays: FloatArray
    beyond_mm: FloatArray

    @cached_property
    def outermost(self) -> IntArray:
        """Index, into these arrays, of the outermost place of each stretch."""
        order = np.lexsort((-self.beyond_mm, self.stretch))
        first = np.ones(len(order), dtype=bool)
        first[1:] = np.diff(self.stretch[order]) > 0
        return np.asarray(order[first])

    def facing(self, directions: FloatArray) -> FloatArray:
        """Cosine (m,) between directions of all places (n, 3) and the way outwards."""
        return np.asarray(np.einsum("mc,mc->m", directions[self.vertex], self.outward))

    def on_ray(self, chosen: IntArray, places: FloatArray) -> FloatArray:
        """Give the points of the rays next to some of all places (n, 3)."""
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
        Places on the outline, in the colour image.
    stretch : (k,) int64
        Number of the stretch of a few pixels that each lies in.
    rays, outward : (k, 3) float64, reference frame
        Unit vectors: along the rays, and away from the foot across the outline.
    """

    reading: DepthView
    pixels: FloatArray
    stretch: IntArray
    rays: FloatArray
    outward: FloatArray

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.pixels)

    @property
    def eye_mm(self) -> FloatArray:
        """(3,) where the rays come from, reference frame."""
        return np.asarray(self.reading.color2reference[:3, 3])

    def against(self, points: FloatArray) -> Beyond:
        """Hold places (n, 3), reference frame, against the outline next to them."""
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
    """Find where the outline lies between the pixels; None where its colours do not tell.

    Where the outline runs over something of nearly the foot's colour, or over what is not even,
    it is left out.
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
    """Pixels (k, 2) of the outline in order, in the silhouette's part, and the ways outwards."""
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
    """How far outwards of each pixel the edge lies (k,), px, and whether it is one for certain."""
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
    edges = _outermost_crossing(share / np.maximum(contrast, 1e-9)[:, None] ** 2)
    sure = (contrast > _LEAST_CONTRAST) & (rough < _ROUGHEST * contrast)
    return edges, sure & (np.abs(edges) < _FARTHEST_PX)


def _outermost_crossing(share: FloatArray) -> FloatArray:
    """Where, coming from outside, the share of skin first passes the level, px."""
    inner = share.shape[1] - 1 - np.argmax(share[:, ::-1] > _LEVEL, axis=1)
    inner = np.minimum(inner, share.shape[1] - 2)
    row = np.arange(len(share))
    here, outside = share[row, inner], share[row, inner + 1]
    part = np.clip((here - _LEVEL) / np.maximum(here - outside, 1e-9), 0, 1)
    return np.asarray(_ACROSS_PX[inner] + part * _STEP_PX)


def _rays(reading: DepthView, pixels: FloatArray) -> FloatArray:
    camera = reading.sensor.color_camera
    ahead = np.column_stack([camera.normalised(pixels), np.ones(len(pixels))])
    rays = ahead @ reading.color2reference[:3, :3].T
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))
