"""What can be set of a camera."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Preset(Enum):
    """How strictly the camera judges its own matches."""

    HIGH_ACCURACY = 3
    """Few wrong readings, and more gaps."""
    HIGH_DENSITY = 4
    """Few gaps, and more wrong readings."""


@dataclass(frozen=True)
class CameraSettings:
    """What can be set of a camera.

    Parameters
    ----------
    preset
        None leaves it as it is.
    laser_mw
        Power of its projector; None leaves it as it is.
    infrared
        Stream the pair of infrared pictures too.
    """

    preset: Preset | None = Preset.HIGH_ACCURACY
    laser_mw: float | None = None
    infrared: bool = False
