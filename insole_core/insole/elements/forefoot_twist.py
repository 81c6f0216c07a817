"""A turn of the forefoot alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import raised_message
from insole_core.insole.fields import Angle, OfLength
from insole_core.insole.primitives.blending import smooth_step
from insole_core.messages import Message


@dataclass(frozen=True, kw_only=True)
class ForefootTwist(Correction):
    """Rotation of the forefoot relative to the rearfoot, which stays as it is.

    Between the two shares of the length the angle grows from 0 to its full value.
    """

    type, name = "forefoot_twist", "Forefoot twist"
    tip = "Turn the forefoot against the rearfoot"
    stage, order = "turn", 10

    angle_deg: Annotated[
        float,
        Angle(
            "Angle",
            "> 0 raises the medial edge of the forefoot (varus), < 0 the lateral one",
            -15,
            15,
            raises=True,
            main="",
        ),
    ] = 0.0
    blend_start: Annotated[
        float,
        OfLength(
            "Begins at", "Share of the foot's length at which the twist begins", before="blend_end"
        ),
    ] = 0.45
    blend_end: Annotated[
        float,
        OfLength(
            "Full from",
            "Share of the foot's length from which the whole angle holds",
            after="blend_start",
        ),
    ] = 0.75

    @classmethod
    def usual(cls) -> Self:
        """Return it as it is added by the menu: with an angle that can be seen."""
        return cls(angle_deg=4.0)

    def turned_deg(self, share: FloatArray) -> FloatArray:
        """Return the angle in the sections at shares (n,) of the length."""
        return np.asarray(self.angle_deg * smooth_step(share, self.blend_start, self.blend_end))

    def brief(self) -> Message:
        """Return its angle."""
        return raised_message(self.angle_deg)
