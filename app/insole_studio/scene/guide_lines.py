"""Guide lines of a tool, drawn over a model with one text beside them."""

from __future__ import annotations

from dataclasses import dataclass

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
    """

    lines: tuple[FloatArray, ...]
    place: FloatArray
    text: str

    def axes_alone(self) -> GuideLines:
        """Return the axes without the last line (the sole's level) and the text."""
        return GuideLines(self.lines[:-1], self.place, "")
