"""From raw numbers to millimetres and onto the colour image, by the factory's own calibration.

PROTOCOL.md, section 6. The tables equal libfreenect's wherever its values mean anything; for
scanning use `depth_mm`, which is not cut to whole millimetres.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kinect_v1.calibration import Calibration, RegistrationInfo
from kinect_v1.pixels import NO_READING, RawArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

WIDTH, HEIGHT = 640, 480
FARTHEST_MM = 10_000
_RAW_VALUES = 2048
_OUTSIDE = 2 * WIDTH
_SUBPIXEL = 256
_FRACTION = 2.0**17


def depth_mm(raw: NDArray[np.generic], calibration: Calibration) -> FloatArray:
    """Convert raw 11-bit numbers, whole or averaged, to depth along the optical axis.

    Parameters
    ----------
    raw : (...) any number
    calibration

    Returns
    -------
    (...) float64, mm; NaN where nothing was measured, and at or past 10 m
    """
    plane = calibration.zero_plane
    numbers = np.asarray(raw, np.float64)
    m = (numbers / 4 - calibration.constant_shift - 0.375) * plane.reference_pixel_cm
    gap = plane.emitter_distance_cm - m
    distance = plane.reference_distance_cm
    with np.errstate(divide="ignore", invalid="ignore"):
        mm = 10 * (m * distance / gap + distance)
        valid = (numbers < NO_READING) & (gap > 0) & (mm < FARTHEST_MM)
    return np.where(valid, mm, np.nan)


def points_mm(depth: FloatArray, calibration: Calibration) -> FloatArray:
    """Place every pixel of a depth image in space, by the factory's pinhole without distortion.

    Parameters
    ----------
    depth : (480, 640) float64, mm, NaN = no reading

    Returns
    -------
    (480, 640, 3) float64, mm, depth camera frame
    """
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    scale = depth / calibration.focal_length_px
    return np.stack([(u - WIDTH // 2) * scale, (v - HEIGHT // 2) * scale, depth], axis=-1)


def millimetre_table(calibration: Calibration) -> RawArray:
    """Give whole millimetres for each raw number: (2048,) uint16, 0 = no reading."""
    mm = depth_mm(np.arange(_RAW_VALUES), calibration)
    return np.trunc(np.nan_to_num(mm, nan=0.0)).astype(np.uint16)


def shift_table(calibration: Calibration) -> IntArray:
    """Give the horizontal shift onto the colour image for each whole mm.

    Returns
    -------
    (10000,) int64, 1/256 px; entry 0 means nothing
    """
    plane = calibration.zero_plane
    pixel = np.float32(plane.reference_pixel_cm)
    scale = 1 / float(np.float32(pixel * np.float32(2)) * np.float32(10))
    rgb_distance = float(np.float32(plane.rgb_distance_cm)) * scale * 10
    reference = float(np.float32(plane.reference_distance_cm)) * scale * 10
    z = np.arange(1, FARTHEST_MM) * scale
    shift = np.trunc((rgb_distance * (z - reference) / z + 0.375) * _SUBPIXEL)
    return np.concatenate([[0], shift.astype(np.int64)])


def registration_table(calibration: Calibration) -> IntArray:
    """Give where each depth pixel lies in the colour image, but for the shift by its depth.

    Two cubic polynomials, evaluated by forward differences in integers as the device does.

    Returns
    -------
    (480, 640, 2) int64, x in 1/256 px and y in px
    """
    info = calibration.registration
    x = _polynomial(_x_differences(info), (info.ax, info.bx, info.cx, info.dx))
    y = _polynomial(_y_differences(info), (info.ay, info.by, info.cy, info.dy))
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    new_x = u + x / _FRACTION + 1
    new_y = v + y / _FRACTION + 1
    inside = (new_x >= 0) & (new_x < WIDTH) & (new_y >= 0) & (new_y < HEIGHT)
    new_x = np.where(inside, new_x, _OUTSIDE)
    return np.stack([np.trunc(new_x * _SUBPIXEL), np.trunc(new_y)], axis=-1).astype(np.int64)


def _signed(value: int, bits: int) -> int:
    """Read the low bits of a number as a signed number."""
    half = 1 << (bits - 1)
    return ((value + half) & ((1 << bits) - 1)) - half


def _x_differences(info: RegistrationInfo) -> tuple[int, ...]:
    """Start of x: value, by column, by row, then the second differences xx, xy, yy."""
    return _scaled(
        (info.dx_start, info.dxdx_start, info.dydx_start),
        (info.dxdxdx_start, info.dydxdx_start, info.dydydx_start),
    )


def _y_differences(info: RegistrationInfo) -> tuple[int, ...]:
    """Start of y, likewise."""
    return _scaled(
        (info.dy_start, info.dxdy_start, info.dydy_start),
        (info.dxdxdy_start, info.dydxdy_start, info.dydydy_start),
    )


def _scaled(first: tuple[int, int, int], second: tuple[int, int, int]) -> tuple[int, ...]:
    value, by_column, by_row = first
    slopes = [_signed(value, 19) << 9, _signed(by_column, 21) << 8, _signed(by_row, 21) << 8]
    return (*slopes, *(_signed(number, 24) << 8 for number in second))


def _polynomial(start: tuple[int, ...], third: tuple[int, int, int, int]) -> IntArray:
    """Evaluate a cubic at every pixel.

    Parameters
    ----------
    start
        Value and differences before the first row.
    third
        The constant third differences xxx, yyy, xxy, xyy (a, b, c, d of the device).

    Returns
    -------
    (480, 640) int64, 1/2**17 px
    """
    by_row = _row_starts(start, third)
    value, by_column, curvature = by_row.T.copy()
    columns = np.empty((WIDTH, HEIGHT), np.int64)
    for column in columns:
        column[:] = value
        value += by_column >> 6
        by_column += curvature >> 8
        curvature += third[0]
    return columns.T


def _row_starts(start: tuple[int, ...], third: tuple[int, int, int, int]) -> IntArray:
    """Give value, slope and curvature along the row at the start of each row, (480, 3)."""
    value, column, row, column2, mixed, row2 = start
    _xxx, yyy, xxy, xyy = third
    rows = []
    for _ in range(HEIGHT):
        column2 += xxy
        column += mixed >> 8
        mixed += xyy
        value += row >> 6
        row += row2 >> 8
        row2 += yyy
        rows.append((value, column, column2))
    return np.array(rows, np.int64)


class DepthRegistration:
    """Moves depth images onto the colour image of 640 × 480.

    Parameters
    ----------
    calibration
    """

    def __init__(self, calibration: Calibration) -> None:
        self._millimetres = millimetre_table(calibration)
        self._shift = shift_table(calibration)
        self._table = registration_table(calibration)
        self._start = HEIGHT * calibration.padding.start_lines  # 480, as the device counts

    def register(self, raw: RawArray) -> RawArray:
        """Give for each colour pixel the depth of what it sees.

        Parameters
        ----------
        raw : (480, 640) uint16, raw 11-bit numbers

        Returns
        -------
        (480, 640) uint16, mm, 0 = none
        """
        z = self._millimetres[raw]
        seen = (z > 0) & (z < FARTHEST_MM)
        moved = self._table[..., 0] + self._shift[np.where(seen, z, 0)]
        column = (moved + (_SUBPIXEL - 1) * (moved < 0)) >> 8  # towards zero, as in C
        target = self._table[..., 1] * WIDTH + column - self._start
        seen &= (column >= 0) & (column < WIDTH) & (target >= 0) & (target < WIDTH * HEIGHT)
        nearest = np.full(WIDTH * HEIGHT, FARTHEST_MM, np.uint16)
        np.minimum.at(nearest, target[seen], z[seen])
        nearest[nearest == FARTHEST_MM] = 0
        return nearest.reshape(HEIGHT, WIDTH)
