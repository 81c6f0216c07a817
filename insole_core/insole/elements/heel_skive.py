"""A wedge in the heel cup."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements.correction import Correction, Sole
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Angle, Choice, Number
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.heel_rows import HEEL_SHARE, rows_up_to
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

    def brief(self) -> Message:
        """Return its border and depth."""
        return Message("{border} {depth}", border=self.border, depth=mm_message(self.depth_mm))
