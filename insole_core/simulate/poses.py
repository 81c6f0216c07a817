"""Poses of the simulated sensors."""

from __future__ import annotations

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


def stand_sensor(
    view: str, distance_mm: float, half_angle_deg: float, rng: np.random.Generator
) -> FloatArray:
    """Draw the pose of a sensor set up by hand: near its nominal position, aimed near the middle.

    Parameters
    ----------
    view
        ``left`` and ``right`` look at the sole from -x and +x, ``top`` at the Achilles tendon.
    distance_mm
        From the foot.
    half_angle_deg
        Angle of the sole sensors' axes to the z axis.
    rng

    Returns
    -------
    (4, 4) float64, mm, depth camera frame to reference frame
    """
    if view == "top":
        target, down, backwards = _ACHILLES_CENTRE_MM, _DORSAL, -_TOES
        turn = rotation_about(np.array([1.0, 0.0, 0.0]), -_TOP_ELEVATION_DEG)
    else:
        target, down, backwards = _SOLE_CENTRE_MM, _TOES, -_DORSAL
        turn = rotation_about(_TOES, half_angle_deg if view == "left" else -half_angle_deg)
    position = target + distance_mm * (turn @ backwards) + rng.normal(0, _PLACE_SPREAD_MM, 3)
    aim = target + rng.normal(0, _AIM_SPREAD_MM, 3)
    down = rotation_about(backwards, rng.normal(0, _ROLL_SPREAD_DEG)) @ down
    return look_at(position, aim, down)
