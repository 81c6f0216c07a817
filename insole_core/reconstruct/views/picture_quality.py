"""Faults of a colour picture: dark, overexposed, out of focus."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray
from insole_core.reconstruct.markers.blobs import Blobs, blueness

_DARK = 40
"""Brightness (of 255) exceeded by one pixel in a hundred; 140 and more in a usual picture."""
_MARGIN_PX = 6
_GLARING = 250
_GLARING_SHARE = 0.25
_STEEPEST = 0.15
"""Change per pixel at a marker's rim, as a share of its blueness: 0.33 in a sharp picture, 0.13
when it is blurred by 3 px."""


def picture_fault(color: ByteArray, blobs: Blobs) -> str:
    """Check whether a picture is dark, overexposed or out of focus.

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB
    blobs
        Marker candidates found in `color`; focus is judged at their rims.

    Returns
    -------
    str
        The fault, as the start of a sentence; empty when there is none.
    """
    small = cv2.resize(color, None, fx=0.25, fy=0.25, interpolation=cv2.INTER_AREA)
    red, green, blue = cv2.split(small)
    if np.percentile(cv2.max(cv2.max(red, green), blue), 99) < _DARK:
        return "its colour picture is almost dark; give more light or a longer exposure"
    if (cv2.min(cv2.min(red, green), blue) >= _GLARING).mean() > _GLARING_SHARE:
        return "its colour picture is overexposed; take away light or shorten the exposure"
    if len(blobs) and _sharpness(color, blobs) < _STEEPEST:
        return "its colour picture is out of focus; clean the lens and see that the camera is still"
    return ""


def _sharpness(color: ByteArray, blobs: Blobs) -> float:
    """Compute the steepest relative change of the blueness per pixel of the sharpest blobs."""
    rows, columns = (_extent(np.any(blobs.labels >= 0, axis=axis)) for axis in (1, 0))
    labels = blobs.labels[rows, columns]
    blue = cv2.GaussianBlur(blueness(color[rows, columns]).astype(np.float32), (0, 0), 0.7)
    along_u, along_v = (
        cv2.Sobel(blue, cv2.CV_32F, du, dv, ksize=1, scale=0.5) for du, dv in ((1, 0), (0, 1))
    )
    label = cv2.dilate((labels + 1).astype(np.float32), np.ones((5, 5), np.uint8))
    at = label > 0
    index = label[at].astype(np.int64) - 1
    order = np.argsort(index, kind="stable")
    starts = np.searchsorted(index[order], np.arange(len(blobs)))
    steepest = np.maximum.reduceat(np.hypot(along_u, along_v)[at][order], starts)
    bluest = np.maximum.reduceat(blue[at][order], starts)
    return float(np.percentile(steepest / np.maximum(bluest, 1), 75))


def _extent(occupied: BoolArray) -> slice:
    """Return the occupied span, with the margin that a blur needs."""
    index = np.flatnonzero(occupied)
    return slice(max(int(index[0]) - _MARGIN_PX, 0), int(index[-1]) + _MARGIN_PX + 1)
