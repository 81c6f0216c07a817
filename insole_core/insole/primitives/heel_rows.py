"""The rows of a height field that are the heel's."""

from __future__ import annotations

import numpy as np

from insole_core.insole.primitives.height_field import HeightField

HEEL_SHARE = 0.22
"""Length of the heel as a share of the foot's length."""


def row_count(field: HeightField, end_mm: float) -> int:
    """Return how many rows of a field lie behind a place along the foot; at least one."""
    return max(1, int(np.searchsorted(field.y_mm, end_mm)))


def rows_up_to(field: HeightField, end_mm: float) -> slice:
    """Return these rows."""
    return slice(0, row_count(field, end_mm))


def heel_floor_mm(field: HeightField, length_mm: float) -> float:
    """Return the lowest height of the heel of a foot of this length."""
    return float(field.heights_mm[rows_up_to(field, HEEL_SHARE * length_mm)].min())
