"""Overlays that show what a set of calibration pictures still lacks."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, IntArray
from insole_core.workflows.calibration.picture_readiness import CELLS, is_near

_AMBER = np.array([255, 176, 32])
_GREEN, _WHITE, _DARK = (90, 220, 90), (255, 255, 255), (24, 24, 24)
_TINT = 0.28
_BAR_PX = 34
_RANGE_MM = (350.0, 1050.0)


def draw_missing_cells(picture: ByteArray, cells: IntArray) -> ByteArray:
    """Tint the cells of a picture that are not covered yet.

    Parameters
    ----------
    picture : (height, width, 3) uint8, RGB
    cells : (6, 8) int64
        Counts, as in `Readiness`.

    Returns
    -------
    (height, width, 3) uint8, RGB
    """
    height, width = picture.shape[:2]
    drawn = picture.copy()
    for row, column in np.argwhere(cells == 0).tolist():
        top, bottom = (round(height * (row + i) / CELLS[0]) for i in (0, 1))
        left, right = (round(width * (column + i) / CELLS[1]) for i in (0, 1))
        part = drawn[top:bottom, left:right]
        part[:] = ((1 - _TINT) * part + _TINT * _AMBER).astype(np.uint8)
        cv2.rectangle(drawn, (left + 2, top + 2), (right - 3, bottom - 3), _AMBER.tolist(), 1)
    return drawn


def draw_distances(
    picture: ByteArray,
    wanted_mm: Sequence[int],
    distances_mm: Sequence[float],
    now_mm: float | None,
) -> ByteArray:
    """Add a scale below a picture, with the distances that are captured and missing.

    Parameters
    ----------
    picture : (height, width, 3) uint8, RGB
    wanted_mm
        Distances to capture walls at.
    distances_mm
        Of the walls captured so far.
    now_mm
        Distance of the wall in view; None without one.

    Returns
    -------
    (height + 34, width, 3) uint8, RGB
    """
    bar = np.full((_BAR_PX, picture.shape[1], 3), _DARK, np.uint8)
    for mm in wanted_mm:
        there = is_near(mm, distances_mm)
        color, x = (_GREEN if there else _AMBER.tolist()), _place(mm, bar.shape[1])
        cv2.circle(bar, (x, 10), 5, color, -1 if there else 2, cv2.LINE_AA)
        _write(bar, f"{mm}", x, color)
    if now_mm is not None:
        x = _place(now_mm, bar.shape[1])
        cv2.line(bar, (x, 0), (x, 20), _WHITE, 2, cv2.LINE_AA)
    return np.vstack([picture, bar])


def _place(mm: float, width: int) -> int:
    near, far = _RANGE_MM
    return round(float(np.clip((mm - near) / (far - near), 0, 1)) * (width - 1))


def _write(bar: ByteArray, text: str, x: int, color: Sequence[int]) -> None:
    width = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, 0.4, 1)[0][0]
    cv2.putText(
        bar, text, (x - width // 2, _BAR_PX - 5), cv2.FONT_HERSHEY_SIMPLEX, 0.4, color, 1,
        cv2.LINE_AA,
    )  # fmt: skip
