"""The volume of interest as a box along the axes of the reference frame."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Box:
    """An axis-aligned volume in the reference frame, mm."""

    min_mm: tuple[float, float, float]
    max_mm: tuple[float, float, float]

    def moved(self, by_mm: tuple[float, float, float]) -> Box:
        """Return the box moved along the axes."""
        low, high = (
            tuple(a + b for a, b in zip(end, by_mm, strict=True))
            for end in (self.min_mm, self.max_mm)
        )
        return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))

    def joined(self, other: Box) -> Box:
        """Return the smallest box that holds both."""
        low = tuple(map(min, self.min_mm, other.min_mm))
        high = tuple(map(max, self.max_mm, other.max_mm))
        return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))
