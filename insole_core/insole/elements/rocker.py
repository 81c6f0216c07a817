"""An underside over which the foot rolls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Self

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import number_message
from insole_core.insole.fields import Angle, Number, ranges_of
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.blending import smooth_hinge
from insole_core.insole.primitives.height_field import (
    HeightField,
    ahead_of_heads_mm,
    heads_ahead,
    heads_mm,
)
from insole_core.messages import Message

LEAST_LEFT_MM = 1.5
"""Thickness that a rocker leaves; ahead of there the underside follows the upper side."""
_BEND_MM = 6.0  # distance from the line over which the underside bends
_TOLERANCE_MM = 0.5
_DRAWN_POINTS = 30
_STEP_MM, _FINE_STEP_MM = 0.5, 0.05


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
            main_below="{value} ahead of the heads",
        ),
    ] = 5.0
    slope_deg: Annotated[
        float, Angle("Slope", "Slope of the underside ahead of the line", 0, 25)
    ] = 10.0

    def rise_mm(self, foot: Foot, field: HeightField) -> FloatArray:
        """Return by how much it asks the underside to rise, (ny, nx), mm."""
        ahead = ahead_of_heads_mm(foot, field) + self.behind_heads_mm
        return np.asarray(np.tan(np.radians(self.slope_deg)) * smooth_hinge(ahead, _BEND_MM))

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn where the forefoot is not thick enough for them."""
        if not mine:
            return
        asked = np.max([rocker.rise_mm(judged.foot, judged.surface) for rocker in mine], axis=0)
        room = judged.thickness_mm - LEAST_LEFT_MM
        missing = np.where(judged.measured, asked - room, 0.0)
        missing_mm = rounded(float(missing.max()), SHOWN)
        if missing_mm > _TOLERANCE_MM:
            thin = Message(
                "The forefoot is {missing_mm:g} mm too thin for the rocker, which leaves "
                "{least_mm:g} mm of material; raise the thickness or lower the slope.",
                missing_mm=missing_mm,
                least_mm=LEAST_LEFT_MM,
            )
            yield DesignWarning(thin, mine[0].id, judged.place_of(missing))

    def line_mm(self, foot: Foot) -> FloatArray:
        """Return the ends (2, 2), mm, insole frame, of its line: behind heads 1 and 5."""
        return heads_mm(foot) - self.behind_heads_mm * heads_ahead(foot)

    def lines(self, foot: Foot) -> tuple[FloatArray, ...]:
        """Return its line."""
        start, end = self.line_mm(foot)
        return (np.linspace(start, end, _DRAWN_POINTS),)

    def grips(self, foot: Foot) -> tuple[Grip, ...]:
        """Return that in the middle of its line."""
        x, y = self.line_mm(foot).mean(axis=0).tolist()
        hint = "Drag to move the line from which the underside rises"
        return (Grip("rocker_line", (x, y), hint, "Move the rocker line", has_keys=True),)

    def pulled(self, _grip: str, pull: Pull, foot: Foot) -> Self:
        """Return it with its line moved, along the foot and within its range."""
        step_mm = _FINE_STEP_MM if pull.by_key and pull.is_fine else _STEP_MM
        behind_mm = self.behind_heads_mm - float(pull.moved_mm @ heads_ahead(foot))
        allowed = ranges_of(Rocker)["behind_heads_mm"]
        return replace(self, behind_heads_mm=allowed.nearest(rounded(behind_mm, step_mm)))

    def brief(self) -> Message:
        """Return its slope."""
        return Message("{angle}°", angle=number_message(self.slope_deg))
