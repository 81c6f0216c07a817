from __future__ import annotations

import numpy as np
import pytest
from simulated_board import COLOR_CAMERA, sight, spread_poses

from insole_core.calibration.boards.board import BoardDetection, Chequerboard
from insole_core.calibration.boards.board_plan import EACH_WITH_DEPTH, missing_turns, turn_of
from insole_core.geometry.transforms import rigid, rotation_about

BOARD = Chequerboard(10, 7, 30)


def turned(about: tuple[float, float, float], angle_deg: float) -> BoardDetection:
    """A board 800 mm away, turned about an axis of the camera (x right, y down, z forward)."""
    rotation = rotation_about(np.array(about), angle_deg)
    place = np.array([0, 0, 800.0]) - rotation @ BOARD.points_mm.mean(0)
    return sight("color", BOARD, rigid(rotation, place), COLOR_CAMERA)


@pytest.mark.parametrize(
    ("about", "angle_deg", "side"),
    [((0, 1, 0), 45, "left"), ((0, 1, 0), -45, "right"), ((1, 0, 0), 45, "down"),
     ((1, 0, 0), -45, "up")],
)  # fmt: skip
def test_the_side_a_board_looks_to(
    about: tuple[float, float, float], angle_deg: float, side: str
) -> None:
    angle, found = turn_of(turned(about, angle_deg))
    assert found == side
    assert angle == pytest.approx(45, abs=2)


def test_what_is_missing_to_each_side() -> None:
    some = [turned((0, 1, 0), 45)] * 3 + [turned((1, 0, 0), 45), turned((1, 0, 0), -20)]
    assert missing_turns(some, 3) == {"right": 3, "up": 3, "down": 2}
    plan = spread_poses(3, 4 * EACH_WITH_DEPTH, BOARD, np.eye(4))
    seen = [sight("color", BOARD, placed, COLOR_CAMERA) for placed in plan]
    assert missing_turns(seen, EACH_WITH_DEPTH) == {}
