"""The colour of every depth pixel (thesis 4.3)."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray
from insole_core.recording.session import View
from insole_core.sensing.sensor import Sensor


def mean_color(view: View) -> ByteArray:
    """Return the mean of a view's colour frames, (height, width, 3) uint8, RGB.

    The frames are read one at a time to save memory.
    """
    if view.color_count == 1:
        return view.read_color(0)
    total = np.asarray(view.read_color(0), dtype=np.float32)
    for index in range(1, view.color_count):
        total += view.read_color(index)
    return np.asarray(np.rint(total / view.color_count), dtype=np.uint8)


def color_points(
    points: FloatArray, wanted: BoolArray, color: ByteArray, sensor: Sensor
) -> ByteArray:
    """Look up the colours of depth pixels by bilinear interpolation, thesis (13) - (15).

    Parameters
    ----------
    points : (height, width, 3) float64, mm, depth camera frame
    wanted : (height, width) bool
        Pixels whose colour is needed; the others become black.
    color : (color_height, color_width, 3) uint8, RGB
        Image of the sensor's colour camera.

    Returns
    -------
    (height, width, 3) uint8, RGB
    """
    colors = np.zeros((*wanted.shape, 3), dtype=np.uint8)
    if not wanted.any():
        return colors
    pixels = sensor.color_pixels(points[wanted]).astype(np.float32)
    found = cv2.remap(
        color, pixels[:, None], None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    colors[wanted] = found[:, 0]
    return colors
