"""Judge whether a colour picture is well lit."""

from __future__ import annotations

from enum import Enum

import numpy as np

from insole_core.geometry.arrays import ByteArray

_DARK_LEVEL = 60
_BRIGHT_LEVEL = 250
_BRIGHT_SHARE = 0.1
_STEP_PX = 4


class Light(Enum):
    """The brightness of a picture."""

    DARK = "dark"
    GOOD = "good"
    BRIGHT = "bright"


def judge_light(picture: ByteArray) -> Light:
    """Judge a colour picture (height, width, 3) uint8, RGB, by its brightest parts."""
    brightest = picture[::_STEP_PX, ::_STEP_PX].max(axis=2)
    if np.mean(brightest >= _BRIGHT_LEVEL) > _BRIGHT_SHARE:
        return Light.BRIGHT
    return Light.DARK if np.percentile(brightest, 95) < _DARK_LEVEL else Light.GOOD
