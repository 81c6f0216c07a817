"""The shoe that an insole is made for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Shoe:
    """The inside of a shoe seen from above, where the insole lies.

    Parameters
    ----------
    name
        For display: a size, or the file of a last.
    inside_mm
        Places on the closed edge of the inside, in the shoe's own frame: x medial, y = 0 at the
        rearmost point, x = 0 on the line through the middles of heel and ball. The same for a left
        and a right shoe.
    trim
        Whether the insole is trimmed to the shoe.
    clearance_mm
        Room that trimming leaves between the insole and the shoe.
    """

    name: str
    inside_mm: tuple[tuple[float, float], ...]
    trim: bool = False
    clearance_mm: float = 0.5
