"""Find the lower leg above a foot, however it is inclined, and cut it off."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot_candidate import CutLeg, Point
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.sections import cut_off

# Shares of the foot's length.
_ANKLE_Y, _ANKLE_Z = 0.25, 0.27
_LEG_FROM = 0.10
"""From the ankle, above which the surface is leg in whatever way it is inclined."""
_KEPT = 0.40
"""From the ankle; the back of the leg is measured up to 140 mm over the sole."""
_LEAST_CUT = 0.10
_LEAST_POINTS = 200
_SIDE_ON, _ROUNDS = 0.6, 3
_UP = np.array([0.0, 0.0, 1.0])


def leg_of(foot: EvenSurface, length_mm: float) -> CutLeg | None:
    """Find the leg of a foot, if there is more of it than the foot needs.

    Parameters
    ----------
    foot : mm, insole frame
    length_mm

    Returns
    -------
    CutLeg or None
    """
    points = foot.points
    above = points[:, 2] > (_ANKLE_Z + _LEG_FROM) * length_mm
    if np.count_nonzero(above) < _LEAST_POINTS:
        return None
    at_ankle = np.abs(points[:, 1:] - np.array([_ANKLE_Y, _ANKLE_Z]) * length_mm).max(axis=1)
    near = points[at_ankle < _LEG_FROM * length_mm, 0]
    if len(near) == 0:
        return None
    ankle = np.array([np.median(near), _ANKLE_Y * length_mm, _ANKLE_Z * length_mm])
    axis = _direction(foot.facets[above], foot.area_mm2[above])
    along = (points - ankle) @ axis
    kept_mm = _KEPT * length_mm
    if along.max() < kept_mm + _LEAST_CUT * length_mm:
        return None
    end = ankle + kept_mm * axis
    inclined_deg = float(np.degrees(np.arctan2(-axis[1], axis[2])))
    return CutLeg(float(end[2]), 90.0 + inclined_deg, _point(end), _point(axis))


def _direction(normals: FloatArray, area_mm2: FloatArray) -> FloatArray:
    """Return the unit vector up the leg: the direction in which its surface faces least.

    The way in which the scan ends says nothing of it; nor does a lid there, which faces along it.
    """
    weights = area_mm2.copy()
    axis = _UP
    for _ in range(_ROUNDS):
        axis = np.linalg.eigh((normals * weights[:, None]).T @ normals)[1][:, 0]
        weights = np.where(np.abs(normals @ axis) < _SIDE_ON, area_mm2, 0.0)
    return np.asarray(axis * np.sign(axis @ _UP))


def _point(vector: FloatArray) -> Point:
    x, y, z = (float(value) for value in vector)
    return x, y, z


def is_leg(points: FloatArray, leg: CutLeg) -> BoolArray:
    """Return which of some points (n, 3), mm, insole frame, are cut off."""
    return _beyond(points, leg) > 0


def _beyond(points: FloatArray, leg: CutLeg) -> FloatArray:
    return np.asarray((points - np.array(leg.end)) @ np.array(leg.axis))


def without_leg(mesh: TriangleMesh, leg: CutLeg) -> TriangleMesh:
    """Cut the leg off a foot.

    Parameters
    ----------
    mesh : mm, insole frame
    leg
    """
    return cut_off(mesh, -_beyond(mesh.vertices, leg))
