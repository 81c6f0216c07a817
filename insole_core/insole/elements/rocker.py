"""An underside over which the foot rolls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import number_message
from insole_core.insole.fields import Angle, Number
from insole_core.messages import Message


@dataclass(frozen=True, kw_only=True)
class Rocker(Correction):
    """An underside that rises ahead of a line along the heads, so that the foot rolls over it.

    The contact surface stays; what is eased comes off the thickness.
    """

    type, name = "rocker", "Rocker"
    tip = "Let the underside rise ahead of a line along the heads"
    stage = "body"

    behind_heads_mm: Annotated[
        float,
        Number(
            "Behind the heads",
            "Distance of the line behind heads 1 and 5; < 0 is ahead of them",
            -20,
            40,
            main="{value} behind the heads",
        ),
    ] = 5.0
    slope_deg: Annotated[
        float, Angle("Slope", "Slope of the underside ahead of the line", 0, 25)
    ] = 10.0

    def brief(self) -> Message:
        """Return its slope."""
        return Message("{angle}°", angle=number_message(self.slope_deg))
