"""Rotate a foot in its frame: by its landmarks, or by angles that the user sets.

The landmarks define the frame: heel centre, 1st and 5th head lie at the same height, and the line
from the heel centre to the tip of the 2nd toe runs along y. All angles are relative to it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM, at_origin, level
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about

_LEAST_BASE_MM = 30.0  # the three points of the sole must span this much to define a plane


@dataclass(frozen=True)
class PoseAngles:
    """The rotation of a foot relative to the frame of its landmarks, degrees.

    Parameters
    ----------
    pitch_deg
        Greater than 0 with the toe end up.
    roll_deg
        Greater than 0 with the medial edge up, for either foot.
    yaw_deg
        Greater than 0 with the toes turned medially, for either foot.
    """

    pitch_deg: float = 0.0
    roll_deg: float = 0.0
    yaw_deg: float = 0.0


def pose_angles(foot: Foot, landmarks: Landmarks) -> PoseAngles:
    """Compute the rotation of a foot relative to its landmarks; 0 right after it was aligned.

    Parameters
    ----------
    foot
    landmarks
        With heel centre, 1st and 5th head and the tip of the 2nd toe; insole frame.

    Returns
    -------
    PoseAngles

    Raises
    ------
    InputError
        When the landmarks are in an order that no foot has.
    """
    lies = _landmark_frame(foot, landmarks).T  # = z-turn @ x-turn @ y-turn
    sign = foot.side.medial_sign
    pitch = np.arcsin(np.clip(lies[2, 1], -1, 1))
    roll = np.arctan2(-lies[2, 0], lies[2, 2])
    yaw = np.arctan2(-lies[0, 1], lies[1, 1])
    degrees = np.degrees([pitch, -sign * roll, -sign * yaw])
    return PoseAngles(*(float(angle) + 0.0 for angle in degrees))


def turned(foot: Foot, landmarks: Landmarks, angles: PoseAngles) -> Foot:
    """Rotate a foot to the given angles relative to its landmarks; all 0 aligns it.

    The heel centre is moved to x = 0, the rearmost point of the heel to y = 0, the lowest to z = 0.

    Parameters
    ----------
    foot
    landmarks
        With heel centre, 1st and 5th head and the tip of the 2nd toe; insole frame of `foot`.
    angles

    Returns
    -------
    Foot
        In the new insole frame.

    Raises
    ------
    InputError
        When the landmarks are in an order that no foot has.
    """
    x, y, z = np.eye(3)
    sign = foot.side.medial_sign
    lies = (
        rotation_about(z, -sign * angles.yaw_deg)
        @ rotation_about(x, angles.pitch_deg)
        @ rotation_about(y, -sign * angles.roll_deg)
    )
    rotation = lies @ _landmark_frame(foot, landmarks)
    heel = rotation @ landmarks["heel_centre"].point
    vertices = foot.mesh.vertices @ rotation.T
    ground = float(vertices[:, 2].min())
    low = vertices[vertices[:, 2] < ground + OUTLINE_HEIGHT_MM]
    step = rigid(rotation, -np.array([heel[0], float(low[:, 1].min()), ground]))
    return replace(
        foot,
        mesh=foot.mesh.transformed(step),
        source2insole=step @ foot.source2insole,
        length_mm=foot.length_mm * float(np.ptp(low[:, 1])) / _low_length_mm(foot),
    )


def quarter_turned(foot: Foot, axis: int, quarters: int) -> Foot:
    """Rotate a foot that was placed wrongly by right angles, and stand it on the ground.

    Parameters
    ----------
    foot
    axis
        0 to tip it from heel to toe, 1 to roll it sideways, 2 to turn it on the ground.
    quarters
        Number of right angles, counter-clockwise about the axis of the insole frame.

    Returns
    -------
    Foot
        In the new insole frame; its length is that of its outline near the ground.
    """
    rotation = np.rint(rotation_about(np.eye(3)[axis], 90.0 * quarters))
    vertices = foot.mesh.vertices @ rotation.T
    ground = float(vertices[:, 2].min())
    low = vertices[vertices[:, 2] < ground + OUTLINE_HEIGHT_MM]
    across = float(low[:, 0].min() + low[:, 0].max()) / 2
    step = rigid(rotation, -np.array([across, float(low[:, 1].min()), ground]))
    return replace(
        foot,
        mesh=foot.mesh.transformed(step),
        source2insole=step @ foot.source2insole,
        length_mm=float(np.ptp(low[:, 1])),
    )


def levelled(foot: Foot) -> Foot:
    """Let a foot that lies roughly right, to some 15 degrees, rest on its sole along its axis.

    Raises
    ------
    InputError
        When nothing faces the ground.
    """
    found = level(foot.even, foot.side, np.eye(4))
    step = at_origin(foot.measured, found.source2insole)
    return replace(
        foot,
        mesh=foot.mesh.transformed(step),
        source2insole=step @ foot.source2insole,
        length_mm=found.length_mm,
    )


def _low_length_mm(foot: Foot) -> float:
    z = foot.mesh.vertices[:, 2]
    return float(np.ptp(foot.mesh.vertices[z < z.min() + OUTLINE_HEIGHT_MM, 1]))


def _landmark_frame(foot: Foot, landmarks: Landmarks) -> FloatArray:
    """Return the rotation (3, 3) to the landmarks' frame: its rows are across, ahead and up."""
    names = ("heel_centre", "metatarsal_head_1", "metatarsal_head_5", "toe_tip_2")
    heel, first, fifth, toe = (landmarks[name].point for name in names)
    up = np.cross(first - heel, fifth - heel) * foot.side.medial_sign
    size = float(np.linalg.norm(up))
    if size < _LEAST_BASE_MM**2 or up[2] < 0.5 * size or (toe - heel)[1] <= 0:
        raise InputError(
            "The landmarks stand in an order that no foot has: heel centre, 1st and 5th head and"
            " the tip of the 2nd toe must lie around the sole; drag them to their places, or find"
            " the landmarks anew."
        )
    up = up / size
    ahead = toe - heel
    ahead = ahead - (ahead @ up) * up
    ahead = ahead / np.linalg.norm(ahead)
    return np.stack([np.cross(ahead, up), ahead, up])
