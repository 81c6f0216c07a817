"""Pronation and supination."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, Self

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import raised_message
from insole_core.insole.fields import Angle, Choice, OfLength, ranges_of
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.blending import smooth_step
from insole_core.messages import Message

_POSTED = (
    "The rearfoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.",
    "The forefoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.",
)
_GRIPS = (
    (
        "rearfoot",
        (0.09, 0.15),
        "Drag up or down to change the rearfoot angle",
        "Tilt the rearfoot",
    ),
    (
        "forefoot",
        (0.16, 0.68),
        "Drag up or down to change the forefoot angle",
        "Tilt the forefoot",
    ),
)
"""Part, place medially and along the foot in lengths of the foot, and words: from behind, where the
Achilles axis is read, the grip of the forefoot is seen beside the other."""
_STEP_DEG = 0.5
_DEG_PER_MM = 0.2


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

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn of angles that are unusual, with those of the posts."""
        usual, cause = judged.rules.post_unusual_deg, mine[0].id if mine else ""
        for posted, angle_deg in zip(_POSTED, judged.posted_deg, strict=True):
            angle = rounded(angle_deg, SHOWN)
            if abs(angle) > usual:
                edge = "medially" if angle > 0 else "laterally"
                yield DesignWarning(
                    Message(posted, angle=abs(angle), edge=edge, usual=usual), cause
                )

    def grips(self, foot: Foot) -> tuple[Grip, ...]:
        """Return those at the medial edge of rearfoot and forefoot, which tilt them."""
        length_mm, medial = foot.length_mm, foot.side.medial_sign
        return tuple(
            Grip(
                part,
                (medial * across * length_mm, along * length_mm),
                hint,
                sentence,
                "move",
                notch_mm=_STEP_DEG / _DEG_PER_MM,
            )
            for part, (across, along), hint, sentence in _GRIPS
        )

    def pulled(self, grip: str, pull: Pull, _foot: Foot) -> Self:
        """Return it with the angle of a part changed, upwards to raise the medial edge."""
        name = f"{grip}_deg"
        angle = rounded(getattr(self, name) + pull.up_mm * _DEG_PER_MM, _STEP_DEG)
        changes: dict[str, Any] = {name: float(ranges_of(Posting)[name].nearest(angle))}
        return replace(self, **changes)

    def brief(self) -> Message:
        """Return both angles."""
        return Message(
            "{rearfoot} / {forefoot}",
            rearfoot=raised_message(self.rearfoot_deg),
            forefoot=raised_message(self.forefoot_deg),
        )
