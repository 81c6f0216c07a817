"""Pads and recesses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction, reflected
from insole_core.insole.elements.words import mm_message, number_message
from insole_core.insole.grips import Grip, Pull, place_at
from insole_core.insole.judged import Judged
from insole_core.insole.pads.clearance import snapped_mm
from insole_core.insole.pads.pad_form import PadForm
from insole_core.insole.pads.pad_grips import pad_grips, pulled_values
from insole_core.insole.pads.pad_heights import closed_outline
from insole_core.insole.pads.pad_warnings import overlaps, sentences_of
from insole_core.messages import Message

_COPY_BEHIND_MM = 10.0


@dataclass(frozen=True, kw_only=True)
class Pelott(PadForm, Correction):
    """A pad on the contact surface, thesis 6.3.2; a recess if its height is negative."""

    type, name = "pelott", "Pelott"
    stage, is_seen = "pad", True

    @property
    def is_of_one_foot(self) -> bool:
        """Whether no finding proposes it as it is: a finding proposes those of the library."""
        return True

    def turned_by(self, yaw_deg: float) -> Pelott:
        """Return it turned with the foot."""
        return replace(self, turn_deg=round((self.turn_deg + yaw_deg + 180) % 360 - 180, 2))

    def mirrored(self) -> Pelott:
        """Return it for the other foot."""
        # Every shape is symmetric across its width, but the arch support, which is along its length
        turn = 180.0 - self.turn_deg if self.shape == "arch_support" else -self.turn_deg
        unwound = turn if abs(turn) <= 360 else turn - 360 * (1 if turn > 0 else -1)
        return replace(reflected(self), turn_deg=unwound)

    def copied(self) -> Self:
        """Return a copy, behind this one."""
        x, y = self.centre_mm
        return replace(super().copied(), centre_mm=(x, y - _COPY_BEHIND_MM))

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn of pads beside the foot, too high or too deep, in a wrong place, on each other."""
        for pad in mine:
            for sentence in sentences_of(pad, judged):
                yield DesignWarning(sentence, pad.id, pad.centre_mm)
        for small, sentence in overlaps(mine, judged.rules):
            yield DesignWarning(sentence, small.id, small.centre_mm)

    def lines(self, _foot: Foot) -> tuple[FloatArray, ...]:
        """Return its outline."""
        return (closed_outline(self),)

    def grips(self, _foot: Foot) -> tuple[Grip, ...]:
        """Return those that move, stretch, turn and raise it, and the corners of a free shape."""
        return pad_grips(self)

    def pulled(self, grip: str, pull: Pull, _foot: Foot) -> Self:
        """Return it as a grip was pulled."""
        return replace(self, **pulled_values(self, grip, pull))

    def settled(self, heads_mm: FloatArray, behind_heads_mm: float) -> Self:
        """Return it at the usual distance behind the heads, if it is almost there."""
        if not self.ends_behind_heads:
            return self
        moved_mm = snapped_mm(self, heads_mm, behind_heads_mm)
        if moved_mm is None:
            return self
        return replace(self, centre_mm=place_at(np.array(self.centre_mm) + moved_mm, 0.01))

    def brief(self) -> Message:
        """Return its height or depth, and its size."""
        height = self.height_text()
        if self.outline_mm is not None:
            return height
        return Message(
            "{height} ({length} × {width})",
            height=height,
            length=number_message(self.length_mm),
            width=number_message(self.width_mm),
        )

    @property
    def has_plain_height(self) -> bool:
        """Whether its height is told as a number alone, without saying high or deep."""
        return self.height_mm >= 0 and not self.is_recess

    def height_text(self) -> Message:
        """Return its height, or the depth of a recess."""
        if self.has_plain_height:
            return mm_message(self.height_mm)
        if self.height_mm > 0:
            return Message("{height} mm high", height=number_message(self.height_mm))
        return Message("{depth} mm deep", depth=number_message(-self.height_mm))
