"""The colour of every depth pixel (thesis 4.3)."""

from __future__ import annotations

from collections.abc import Iterable

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray
from insole_core.recording.session import View
from insole_core.sensing.sensor import Sensor


def steady_color(view: View) -> ByteArray:
    """Return one colour image from all frames of a view, (height, width, 3) uint8, RGB.

    It is the mean of medians of three frames each, of which each is as far from the next as can be:
    what covers a place in less than a third of the series, all at a stretch, leaves no trace there.
    Three frames are held at a time, however many there are; of two the mean is taken, and one or
    two in the middle that make no three are not needed.
    """
    count = view.color_count
    if count == 1:
        return view.read_color(0)
    triples = count // 3
    if triples == 0:
        return _mean([view.read_color(0), view.read_color(1)])
    starts = (0, (count - triples) // 2, count - triples)
    return _mean(
        _median_of_three(*(view.read_color(start + index) for start in starts))
        for index in range(triples)
    )


def _median_of_three(first: ByteArray, second: ByteArray, third: ByteArray) -> ByteArray:
    low, high = cv2.min(first, second), cv2.max(first, second)
    return np.asarray(cv2.max(low, cv2.min(high, third)), dtype=np.uint8)


def _mean(images: Iterable[ByteArray]) -> ByteArray:
    total, count = np.zeros(1, dtype=np.float32), 0
    for image in images:
        total, count = total + image, count + 1
    return np.asarray(np.rint(total / count), dtype=np.uint8)


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
