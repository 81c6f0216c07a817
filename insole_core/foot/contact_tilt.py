"""How far the plane on which heel and ball of a foot would stand is from level."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot

_HEEL, _BALL = (0.0, 0.3), (0.55, 0.85)  # shares of the foot's length from the rear
_FACING = -0.5  # z of the normals of the sole
_LOW_MM = 45.0
_LOWEST = 0.02  # share of a region's points that would touch the ground: no single point decides


@dataclass(frozen=True)
class ContactTilt:
    """Where heel and ball would touch level ground.

    Parameters
    ----------
    heel_mm, ball_mm
        Heights of both, insole frame.
    angle_deg
        Of the line between both against the level; positive with the ball lower.
    """

    heel_mm: float
    ball_mm: float
    angle_deg: float


def contact_tilt(foot: Foot) -> ContactTilt | None:
    """Return the tilt of a foot as it lies; None where heel or ball was not scanned.

    The pose of a foot levels heel centre, 1st and 5th head. The heads between them hang lower on a
    foot that carries no weight, and after a foot was turned all of them may.
    """
    return foot.derived.get("contact tilt", (), lambda: _tilt(foot))


def _tilt(foot: Foot) -> ContactTilt | None:
    points = foot.even.points
    sole = points[(foot.even.normals[:, 2] < _FACING) & (points[:, 2] < _LOW_MM)]
    share = (sole[:, 1] - points[:, 1].min()) / foot.length_mm
    regions = [sole[(first < share) & (share < last)] for first, last in (_HEEL, _BALL)]
    if any(len(region) == 0 for region in regions):
        return None
    lowest = [region[region[:, 2] <= np.quantile(region[:, 2], _LOWEST)] for region in regions]
    (_, heel_y, heel_z), (_, ball_y, ball_z) = (region.mean(axis=0) for region in lowest)
    angle_deg = float(np.degrees(np.arctan2(heel_z - ball_z, ball_y - heel_y)))
    return ContactTilt(float(heel_z), float(ball_z), angle_deg)
