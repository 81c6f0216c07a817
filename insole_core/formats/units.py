"""Units of length that files of scanners are in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from insole_core.errors import InputError

Unit = Literal["mm", "cm", "m", "inch"]

MM_PER_UNIT: dict[Unit, float] = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4}
UNIT_NAMES: dict[Unit, str] = {
    "mm": "millimetres", "cm": "centimetres", "m": "metres", "inch": "inches",
}  # fmt: skip


@dataclass(frozen=True)
class UnitReading:
    """A unit in which a file may be, and how long the foot in it would be.

    Parameters
    ----------
    unit
    length_mm
        A guess where the toes are missing.
    scanned_mm
        Without toes, what was scanned of the length; else None.
    """

    unit: Unit
    length_mm: float
    scanned_mm: float | None = None

    def in_unit(self, unit: Unit) -> UnitReading:
        """Return how long the foot would be if the same numbers were in another unit."""
        factor = MM_PER_UNIT[unit] / MM_PER_UNIT[self.unit]
        scanned_mm = None if self.scanned_mm is None else factor * self.scanned_mm
        return UnitReading(unit, factor * self.length_mm, scanned_mm)


class UnitError(InputError):
    """The surface is as large as a foot in no unit, or not in the one that was given."""
