"""Regions of the image that the corners of the boards have reached."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.geometry.arrays import IntArray

_CELLS = (6, 8)
_VERTICAL = ("upper", "middle", "lower")
_HORIZONTAL = ("left", "centre", "right")


def count_corners(detections: Sequence[BoardDetection]) -> IntArray:
    """Count the corners in each of 6 x 8 cells of the image."""
    counts = np.zeros(_CELLS, dtype=np.int64)
    for detection in detections:
        width, height = detection.size
        column = np.clip(detection.pixels[:, 0] * _CELLS[1] / width, 0, _CELLS[1] - 1).astype(int)
        row = np.clip(detection.pixels[:, 1] * _CELLS[0] / height, 0, _CELLS[0] - 1).astype(int)
        np.add.at(counts, (row, column), 1)
    return counts


def missing_regions(counts: IntArray) -> tuple[str, ...]:
    """Name the ninths of the image of which more than half was not reached."""
    rows = np.array_split(np.arange(counts.shape[0]), 3)
    columns = np.array_split(np.arange(counts.shape[1]), 3)
    return tuple(
        f"{vertical} {horizontal}"
        for vertical, i in zip(_VERTICAL, rows, strict=True)
        for horizontal, j in zip(_HORIZONTAL, columns, strict=True)
        if (counts[np.ix_(i, j)] == 0).mean() > 0.5
    )
