"""The pose of a foot by three points that a user has clicked on its scan."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about

_LEAST_LENGTH_MM = 60.0
_NEAR_MM = 15.0
_LEAST_DEPTH_MM = 8.0  # of the sole below the line from heel to toe, to tell what is below
_ROLLS_DEG = (-20.0, 0.0, 20.0)


def clicked_frames(
    points: FloatArray, normals: FloatArray, clicks: PoseClicks
) -> Iterator[FloatArray]:
    """Return the frames (4, 4) in which a foot may lie, toes +y and dorsal +z.

    What faces away from the foot at the clicked sole is below. Where the sole was clicked beside
    the line from heel to toe, so is that place, in case the surface is inside out.

    Parameters
    ----------
    points, normals : (n, 3) float64, mm, source frame
        Evenly spread over the surface.
    clicks

    Raises
    ------
    InputError
        When heel and toe are too near each other.
    """
    heel, toe, sole = (np.array(place) for place in (clicks.heel, clicks.toe, clicks.sole))
    ahead = toe - heel
    length_mm = float(np.linalg.norm(ahead))
    if length_mm < _LEAST_LENGTH_MM:
        raise InputError(
            "Heel and toe were clicked {length_mm:.0f} mm from each other, which is no foot; click "
            "the end of the heel, the tip of a toe and the sole again.",
            length_mm=length_mm,
        )
    ahead /= length_mm
    across = np.eye(3) - np.outer(ahead, ahead)
    depth = across @ (sole - heel)
    far_mm = np.linalg.norm(points - sole, axis=1)
    facing = across @ normals[far_mm <= max(_NEAR_MM, float(far_mm.min()) + 1)].mean(axis=0)
    downs = [facing]
    if np.linalg.norm(depth) > _LEAST_DEPTH_MM:
        downs.append(depth)
    for down in downs:
        if np.linalg.norm(down) > 1e-6:
            up = -down / np.linalg.norm(down)
            for roll in _ROLLS_DEG:
                turned = rotation_about(ahead, roll) @ up
                yield rigid(np.stack([np.cross(ahead, turned), ahead, turned]), np.zeros(3))
