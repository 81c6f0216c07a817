"""The neighbourhood of a reading: features, shading, sharp steps, and how familiar it is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView

_CENTRE_PX = 2.0
_SCALES = ((1.0, 2), (2.5, 5))
"""Blur and spacing of the two grids, px: near and far."""
_REACH = 4
_SIDE = 2 * _REACH + 1
_LEAST_SUPPORT = 0.15
_UNIT_RAW = 4.0
_FARTHEST = 4.0
_SHADING_STEP, _UNIT_SHADING = 2, 0.4
_MIDDLE_MM, _SPREAD_MM = 1.3, 0.25
_GRIDS = 2 * len(_SCALES) + 1
_GRID_COUNT = _GRIDS * _SIDE**2
FEATURES = _GRID_COUNT + 1
_NEAR_PX, _AROUND_PX = 1.0, 5.0
_DARK_LEVELS = 8.0
"""Added to both brightnesses, so that noise in nearly black parts has little effect."""
_MOST = 1.0
_BLUR_SHARE = 1 / 1280
"""Standard deviation of the blur per image width: about the resolution of the readings."""
_ACROSS_PX = 4
"""From a step to the readings on both sides of it: half of a matching window."""
_STEP_PX = 7
_SMOOTH_RAW, _STEP_RAW = 6.5, 9.5
"""Heights of a step up to which the surroundings count as smooth, and beyond which they do not:
about 11 and 16 mm at a distance of 780 mm."""
_OUTLINE_RAW = 40.0
"""What falls by more is the outline, against what lies far behind."""
_AXES = 48
_LEARNT, _FOREIGN = 4.0, 9.0
"""Distances, in units of the mean square of the learnt ones, up to which surroundings count as
learnt, and beyond which nothing is said of them: among feet that were held back 3 % exceed the
one, and 0.1 % the other."""


def support(raw: FloatArray) -> Float32Array:
    """Compute the known share of a small Gaussian around each pixel (height, width), 0 to 1."""
    return _blur(np.isfinite(raw).astype(np.float32), _SCALES[0][0])


def neighbourhoods(
    raw: FloatArray,
    shading: Float32Array,
    pixel_mm: FloatArray,
    rows: IntArray,
    columns: IntArray,
) -> Float32Array:
    """Compute the features of some pixels: their neighbourhoods relative to the mean close to them.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        NaN = unknown.
    shading : (height, width) float32
        See `find_shading`.
    pixel_mm : (n,) float64
        Width of a pixel at the surface there.
    rows, columns : (n,) int64
        The pixels.

    Returns
    -------
    (n, FEATURES) float32, mostly between -1 and 1
    """
    known = np.isfinite(raw)
    share = known.astype(np.float32)
    values = np.where(known, raw - np.nanmedian(raw), 0).astype(np.float32)
    centre = mean_of_known(values, share, _CENTRE_PX)[0][rows, columns, None, None]
    found: list[Float32Array] = []
    for blur_px, step in _SCALES:
        mean, weight = mean_of_known(values, share, blur_px)
        seen = _grids(np.where(weight > _LEAST_SUPPORT, weight, 0), step, rows, columns)
        height = (_grids(mean, step, rows, columns) - centre) / np.float32(_UNIT_RAW)
        found += [np.clip(height, -_FARTHEST, _FARTHEST) * (seen > 0), seen - np.float32(0.5)]
    found.append(_grids(shading / np.float32(_UNIT_SHADING), _SHADING_STEP, rows, columns))
    flat = [part.reshape(len(rows), _SIDE**2) for part in found]
    return np.concatenate([*flat, _size(pixel_mm)], axis=1)


def level(pixel_mm: FloatArray) -> Float32Array:
    """Compute the features (n, FEATURES) of points on an infinite wall that faces the sensor.

    Parameters
    ----------
    pixel_mm : (n,) float64
        Width of a pixel at the wall.
    """
    heights, seen = (np.full((len(pixel_mm), _SIDE**2), value, np.float32) for value in (0, 0.5))
    grids = [heights, seen] * len(_SCALES) + [heights]
    return np.concatenate([*grids, _size(pixel_mm)], axis=1)


def _size(pixel_mm: FloatArray) -> Float32Array:
    return ((pixel_mm - _MIDDLE_MM) / _SPREAD_MM).astype(np.float32)[:, None]


def mirrored(features: Float32Array) -> Float32Array:
    """Return the features (n, FEATURES) of the same places on the mirrored foot."""
    grids = features[:, :_GRID_COUNT].reshape(len(features), -1, _SIDE, _SIDE)[..., ::-1]
    return np.concatenate([grids.reshape(len(features), -1), features[:, _GRID_COUNT:]], axis=1)


def mean_of_known(
    values: Float32Array, share: Float32Array, blur_px: float
) -> tuple[Float32Array, Float32Array]:
    """Compute the Gaussian mean of the known pixels, and their weight.

    Parameters
    ----------
    values, share : (height, width) float32
        Both 0 where unknown; the share is 1 where known.
    blur_px
        Standard deviation of the Gaussian.

    Returns
    -------
    mean : (height, width) float32
    weight : (height, width) float32
        Known share of the Gaussian, 0 to 1.
    """
    weight = _blur(share, blur_px)
    mean = _blur(values, blur_px) / np.maximum(weight, np.float32(1e-3))
    return np.asarray(mean, np.float32), weight


def _blur(image: Float32Array, sigma_px: float) -> Float32Array:
    return np.asarray(cv2.GaussianBlur(image, (0, 0), sigma_px, borderType=cv2.BORDER_CONSTANT))


def _grids(image: Float32Array, step: int, rows: IntArray, columns: IntArray) -> Float32Array:
    """Return the values (n, side, side) on a grid of the spacing `step` around each pixel."""
    reach = _REACH * step
    padded = np.pad(image, reach)
    windows = np.lib.stride_tricks.sliding_window_view(padded, (2 * reach + 1, 2 * reach + 1))
    return np.ascontiguousarray(windows[rows, columns, ::step, ::step])


def find_shading(reading: DepthView) -> Float32Array:
    """Look up the shading (height, width) of all readings in their colour image.

    It is 0 without a reading and outside of the colour image.
    """
    camera = reading.sensor.color_camera
    levels = cv2.cvtColor(reading.color, cv2.COLOR_RGB2GRAY)
    evened = cv2.GaussianBlur(levels, (0, 0), camera.width * _BLUR_SHARE)
    where = np.full((*reading.raw.shape, 2), -1, np.float32)
    in_color = transform(inverse(reading.color2reference), reading.surface_points)
    where[reading.known] = camera.project(in_color)
    seen = cv2.remap(evened, where[..., 0], where[..., 1], cv2.INTER_LINEAR)
    last = [camera.width - 1, camera.height - 1]
    in_picture = np.all((where >= 0) & (where <= last), axis=-1)
    return shading_of(seen.astype(float), np.asarray(in_picture))


def shading_of(levels: FloatArray, known: BoolArray) -> Float32Array:
    """Compare the brightness of each pixel with that of its surroundings.

    Parameters
    ----------
    levels : (height, width) float64
        Brightness, 0 to 255.
    known : (height, width) bool
        Pixels of the foot whose brightness is known.

    Returns
    -------
    (height, width) float32
        Natural logarithm of the ratio, -1 (dark) to 1; 0 where unknown.
    """
    share, seen = known.astype(np.float32), np.where(known, levels, 0).astype(np.float32)
    near, around = (
        mean_of_known(seen, share, blur_px)[0] + _DARK_LEVELS for blur_px in (_NEAR_PX, _AROUND_PX)
    )
    return np.where(known, np.clip(np.log(near / around), -_MOST, _MOST), np.float32(0))


def smoothness(raw: FloatArray) -> Float32Array:
    """Compute how far a reading lies off sharp steps, from the readings alone.

    The height of a step is what a surface falls across a pixel beyond what its slopes on both
    sides explain.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        NaN = no reading.

    Returns
    -------
    (height, width) float32
        1 where there is no step, 0 beside one of 9.5 raw units and more.
    """
    highest = np.maximum(_step_heights(raw), _step_heights(raw.T).T)
    highest[highest > _OUTLINE_RAW] = 0
    near = cv2.dilate(highest, np.ones((_STEP_PX, _STEP_PX), np.uint8))
    return np.asarray(np.clip((_STEP_RAW - near) / (_STEP_RAW - _SMOOTH_RAW), 0, 1), np.float32)


def _step_heights(raw: FloatArray) -> Float32Array:
    """Return the heights (height, width) of steps along the columns; 0 where unknown."""
    across = _ACROSS_PX
    heights = np.zeros(raw.shape, np.float32)
    if len(raw) <= 4 * across:
        return heights
    far_before, before = raw[: -4 * across], raw[across : -3 * across]
    behind, far_behind = raw[3 * across : -across], raw[4 * across :]
    slope = np.maximum(np.abs(before - far_before), np.abs(far_behind - behind)) * 2
    heights[2 * across : -2 * across] = np.nan_to_num(np.abs(behind - before) - slope)
    return np.maximum(heights, 0)


@dataclass(frozen=True, eq=False)
class Familiarity:
    """The distribution of learnt features: its mean and its main directions.

    Parameters
    ----------
    middle : (FEATURES,) float32
    axes : (FEATURES, k) float32
        Orthonormal principal directions.
    variances : (k,) float32
        Along them.
    rest : float
        Mean square of what the directions leave.
    """

    middle: Float32Array
    axes: Float32Array
    variances: Float32Array
    rest: float

    @staticmethod
    def of(blocks: Iterable[Float32Array]) -> Familiarity:
        """Learn the distribution of features, given in blocks (n, FEATURES)."""
        count, total, products = 0, 0.0, 0.0
        for block in blocks:
            values = block.astype(float)
            count += len(values)
            total = total + values.sum(axis=0)
            products = products + values.T @ values
        middle = np.asarray(total) / count
        spread, axes = np.linalg.eigh(np.asarray(products) / count - np.outer(middle, middle))
        rest = float(spread[:-_AXES].sum())
        spread, axes = spread[: -_AXES - 1 : -1], axes[:, : -_AXES - 1 : -1]
        return Familiarity(
            np.asarray(middle, np.float32),
            np.asarray(axes, np.float32),
            np.asarray(spread, np.float32),
            rest,
        )

    def share(self, features: Float32Array) -> Float32Array:
        """Compute how much of a prediction counts.

        Parameters
        ----------
        features : (n, FEATURES) float32

        Returns
        -------
        (n,) float32
            1 in learnt surroundings, 0 in surroundings that are unlike any of them.
        """
        off = features - self.middle
        along = off @ self.axes
        within = (along**2 / self.variances).mean(axis=1)
        beside = ((off**2).sum(axis=1) - (along**2).sum(axis=1)) / np.float32(self.rest)
        distance = np.maximum(within, beside)
        return np.asarray(np.clip((_FOREIGN - distance) / (_FOREIGN - _LEARNT), 0, 1))
