"""Which posting a measured pronation suggests: the steps are data (resources/rules/rules.json)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class PronationStep:
    """From this eversion on, this much medial rearfoot posting is usual; degrees."""

    from_deg: float
    post_deg: float


def proposed_post_deg(eversion_deg: float, steps: Sequence[PronationStep]) -> float:
    """Give the rearfoot posting in degrees, > 0 medial; 0 where none is usual.

    Parameters
    ----------
    eversion_deg
        Of the rearfoot: the Achilles axis against the sole, > 0 is valgus.
    steps
        In rising order.
    """
    return max((s.post_deg for s in steps if eversion_deg >= s.from_deg), default=0.0)
