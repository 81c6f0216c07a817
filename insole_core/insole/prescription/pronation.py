"""The posting that a measured pronation suggests, by steps (resources/rules/rules.json)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class PronationStep:
    """The medial rearfoot posting that is usual from this eversion on; degrees."""

    from_deg: float
    post_deg: float


def proposed_post_deg(eversion_deg: float, steps: Sequence[PronationStep]) -> float:
    """Return the usual rearfoot posting in degrees, > 0 medial; 0 if none is usual.

    Parameters
    ----------
    eversion_deg
        Of the rearfoot: the Achilles axis relative to the sole, > 0 is valgus.
    """
    return max((s.post_deg for s in steps if eversion_deg >= s.from_deg), default=0.0)
