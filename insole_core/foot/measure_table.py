"""A table of the measures of one or both feet, with their asymmetry."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from insole_core.export.csv_text import csv_text
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import DEFINITIONS, NOT_MARKED, is_length_seen
from insole_core.foot.spread import UNKNOWN, MeasuredFoot, Spread
from insole_core.geometry.side import Side
from insole_core.messages import Message

HEADS = (
    "measure", "unit", "left", "right", "difference", "percent", "positive",
    "left_limits_95", "left_limits_by", "right_limits_95", "right_limits_by",
    "difference_limits_95", "within_error",
)  # fmt: skip
_UNLIKE_MM, _UNLIKE_SHARE = 10.0, 0.05
_LEAST_MEAN = {"mm": 5.0, "": 0.1}
"""By unit: the least mean of both feet of which a share says something."""


@dataclass(frozen=True)
class MeasureRow:
    """One measure of both feet; None where a foot, or the measure on it, is missing."""

    key: str
    left: float | None
    right: float | None
    left_spread: Spread = UNKNOWN
    right_spread: Spread = UNKNOWN

    @property
    def unit(self) -> str:
        """``mm``, ``degrees``, or empty for a ratio."""
        return DEFINITIONS[self.key].unit

    @property
    def difference(self) -> float | None:
        """Left minus right."""
        return None if self.left is None or self.right is None else self.left - self.right

    @property
    def difference_limits(self) -> float | None:
        """The 95 % limit of the difference of two feet that are alike; None where not known."""
        return None if self.difference is None else self.left_spread.beside(self.right_spread)

    @property
    def is_within_error(self) -> bool | None:
        """Whether the difference is no larger than its error; None where that is not known."""
        if self.difference is None or self.difference_limits is None:
            return None
        return abs(self.difference) <= self.difference_limits

    @property
    def percent(self) -> float | None:
        """The difference in per cent of the mean of both.

        None for angles, for what is so small that the error of a scan is a large share of it, and
        for a difference within the error.
        """
        if self.difference is None or self.unit not in _LEAST_MEAN or self.is_within_error:
            return None
        assert self.left is not None
        assert self.right is not None
        mean = (self.left + self.right) / 2
        return 100 * self.difference / mean if mean >= _LEAST_MEAN[self.unit] else None


def measure_table(
    feet: Mapping[Side, MeasuredFoot], *, with_missing: bool = False
) -> list[MeasureRow]:
    """Return a row for each measure that at least one foot has, in the order of `DEFINITIONS`.

    Parameters
    ----------
    feet
        The measures of each foot, with their ±.
    with_missing
        Whether to list also what was not scanned of any foot.
    """
    left, right = (feet.get(side, MeasuredFoot({}, {})) for side in (Side.LEFT, Side.RIGHT))
    rows = (
        MeasureRow(
            key, left.values.get(key), right.values.get(key), left.spread(key), right.spread(key)
        )
        for key in DEFINITIONS
    )
    listed = DEFINITIONS.keys() - NOT_MARKED if with_missing else set()
    return [
        row for row in rows if row.left is not None or row.right is not None or row.key in listed
    ]


def table_csv(rows: Iterable[MeasureRow]) -> str:
    """Format the table as CSV with a header; decimal points, empty where there is no value.

    The column "positive" says what an angle above 0 is called; the last ones tell how far each
    value may be off, by what, and whether the difference is within that error.
    """
    return csv_text([HEADS, *map(_cells, rows)])


def unlike_sizes(left: Foot, right: Foot) -> str:
    """Return a warning when two feet can hardly belong to one patient; empty when they can.

    Lengths that are guesses are not compared.
    """
    if not all(is_length_seen(find_landmarks(foot)) for foot in (left, right)):
        return ""
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
    within = {None: "", True: "yes", False: "no"}[row.is_within_error]
    return (
        *(row.key, row.unit, *map(_number, numbers), DEFINITIONS[row.key].positive),
        *_spread_cells(row.left, row.left_spread),
        *_spread_cells(row.right, row.right_spread),
        *(_number(row.difference_limits), within),
    )


def _spread_cells(value: float | None, spread: Spread) -> tuple[str, str]:
    return ("", "") if value is None else (_number(spread.limits_95), str(spread.source))


def _number(value: float | None) -> str:
    return "" if value is None else f"{value + 0.0:.3f}"
