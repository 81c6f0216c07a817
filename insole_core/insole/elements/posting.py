"""Pronation and supination."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import raised_message
from insole_core.insole.fields import Angle, Choice, OfLength
from insole_core.insole.primitives.blending import smooth_step
from insole_core.messages import Message


@dataclass(frozen=True, kw_only=True)
class Posting(Correction):
    """Pronation/supination: rotation of the foot relative to the insole's bottom, thesis 6.3.1.

    Between the two shares of the length the rearfoot angle blends into the forefoot angle.

    Parameters
    ----------
    method
        "extrinsic": the whole surface turns, as on a wedge below the device. "intrinsic": the
        sole's surface turns and the rim of the device stays.
    """

    type, name = "posting", "Posting"
    tip = "Tilt rear- and forefoot by degrees, against pronation or supination"
    stage = "turn"

    rearfoot_deg: Annotated[
        float,
        Angle(
            "Rearfoot",
            "> 0 raises the medial edge of the rearfoot (varus), < 0 the lateral one",
            -15,
            15,
            raises=True,
            main="{value} at the rearfoot",
        ),
    ] = 0.0
    forefoot_deg: Annotated[
        float,
        Angle(
            "Forefoot",
            "> 0 raises the medial edge of the forefoot (varus), < 0 the lateral one",
            -15,
            15,
            raises=True,
            main="{value} at the forefoot",
        ),
    ] = 0.0
    method: Annotated[
        str,
        Choice(
            "Kind",
            "Extrinsic turns the whole insole, intrinsic leaves its rim as it is",
            words={"extrinsic": "extrinsic", "intrinsic": "intrinsic"},
        ),
    ] = "extrinsic"
    blend_start: Annotated[
        float,
        OfLength(
            "Rearfoot up to",
            "Share of the foot's length up to which the rearfoot angle holds",
            before="blend_end",
        ),
    ] = 0.25
    blend_end: Annotated[
        float,
        OfLength(
            "Forefoot from",
            "Share of the foot's length from which the forefoot angle holds",
            after="blend_start",
        ),
    ] = 0.65

    @classmethod
    def usual(cls) -> Self:
        """Return it as it is added by the menu: with an angle that can be seen."""
        return cls(rearfoot_deg=4.0)

    @property
    def turns_rim(self) -> bool:
        """Whether it turns the whole surface."""
        return self.method == "extrinsic"

    def turned_deg(self, share: FloatArray) -> FloatArray:
        """Return the angle in the sections at shares (n,) of the length."""
        forefoot = smooth_step(share, self.blend_start, self.blend_end)
        return np.asarray(self.rearfoot_deg + (self.forefoot_deg - self.rearfoot_deg) * forefoot)

    def brief(self) -> Message:
        """Return both angles."""
        return Message(
            "{rearfoot} / {forefoot}",
            rearfoot=raised_message(self.rearfoot_deg),
            forefoot=raised_message(self.forefoot_deg),
        )
