"""A table of the measures of one or both feet, with their asymmetry."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from insole_core.export.csv_text import csv_text
from insole_core.foot.foot import Foot
from insole_core.foot.measures import DEFINITIONS, NOT_MARKED
from insole_core.geometry.side import Side
from insole_core.messages import Message

Measured: TypeAlias = Mapping[str, float | None]
HEADS = ("measure", "unit", "left", "right", "difference", "percent", "positive")
_UNLIKE_MM, _UNLIKE_SHARE = 10.0, 0.05
_LEAST_MEAN = {"mm": 5.0, "": 0.1}
"""By unit: the least mean of both feet of which a share says something."""


@dataclass(frozen=True)
class MeasureRow:
    """One measure of both feet; None where a foot, or the measure on it, is missing."""

    key: str
    left: float | None
    right: float | None

    @property
    def unit(self) -> str:
        """``mm``, ``degrees``, or empty for a ratio."""
        return DEFINITIONS[self.key].unit

    @property
    def difference(self) -> float | None:
        """Left minus right."""
        return None if self.left is None or self.right is None else self.left - self.right

    @property
    def percent(self) -> float | None:
        """The difference in per cent of the mean of both.

        None for angles, and for what is so small that the error of a scan is a large share of it.
        """
        if self.difference is None or self.unit not in _LEAST_MEAN:
            return None
        assert self.left is not None
        assert self.right is not None
        mean = (self.left + self.right) / 2
        return 100 * self.difference / mean if mean >= _LEAST_MEAN[self.unit] else None


def measure_table(
    measures: Mapping[Side, Measured], *, with_missing: bool = False
) -> list[MeasureRow]:
    """Return a row for each measure that at least one foot has, in the order of `DEFINITIONS`.

    Parameters
    ----------
    measures
        Of each foot, by name.
    with_missing
        Whether to list also what was not scanned of any foot.
    """
    left, right = measures.get(Side.LEFT, {}), measures.get(Side.RIGHT, {})
    rows = (MeasureRow(key, left.get(key), right.get(key)) for key in DEFINITIONS)
    listed = DEFINITIONS.keys() - NOT_MARKED if with_missing else set()
    return [
        row for row in rows if row.left is not None or row.right is not None or row.key in listed
    ]


def table_csv(rows: Iterable[MeasureRow]) -> str:
    """Format the table as CSV with a header; decimal points, empty where there is no value.

    The last column says what an angle above 0 is called.
    """
    return csv_text([HEADS, *map(_cells, rows)])


def unlike_sizes(left: Foot, right: Foot) -> str:
    """Return a warning when two feet can hardly belong to one patient; empty when they can."""
    apart = abs(left.length_mm - right.length_mm)
    if apart <= max(_UNLIKE_MM, _UNLIKE_SHARE * min(left.length_mm, right.length_mm)):
        return ""
    return Message(
        "The left foot is {left_mm:.0f} mm long and the right one {right_mm:.0f} mm; check "
        "that both scans are of this patient, and in the same unit.",
        left_mm=left.length_mm,
        right_mm=right.length_mm,
    )


def _cells(row: MeasureRow) -> tuple[str, ...]:
    numbers = (row.left, row.right, row.difference, row.percent)
    return (row.key, row.unit, *map(_number, numbers), DEFINITIONS[row.key].positive)


def _number(value: float | None) -> str:
    return "" if value is None else f"{value + 0.0:.3f}"
