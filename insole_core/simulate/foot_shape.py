"""The measures of a simulated foot, and the ranges of values that can be simulated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from insole_core.errors import UsageError
from insole_core.geometry.side import Side

Limits = Mapping[str, tuple[str, float, float]]
"""Attribute -> description, least and greatest value."""
_LIMITS: Limits = {
    "length_mm": ("length of the simulated foot (mm)", 180, 290),
    "ball_width_mm": ("ball width of the simulated foot (mm)", 70, 120),
    "heel_width_mm": ("heel width of the simulated foot (mm)", 50, 80),
    "arch_height_mm": ("arch height of the simulated foot (mm)", 10, 32),
    "rearfoot_eversion_deg": ("rearfoot eversion of the simulated foot (degrees)", -15, 15),
}


def check_limits(values: object, limits: Limits) -> None:
    """Check the attributes of an object against their limits.

    Parameters
    ----------
    values
        Any object that has the attributes; one that is None is not checked.
    limits
        Both ends are included.

    Raises
    ------
    UsageError
        Names the first attribute that is out of range or NaN.
    """
    for attribute, (words, low, high) in limits.items():
        value = getattr(values, attribute)
        if value is not None and not low <= value <= high:
            raise UsageError(
                "The {what} cannot be {value:g}; choose a value from {least:g} to {most:g}.",
                what=words,
                value=value,
                least=low,
                most=high,
            )


@dataclass(frozen=True)
class FootShape:
    """The shape of a simulated foot.

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
        Angle of the heel's bisection to the lower leg; positive when the sole of the heel is turned
        outwards (valgus, the heel leans towards the medial side going up).
    side

    Raises
    ------
    UsageError
        When a measure is out of its range.
    """

    length_mm: float = 245.0
    ball_width_mm: float = 97.0
    heel_width_mm: float = 66.0
    arch_height_mm: float = 19.0
    rearfoot_eversion_deg: float = 3.0
    side: Side = Side.LEFT

    def __post_init__(self) -> None:
        check_limits(self, _LIMITS)


def vary_shape(rng: np.random.Generator, side: Side) -> FootShape:
    """Draw the shape of a plausible adult foot."""
    length_mm = rng.uniform(230, 265)
    return FootShape(
        length_mm=length_mm,
        ball_width_mm=length_mm * rng.uniform(0.38, 0.41),
        heel_width_mm=length_mm * rng.uniform(0.255, 0.28),
        arch_height_mm=rng.uniform(13, 26),
        rearfoot_eversion_deg=rng.uniform(-1, 6),
        side=side,
    )
