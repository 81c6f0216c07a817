"""A wedge in the heel cup."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction, Sole
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Angle, Choice, Number
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.height_field import HEEL_SHARE, rows_up_to
from insole_core.messages import Message

_SKIVE_END = 0.32
_ROUNDING_MM = 1.0  # height over which the plane and the surface blend


@dataclass(frozen=True, kw_only=True)
class HeelSkive(Correction):
    """A plane cut into one side of the heel of the positive (Kirby 1992): a wedge in the cup.

    Parameters
    ----------
    depth_mm
        Greatest height that the plane adds to the contact surface.
    """

    type, name = "heel_skive", "Heel skive"
    tip = "A wedge in the heel cup, medial or lateral"
    stage, order = "sole", 10

    depth_mm: Annotated[
        float, Number("Depth", "Greatest height of the wedge in the heel cup", 0.5, 8, main="")
    ] = 3.0
    slope_deg: Annotated[float, Angle("Slope", "Slope of the wedge against the ground", 5, 30)] = (
        15.0
    )
    border: Annotated[
        str,
        Choice(
            "Edge",
            "Edge of the heel that is raised",
            words={"medial": "medial", "lateral": "lateral"},
            main="",
        ),
    ] = "medial"

    def shaped(self, sole: Sole) -> FloatArray:
        """Raise one border of the heel to a plane."""
        field, length_mm = sole.surface, sole.length_mm
        rows = rows_up_to(field, _SKIVE_END * length_mm)
        heights = field.heights_mm[rows]
        heel = sole.measured[rows] & (field.y_mm[rows, None] <= HEEL_SHARE * length_mm)
        if not heel.any():
            return field.heights_mm
        outward = sole.side.medial_sign * (1 if self.border == "medial" else -1)
        plane = np.tan(np.radians(self.slope_deg)) * outward * field.x_mm
        over = plane - heights
        over = over + (self.depth_mm - over[heel].max())
        rise = smooth_hinge(over, min(_ROUNDING_MM, self.depth_mm))
        fade = 1 - smooth_step(field.y_mm[rows] / length_mm, HEEL_SHARE, _SKIVE_END)
        changed = field.heights_mm.copy()
        changed[rows] += np.minimum(rise, self.depth_mm) * fade[:, None]
        return changed

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn of a cup that is too shallow for a skive and the inversion."""
        rules, inversion = judged.rules, max(rounded(judged.posted_deg[0], SHOWN), 0.0)
        for skive in mine:
            both = rounded(skive.depth_mm + inversion, SHOWN)
            deep = both > rules.skive_and_inversion_limit
            needed = rules.skive_and_inversion_cup_mm if deep else rules.skive_least_cup_mm
            if judged.cup_mm < needed:
                shallow = Message(
                    "A skive of {depth_mm:g} mm with {angle:g}° of inversion needs a heel cup of "
                    "{needed_mm:g} mm, and the cup is {cup_mm:g} mm deep.",
                    depth_mm=skive.depth_mm,
                    angle=inversion,
                    needed_mm=needed,
                    cup_mm=judged.cup_mm,
                )
                yield DesignWarning(shallow, skive.id)

    def brief(self) -> Message:
        """Return its border and depth."""
        return Message("{border} {depth}", border=self.border, depth=mm_message(self.depth_mm))
