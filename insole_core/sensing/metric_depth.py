"""Sensors that deliver millimetres: their numbers as raw units, in which readings are averaged.

Of a stereo camera a raw unit is an eighth of a pixel of disparity, as of a Kinect v1, and grows
with the distance, so that noise is uniform and all that is stated in raw units holds for both. Of
any other sensor it is a millimetre.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import cast

import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, Float32Array, FloatArray, RawArray
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.pinhole_camera import PinholeCamera

RAW_PER_PX = 8
NUMBERS_PER_RAW = 8
"""Readings are averaged as whole numbers of this part of a raw unit, 1/64 px."""
NO_NUMBER = NO_READING * NUMBERS_PER_RAW
_MOST_STORED = 65535
_JUMP_RAW = 8.0
_FOCAL_PX = 585.0
"""That of a Kinect: with as many readings per millimetre all that is stated in pixels holds."""


@dataclass(frozen=True)
class StereoDisparity:
    """Conversion by the disparity of a rectified pair of cameras: Z = f b / d.

    Parameters
    ----------
    focal_px
        f, of the depth camera.
    baseline_mm
        b.
    """

    focal_px: float
    baseline_mm: float

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = 8 f b / (2047 - raw)."""
        eighths_px = NO_READING - np.asarray(raw, dtype=float)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(eighths_px > 0, self._eighths_mm / eighths_px, np.nan)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw units of depths; inverse of `depth_mm`."""
        return np.asarray(NO_READING - self._eighths_mm / np.asarray(depth_mm, dtype=float))

    @property
    def _eighths_mm(self) -> float:
        return RAW_PER_PX * self.focal_px * self.baseline_mm


@dataclass(frozen=True)
class PlainDepth:
    """Depth of which nothing is known but its millimetres."""

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Z = raw."""
        depth_mm = np.asarray(raw, dtype=float)
        with np.errstate(invalid="ignore"):
            return np.where(depth_mm > 0, depth_mm, np.nan)

    def raw(self, depth_mm: FloatArray) -> FloatArray:
        """Return the raw units of depths; inverse of `depth_mm`."""
        return np.asarray(depth_mm, dtype=float)


MetricModel = StereoDisparity | PlainDepth


def numbers_of(stored: RawArray, unit_mm: float, disparity: MetricModel) -> RawArray:
    """Convert a stored depth frame to whole numbers of an eighth of a raw unit.

    Parameters
    ----------
    stored : (height, width) uint16, `unit_mm`, 0 = no reading
    unit_mm
    disparity

    Returns
    -------
    (height, width) uint16
        16376 = no reading, as is what lies outside of the raw units of the family.
    """
    return _numbers(unit_mm, disparity)[stored]


@lru_cache(4)
def _numbers(unit_mm: float, disparity: MetricModel) -> RawArray:
    """Return the number (65536,) of every number that a frame can hold."""
    depth_mm = np.arange(1.0, _MOST_STORED + 1) * unit_mm
    numbers = np.rint(disparity.raw(depth_mm) * NUMBERS_PER_RAW)
    inside = (numbers >= 0) & (numbers < NO_NUMBER)
    table = np.concatenate([[NO_NUMBER], np.where(inside, numbers, NO_NUMBER)])
    return np.asarray(table, dtype=np.uint16)


def raw_of(stored: RawArray, unit_mm: float, disparity: MetricModel) -> RawArray:
    """Convert a stored depth frame to whole raw units, 2047 = no reading (see `numbers_of`)."""
    return _raw(unit_mm, disparity)[stored]


@lru_cache(4)
def _raw(unit_mm: float, disparity: MetricModel) -> RawArray:
    """Return the raw number (65536,) of every number that a frame can hold."""
    numbers = _numbers(unit_mm, disparity) + NUMBERS_PER_RAW // 2
    return np.asarray(numbers // NUMBERS_PER_RAW, np.uint16)


def bin_size(camera: PinholeCamera) -> int:
    """Return how many pixels across are one reading: those that a Kinect has one for.

    Neighbouring pixels share their matching window, so nothing is lost.
    """
    return max(1, round(camera.fx / _FOCAL_PX))


def binned(numbers: RawArray, size: int) -> RawArray:
    """Take the mean of squares of pixels, where most measured one surface.

    Parameters
    ----------
    numbers : (height, width) uint16, 16376 = no reading
    size
        Of a square, px.

    Returns
    -------
    (height // size, width // size) uint16, 16376 = no reading
    """
    if size == 1:
        return numbers
    known = numbers < NO_NUMBER
    filled = np.where(known, numbers, np.uint16(0))
    low = np.minimum.reduce(_in_squares(numbers, size))
    high = np.maximum.reduce(_in_squares(filled, size))
    total = np.add.reduce(_in_squares(filled, size), dtype=np.uint32)
    count = np.add.reduce(_in_squares(known, size), dtype=np.uint16)
    jumps = high.astype(np.int32) - low >= _JUMP_RAW * NUMBERS_PER_RAW
    mean = np.rint(total / np.maximum(count, 1))
    one_surface = (2 * count >= size**2) & ~jumps
    return np.where(one_surface, mean, NO_NUMBER).astype(np.uint16)


def _in_squares(image: RawArray | BoolArray, size: int) -> list[RawArray | BoolArray]:
    """Return the first pixel of every square, then the second, and so on."""
    height, width = (side // size * size for side in image.shape)
    return [
        image[row:height:size, column:width:size] for row in range(size) for column in range(size)
    ]


def binned_camera(camera: PinholeCamera, size: int) -> PinholeCamera:
    """Return the camera of `binned` images."""
    if size == 1:
        return camera
    middle = (size - 1) / 2
    return replace(
        camera,
        width=camera.width // size,
        height=camera.height // size,
        fx=camera.fx / size,
        fy=camera.fy / size,
        cx=(camera.cx - middle) / size,
        cy=(camera.cy - middle) / size,
        skew=camera.skew / size,
    )


def finer_camera(camera: PinholeCamera, size: int) -> PinholeCamera:
    """Return the camera of the pixels; inverse of `binned_camera`, but for cut edges."""
    middle = (size - 1) / 2
    return replace(
        camera,
        width=camera.width * size,
        height=camera.height * size,
        fx=camera.fx * size,
        fy=camera.fy * size,
        cx=camera.cx * size + middle,
        cy=camera.cy * size + middle,
        skew=camera.skew * size,
    )


def spread_map(
    values: Float32Array | ByteArray, size: int, height: int, width: int
) -> Float32Array | ByteArray:
    """Give every pixel (height, width) the value of its square; inverse of `binned_map`."""
    spread = values.repeat(size, axis=0).repeat(size, axis=1)
    missing = [(0, height - spread.shape[0]), (0, width - spread.shape[1])]
    return cast("Float32Array | ByteArray", np.pad(spread, missing, mode="edge"))


def binned_map(values: Float32Array | ByteArray, size: int) -> Float32Array:
    """Take the mean (height // size, width // size) of squares of a map without gaps."""
    height, width = (side // size for side in values.shape)
    squares = values[: height * size, : width * size].reshape(height, size, width, size)
    return np.asarray(squares.mean(axis=(1, 3)), np.float32)
