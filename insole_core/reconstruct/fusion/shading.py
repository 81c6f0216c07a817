"""Shading: how much darker a point of the foot looks than its surroundings.

The grooves between toes that touch are narrower than the sensor's window, so the readings do not
show them; in the colour image they are dark.
"""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.neighbourhood import mean_of_known

_NEAR_PX, _AROUND_PX = 1.0, 5.0
_DARK_LEVELS = 8.0
"""Added to both brightnesses, so that noise in nearly black parts has little effect."""
_MOST = 1.0
_BLUR_SHARE = 1 / 1280
"""Standard deviation of the blur per image width: about the resolution of the readings."""


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
