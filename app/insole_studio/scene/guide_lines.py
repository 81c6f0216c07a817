"""Lines that a tool works with, drawn over a model, with one text beside them."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class GuideLines:
    """Lines beside a model and a text at a place.

    Parameters
    ----------
    lines : (2, 3) each, mm, insole frame
    place : (3,), mm, insole frame
        Where the text stands.
    text
    """

    lines: tuple[FloatArray, ...]
    place: FloatArray
    text: str

    def axes_alone(self) -> GuideLines:
        """Leave out the last line, which is the sole's level, and the text."""
        return GuideLines(self.lines[:-1], self.place, "")
