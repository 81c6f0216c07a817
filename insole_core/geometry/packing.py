"""Outlines packed into a rectangle, each at the lowest free place, then the one furthest left.

The outlines are painted on pixels; where one may lie is the correlation of its pixels with those
that are taken. Every pixel that an outline touches counts as its own, so that rounding only adds to
the gap.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, Float32Array, FloatArray
from insole_core.geometry.height_map import disc
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.progress import SILENT, Progress

Turn: TypeAlias = int
"""Degrees counter-clockwise: 0, 90, 180 or 270."""
_PITCH_MM: Final = 1.0
_ROUNDING: Final = 1.5
"""Pixels by which two painted outlines may be nearer than their pixels are."""
_SUBPIXEL_BITS: Final = 8
_SAME: Final = 1e-6
"""Pixels of a length that are only the rounding of its last digit."""


@dataclass(frozen=True)
class Packed:
    """Where an outline lies: turned about the origin, then moved."""

    turn_deg: Turn
    shift_mm: tuple[float, float]

    def applied(self, points_mm: FloatArray) -> FloatArray:
        """Return points (n, 2) where they lie."""
        return turned(points_mm, self.turn_deg) + self.shift_mm

    def moved(self, step_mm: FloatArray) -> Packed:
        """Return the same further on by a step (2,)."""
        x, y = self.shift_mm + step_mm
        return Packed(self.turn_deg, (float(x), float(y)))


def turned(points_mm: FloatArray, turn_deg: Turn) -> FloatArray:
    """Return points (n, 2) turned about the origin by quarters, exactly."""
    x, y = points_mm.T
    x, y = {0: (x, y), 90: (-y, x), 180: (-x, -y), 270: (y, -x)}[turn_deg]
    return np.column_stack([x, y])


def pack(
    outlines: Sequence[FloatArray],
    size_mm: tuple[float, float],
    *,
    gap_mm: float,
    margin_mm: float,
    turns: Sequence[Turn] = (0, 180),
    progress: Progress = SILENT,
) -> tuple[Packed | None, ...]:
    """Place outlines one after the other, the largest first.

    Parameters
    ----------
    outlines : (n, 2) float64 each, mm
    size_mm
        Width (x) and length (y) of the rectangle, a corner of which is the origin.
    gap_mm
        Between two of them, at least.
    margin_mm
        To the sides of the rectangle.
    turns
        In which an outline may lie; of equal ones the first.

    Returns
    -------
    tuple of Packed or None
        None for what found no room.

    Raises
    ------
    Cancelled
    """
    columns, rows = (int((side - 2 * margin_mm) / _PITCH_MM + _SAME) for side in size_mm)
    found: list[Packed | None] = [None] * len(outlines)
    if min(columns, rows) < 1:
        return tuple(found)
    taken = np.zeros((rows + 1, columns + 1), np.float32)  # a pixel on both ends
    around = disc(gap_mm + _ROUNDING * _PITCH_MM, _PITCH_MM)
    order = sorted(range(len(outlines)), key=lambda number: -abs(signed_area_mm2(outlines[number])))
    for number, step in zip(order, progress.parts(len(order)), strict=True):
        step.step(0.0, "Nesting the pieces")
        best = _lowest(outlines[number], taken, turns)
        if best is None:
            continue
        turn_deg, (row, column), mask = best
        low = turned(outlines[number], turn_deg).min(axis=0)
        x, y = np.array([column, row]) * _PITCH_MM + margin_mm - low
        found[number] = Packed(turn_deg, (float(x), float(y)))
        _take(taken, mask, (row, column), around)
    return tuple(found)


def _lowest(
    outline: FloatArray, taken: Float32Array, turns: Sequence[Turn]
) -> tuple[Turn, tuple[int, int], Float32Array] | None:
    """Return turn, place and pixels at which an outline ends lowest, then furthest left."""
    best = None
    least = (np.inf, np.inf)
    for turn_deg in turns:
        mask = _painted(turned(outline, turn_deg))
        place = _first_free(taken, mask)
        if place is None:
            continue
        ends = (place[0] + mask.shape[0], place[1] + mask.shape[1])
        if ends < least:
            least, best = ends, (turn_deg, place, mask)
    return best


def _painted(outline: FloatArray) -> Float32Array:
    """Return 1 for every pixel that an outline touches; its least corner is on the first one."""
    pixels = (outline - outline.min(axis=0)) / _PITCH_MM
    columns, rows = np.ceil(pixels.max(axis=0) - _SAME).astype(int) + 1
    mask = np.zeros((rows, columns), np.uint8)
    points = np.rint(pixels * 2**_SUBPIXEL_BITS).astype(np.int32)
    cv2.fillPoly(mask, [points], 1, shift=_SUBPIXEL_BITS)
    return np.asarray(mask, np.float32)


def _first_free(taken: Float32Array, mask: Float32Array) -> tuple[int, int] | None:
    if (np.array(mask.shape) > taken.shape).any():
        return None
    overlap = cv2.matchTemplate(taken, mask, cv2.TM_CCORR)
    rows, columns = np.nonzero(overlap < 0.5)  # whole pixels, but for rounding
    return (int(rows[0]), int(columns[0])) if len(rows) else None


def _take(
    taken: Float32Array, mask: Float32Array, place: tuple[int, int], around: ByteArray
) -> None:
    """Mark the pixels of an outline, and those nearer to it than the gap, as taken."""
    reach = around.shape[0] // 2
    wide = cv2.dilate(np.pad(mask, reach), around)
    top, left = place[0] - reach, place[1] - reach
    rows = slice(max(top, 0), min(top + wide.shape[0], taken.shape[0]))
    columns = slice(max(left, 0), min(left + wide.shape[1], taken.shape[1]))
    part = wide[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left]
    np.maximum(taken[rows, columns], part, out=taken[rows, columns])
