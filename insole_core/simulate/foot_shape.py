"""The measures that a simulated foot is made to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import UsageError
from insole_core.geometry.side import Side

_LIMITS = {
    "length_mm": (180.0, 290.0),
    "ball_width_mm": (70.0, 120.0),
    "heel_width_mm": (50.0, 80.0),
    "arch_height_mm": (10.0, 32.0),
    "rearfoot_eversion_deg": (-15.0, 15.0),
}


@dataclass(frozen=True)
class FootShape:
    """What a simulated foot looks like.

    Parameters
    ----------
    length_mm
        Pternion to the tip of the longest toe, along +y.
    ball_width_mm
        Metatarsale tibiale to metatarsale fibulare, the diagonal distance.
    heel_width_mm
        Greatest width of the heel, for a neutral rearfoot.
    arch_height_mm
        Highest point of the sole above the ground, on the line from the heel to the first head.
    rearfoot_eversion_deg
        Bisection of the heel against the lower leg; positive when the sole of the heel is turned
        outwards (valgus, the heel leans towards the medial side going up).
    side

    Raises
    ------
    UsageError
        When a measure is none of a foot.
    """

    length_mm: float = 245.0
    ball_width_mm: float = 97.0
    heel_width_mm: float = 66.0
    arch_height_mm: float = 19.0
    rearfoot_eversion_deg: float = 3.0
    side: Side = Side.LEFT

    def __post_init__(self) -> None:
        for name, (low, high) in _LIMITS.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise UsageError(
                    f"A foot with {name} = {value:g} cannot be simulated; "
                    f"choose a value from {low:g} to {high:g}."
                )


def vary_shape(rng: np.random.Generator, side: Side) -> FootShape:
    """Draw a plausible adult foot."""
    length_mm = rng.uniform(230, 265)
    return FootShape(
        length_mm=length_mm,
        ball_width_mm=length_mm * rng.uniform(0.38, 0.41),
        heel_width_mm=length_mm * rng.uniform(0.255, 0.28),
        arch_height_mm=rng.uniform(13, 26),
        rearfoot_eversion_deg=rng.uniform(-1, 6),
        side=side,
    )
