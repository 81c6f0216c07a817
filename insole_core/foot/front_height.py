"""How high a surface is where the toes of a foot would lie.

A foot is thin there, in whatever way the leg is held. A limb that lies down, and a foot whose heel
was taken for its toes, are not.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.pose import Pose
from insole_core.geometry.arrays import FloatArray

MOST_FRONT_HEIGHT = 0.27
"""Of the toes, in shares of the length; of feet it is 0.08 to 0.15, without toes up to 0.25."""
_USUAL_FRONT_HEIGHT = 0.15
_FRONT_WEIGHT = 1.5
_BAND = (0.86, 0.94)
_UPWARD, _LEAST_POINTS = 0.5, 15
_UPPER, _ALL = 30, 90  # percentiles; what hangs over the toes, such as a leg, does not count


def front_height(points: FloatArray, normals: FloatArray, source2rough: FloatArray) -> float:
    """Measure the height over the ground at 86 to 94 % of the length, in shares of the length.

    Parameters
    ----------
    points, normals : (n, 3) float64, mm
        Evenly spread over the surface.
    source2rough : (4, 4) float64, mm
        To toes +y, dorsal +z.
    """
    y, z = (points @ source2rough[1:3, :3].T).T
    z = z - z.min()
    low = y[z < OUTLINE_HEIGHT_MM]
    length_mm = max(float(np.ptp(low)), 1.0)
    share = (y - low.min()) / length_mm
    band = (share > _BAND[0]) & (share < _BAND[1])
    upper = band & (normals @ source2rough[2, :3] > _UPWARD)
    if upper.sum() >= _LEAST_POINTS:
        return float(np.percentile(z[upper], _UPPER)) / length_mm
    return float(np.percentile(z[band], _ALL)) / length_mm if band.any() else 0.0


def rated_pose(pose: Pose, points: FloatArray, normals: FloatArray) -> Pose:
    """Add to the dissimilarity of a pose what it is too high at the toes, or lacks of a foot."""
    excess = front_height(points, normals, pose.source2rough) - _USUAL_FRONT_HEIGHT
    rating = pose.side_dissimilarity + pose.lacking + _FRONT_WEIGHT * max(excess, 0.0)
    return replace(pose, side_dissimilarity=rating)
