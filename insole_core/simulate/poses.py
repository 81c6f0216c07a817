"""Poses of the simulated sensors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about

_TOES = np.array([0.0, 1.0, 0.0])
_DORSAL = np.array([0.0, 0.0, 1.0])
_SOLE_CENTRE_MM = np.array([0.0, 12.0, 5.0])
_ACHILLES_CENTRE_MM = np.array([0.0, -112.0, 96.0])
_TOP_ELEVATION_DEG = 9.0
_PLACE_SPREAD_MM = 6.0
_AIM_SPREAD_MM = 8.0
_ROLL_SPREAD_DEG = 0.6
_THREE_EACH = 6


def look_at(position: FloatArray, target: FloatArray, down: FloatArray) -> FloatArray:
    """Compute the pose of a camera that looks at a target.

    Parameters
    ----------
    position, target : (3,) float64, mm, reference frame
    down : (3,) float64
        Direction that appears as down in the image.

    Returns
    -------
    (4, 4) float64, mm
        Camera frame to reference frame.
    """
    forward = (target - position) / np.linalg.norm(target - position)
    right = np.cross(down, forward)
    right /= np.linalg.norm(right)
    return rigid(np.stack([right, np.cross(forward, right), forward], axis=1), position)


@dataclass(frozen=True)
class Stand:
    """The nominal place of a sensor.

    Parameters
    ----------
    face
        The marker group that it sees: ``sole``, or ``achilles`` for one above the tendon.
    aside
        Of a sensor at the sole, the side it stands on: -1 towards -x, 1 towards +x, 0 below.
    aim_x_mm
        Where it aims at, reference frame.
    """

    face: str
    aside: int = 0
    aim_x_mm: float = 0.0


AROUND_ONE_FOOT = {
    "left": Stand("sole", -1),
    "right": Stand("sole", 1),
    "top": Stand("achilles"),
}
"""By the name of the view."""


def stands_around_both(sensors: int, left_mm: float, right_mm: float) -> dict[str, Stand]:
    """Return the places of four to six sensors around both feet, by the names of their views.

    Four look at both soles from the sides, and at each tendon; a fifth looks at the soles from
    below; of six, each foot has three, as a single one has.

    Parameters
    ----------
    sensors
    left_mm, right_mm
        Position of the feet along x, reference frame.
    """
    tops = {
        "left_top": Stand("achilles", aim_x_mm=left_mm),
        "right_top": Stand("achilles", aim_x_mm=right_mm),
    }
    if sensors == _THREE_EACH:
        return {
            "far_left": Stand("sole", -1, left_mm),
            "left": Stand("sole", -1, right_mm),
            "right": Stand("sole", 1, left_mm),
            "far_right": Stand("sole", 1, right_mm),
            **tops,
        }
    middle = {"middle": Stand("sole")} if sensors > len(tops) + 2 else {}
    return {"left": Stand("sole", -1), **middle, "right": Stand("sole", 1), **tops}


def stand_sensor(
    stand: Stand, distance_mm: float, half_angle_deg: float, rng: np.random.Generator
) -> FloatArray:
    """Draw the pose of a sensor set up by hand: near its nominal position, aimed near the middle.

    Parameters
    ----------
    stand
    distance_mm
        From the foot.
    half_angle_deg
        Angle of the axes of the sole sensors at the sides to the z axis.
    rng

    Returns
    -------
    (4, 4) float64, mm, depth camera frame to reference frame
    """
    if stand.face == "achilles":
        target, down, backwards = _ACHILLES_CENTRE_MM, _DORSAL, -_TOES
        turn = rotation_about(np.array([1.0, 0.0, 0.0]), -_TOP_ELEVATION_DEG)
    else:
        target, down, backwards = _SOLE_CENTRE_MM, _TOES, -_DORSAL
        turn = rotation_about(_TOES, -stand.aside * half_angle_deg)
    target = target + np.array([stand.aim_x_mm, 0.0, 0.0])
    position = target + distance_mm * (turn @ backwards) + rng.normal(0, _PLACE_SPREAD_MM, 3)
    aim = target + rng.normal(0, _AIM_SPREAD_MM, 3)
    down = rotation_about(backwards, rng.normal(0, _ROLL_SPREAD_DEG)) @ down
    return look_at(position, aim, down)
