"""A raised heel."""

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
from insole_core.insole.fields import Number, OfLength
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.blending import smooth_step
from insole_core.messages import Message


@dataclass(frozen=True, kw_only=True)
class HeelLift(Correction):
    """A raised heel, with a smooth transition to the forefoot."""

    type, name = "heel_lift", "Heel lift"
    tip = "Raise the whole heel"
    stage, order = "sole", 20

    height_mm: Annotated[
        float, Number("Height", "How much the heel is raised", -10, 20, main="")
    ] = 3.0
    fade_start: Annotated[
        float,
        OfLength(
            "Full up to",
            "Share of the foot's length up to which the heel is raised in full",
            before="fade_end",
        ),
    ] = 0.25
    fade_end: Annotated[
        float,
        OfLength(
            "Ends at", "Share of the foot's length at which the lift ends", after="fade_start"
        ),
    ] = 0.65

    def raised_mm(self, share: FloatArray) -> FloatArray:
        """Return by how much it raises the sections at shares (n,) of the length."""
        return np.asarray(self.height_mm * (1 - smooth_step(share, self.fade_start, self.fade_end)))

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn of a heel that is lifted too high, with all that lifts it."""
        height_mm = rounded(judged.lifted_mm(0.0), SHOWN)
        usual_mm = judged.rules.greatest_heel_lift_mm
        # A full-length lift without a heel lift is what a greater height is made by.
        if mine and height_mm > usual_mm:
            lifted = Message(
                "The heel is lifted by {height_mm:g} mm; on the device up to {usual_mm:g} mm are "
                "usual.",
                height_mm=height_mm,
                usual_mm=usual_mm,
            )
            yield DesignWarning(lifted, mine[-1].id)

    def brief(self) -> Message:
        """Return its height."""
        return mm_message(self.height_mm)
