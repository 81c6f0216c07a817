"""What stands beside a model: guide lines of a tool with one text, and names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class GuideLines:
    """Guide lines beside a model, and a text.

    Parameters
    ----------
    lines : (n, 3) each, mm, insole frame
        The polylines.
    place : (3,), mm, insole frame
        Position of the text.
    text
        Usually the measured angle.
    faults : (n, 3) each, mm, insole frame
        Polylines that show what is wrong.
    """

    lines: tuple[FloatArray, ...]
    place: FloatArray
    text: str
    faults: tuple[FloatArray, ...] = ()

    @property
    def bounds_mm(self) -> FloatArray:
        """The box (2, 3) of the lines."""
        points = np.concatenate(self.lines)
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def axes_alone(self) -> GuideLines:
        """Return the axes without the last line (the sole's level) and the text."""
        return GuideLines(self.lines[:-1], self.place, "")


@dataclass(frozen=True, eq=False)
class NameLabel:
    """A word on a coloured ground at a place (3,), mm."""

    text: str
    place_mm: FloatArray
    color: str
