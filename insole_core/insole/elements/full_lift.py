"""A lift of the whole foot, for a leg that is shorter than a lift of the heel alone can make up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Number, Share
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.blending import smooth_step
from insole_core.messages import Message

_HEEL, _HEADS, _TOES = 0.25, 0.7, 1.0
"""Shares of the length up to which the heel is lifted in full, where the metatarsal heads lie, and
where the lift has run out."""


@dataclass(frozen=True, kw_only=True)
class FullLift(Correction):
    """A lift from heel to toes: full at the heel, a share of it at the heads, none at the toes."""

    type, name = "full_lift", "Full-length lift"
    tip = "Raise heel and ball together, for legs of unequal length"
    stage, order = "sole", 25

    height_mm: Annotated[float, Number("Height", "How much the heel is raised", 0, 10, main="")] = (
        8.0
    )
    heads_share: Annotated[
        float,
        Share(
            "At the heads",
            "How much of the height the metatarsal heads are raised",
            main="{value} of it at the heads",
        ),
    ] = 0.5

    def raised_mm(self, share: FloatArray) -> FloatArray:
        """Return by how much it raises the sections at shares (n,) of the length."""
        to_heads = (1 - self.heads_share) * smooth_step(share, _HEEL, _HEADS)
        to_toes = self.heads_share * smooth_step(share, _HEADS, _TOES)
        return np.asarray(self.height_mm * (1 - to_heads - to_toes))

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn of a ball that is lifted too high for a shoe, with all that lifts it."""
        height_mm = rounded(judged.lifted_mm(_HEADS), SHOWN)
        usual_mm = judged.rules.greatest_ball_lift_mm
        if mine and height_mm > usual_mm:
            lifted = Message(
                "The ball is lifted by {height_mm:g} mm; on the device up to {usual_mm:g} mm are "
                "usual.",
                height_mm=height_mm,
                usual_mm=usual_mm,
            )
            yield DesignWarning(lifted, mine[-1].id)

    def brief(self) -> Message:
        """Return its height."""
        return mm_message(self.height_mm)
