"""Board positions for calibrating the depth camera: those needed, and those still missing.

The pose is limited by how well the corners determine the board's distance, so by how strongly it is
turned (`benchmarks/board_depth_limits.py`); if it is only turned to one side, a translation looks
like a rotation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.boards.intrinsics import nominal_normal
from insole_core.messages import Message, joined

SIDE_WORDS = {"left": "to the left", "right": "to the right", "up": "upwards", "down": "downwards"}
SIDES = tuple(SIDE_WORDS)
LEAST_TURN_DEG = 35.0
EACH_WITH_DEPTH, EACH_WITH_INFRARED = 12, 4
"""Positions to each side, for an accuracy of half a millimetre."""


def turn_of(detection: BoardDetection) -> tuple[float, str]:
    """Return the angle between board and picture, and the side of `SIDES` that the board faces."""
    x, y, z = (-nominal_normal(detection)).tolist()  # towards the camera
    angle_deg = float(np.degrees(np.arctan2(np.hypot(x, y), abs(z))))
    across, along = ("left" if x < 0 else "right"), ("up" if y < 0 else "down")
    return angle_deg, across if abs(x) > abs(y) else along


def missing_turns(detections: Sequence[BoardDetection], each: int) -> dict[str, int]:
    """Count the missing positions to each side; sides with enough are left out.

    Parameters
    ----------
    each
        Number of positions needed to each side, turned by `LEAST_TURN_DEG` or more.
    """
    turns = [turn_of(detection) for detection in detections]
    strong = [side for angle_deg, side in turns if angle_deg >= LEAST_TURN_DEG]
    return {side: each - strong.count(side) for side in SIDES if strong.count(side) < each}


def turns_text(turns: Mapping[str, int]) -> Message:
    """List positions by side, such as ``4 × to the left, 2 × upwards``."""
    return joined(
        Message("{count}\u00a0×\u00a0{side}", count=count, side=SIDE_WORDS[side])
        for side, count in turns.items()
    )
