"""What the sensor's window makes of a surface: it reports the mean of what lies in it."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray

WINDOW_PX = 9
"""Side of the square that the sensor compares with its pattern (Konolige & Mihelich)."""
_LARGEST_SPREAD_RAW = 16.0
"""Two pixels of disparity: beyond it parts of a window no longer match together."""
_NOISE_RAW = 0.15
"""Smaller corrections than this are as likely noise of the mesh as shape of the foot."""
_LARGEST_RAW = 2.0
_LEAST_LIGHT = 0.02


def window_error(raw: FloatArray, light: FloatArray) -> FloatArray:
    """By how much what the sensor reports differs from what is in the middle of its window.

    The dots in a window count as they are lit. So the side that faces the sensor counts more, rims
    appear nearer than they are, and rounded shapes flatter. Where a window looks over an edge
    nothing is said.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        What is there, as far as it is known; NaN = nothing.
    light : (height, width) float64
        Brightness, the cosine of the incidence.

    Returns
    -------
    (height, width) float64, raw units; 0 where it is no larger than the noise of what is known
    """
    error = _mean_minus_middle(raw, np.clip(light, _LEAST_LIGHT, 1))
    shrunk = np.sign(error) * np.maximum(np.abs(error) - _NOISE_RAW, 0)
    return np.asarray(np.clip(shrunk, -_LARGEST_RAW, _LARGEST_RAW))


def _mean_minus_middle(raw: FloatArray, light: FloatArray) -> FloatArray:
    known = np.isfinite(raw)
    if not known.any():
        return np.zeros_like(raw)
    values = np.where(known, raw - np.nanmedian(raw), 0)
    light = np.where(known, light, 0)
    error = _sum(light * values) / np.maximum(_sum(light), 1e-9) - values
    return np.where(known & _is_one_surface(values, known), error, 0)


def _sum(image: FloatArray) -> FloatArray:
    size = (WINDOW_PX, WINDOW_PX)
    return np.asarray(
        cv2.boxFilter(image, -1, size, normalize=False, borderType=cv2.BORDER_CONSTANT)
    )


def _is_one_surface(values: FloatArray, known: BoolArray) -> BoolArray:
    kernel = np.ones((WINDOW_PX, WINDOW_PX), np.uint8)
    highest = cv2.dilate(np.where(known, values, -1e9), kernel)
    lowest = cv2.erode(np.where(known, values, 1e9), kernel)
    return np.asarray(highest - lowest < _LARGEST_SPREAD_RAW)
