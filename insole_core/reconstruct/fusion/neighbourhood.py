"""The neighbourhood of a reading: the features from which a network predicts its error.

They are the readings at two scales, and the shading, for the grooves that no reading shows.
"""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray, IntArray

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
