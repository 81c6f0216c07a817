"""The pair of infrared pictures of a stereo camera, of which the right one is the pattern."""

from __future__ import annotations

import math
from typing import NamedTuple

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.recording.session import InfraredPictures, View
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.infrared_reference import (
    GREATEST,
    RAW_PER_PX,
    InfraredReference,
    check_picture,
)

_FIRST_PX, _REST_RAW = divmod(NO_READING, RAW_PER_PX)
"""Place of the right picture's first column in its pattern."""
_FINE = 4
"""Columns of the pattern per pixel of the right picture."""
_USUAL_NOISE = math.sqrt(2)
"""Both pictures have speckle and noise of their own."""
_SATURATED_SHARE = 0.2
"""The brightest dots of a near foot are saturated in both pictures alike, which does no harm."""
_AROUND_PX = 16.0
"""Standard deviation of the surroundings, relative to whose brightness the pattern is."""
_REDUCED = 4


class _Pair(NamedTuple):
    left: InfraredPictures
    right: InfraredPictures


def pair_of(view: View) -> _Pair | None:
    """Return the infrared pictures of both cameras of a view; None where it has none."""
    pair = [view.infrared.get(f"infrared_{eye}") for eye in ("left", "right")]
    left, right = pair
    if left is None or right is None or view.sensor.baseline_mm is None:
        return None
    return _Pair(left, right)


def pair_view(view: View, pair: _Pair) -> InfraredView:
    """Return the left pictures of a view, with the right ones as the pattern.

    A surface of the disparity d shows at pixel u of the left picture what the right one shows at
    u - d, and d = (2047 - raw) / 8.

    Parameters
    ----------
    view
        With the lattice of its readings in the place of its sensor's pixels.
    pair

    Returns
    -------
    InfraredView
        On the pixels of the pictures.

    Raises
    ------
    InputError
        When the pictures are black or saturated; as the end of a sentence on the view.
    """
    left, right = map(_mean, pair)
    height, width = left.shape
    camera, own = view.sensor.depth_camera, view.sensor.correction
    finer = width // camera.width
    if own is None:
        correction = DisparityCorrection(np.zeros((height, width), np.float32))
    else:
        correction = own.spread(finer, height, width)
    reference = InfraredReference(_pattern(right), _FIRST_PX, _FINE, correction)
    return InfraredView(left, reference, finer, _USUAL_NOISE)


def _mean(pictures: InfraredPictures) -> Float32Array:
    mean = pictures.mean()
    check_picture(mean * (GREATEST / (2.0**pictures.bits - 1)), _SATURATED_SHARE)
    return mean.astype(np.float32)


def _pattern(picture: Float32Array) -> Float32Array:
    """Return a picture relative to its surroundings, with `_FINE` columns per pixel."""
    around, area = map(_around, (picture, (picture > 0).astype(np.float32)))
    relative = picture / np.maximum(around / np.maximum(area, 1e-3), 1.0)
    height, width = picture.shape
    columns = (width + 1) * _FINE
    to_picture = np.array([[1 / _FINE, 0.0, -_REST_RAW / RAW_PER_PX], [0.0, 1.0, 0.0]])
    how = cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP
    return np.asarray(
        cv2.warpAffine(relative, to_picture, (columns, height), flags=how), np.float32
    )


def _around(picture: Float32Array) -> Float32Array:
    """Blur by `_AROUND_PX`, at reduced size: so wide a blur has nothing finer."""
    height, width = picture.shape
    reduced = cv2.resize(
        picture, (width // _REDUCED, height // _REDUCED), interpolation=cv2.INTER_AREA
    )
    blurred = cv2.GaussianBlur(reduced, (0, 0), _AROUND_PX / _REDUCED)
    return np.asarray(cv2.resize(blurred, (width, height)), np.float32)
