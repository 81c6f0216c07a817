"""How far up the foot itself reaches beside the edge of its insole."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.finishing.edge import Edge, insole_edge
from insole_core.insole.prescription.outline import Outline

_HIGHEST_MM = 45.0  # no rim is higher
_BESIDE_MM = 7.0
_SIGMA_MM = 4.0


def flank_heights(foot: Foot, outline: Outline) -> FloatArray:
    """Return the greatest height of the level foot beside each point of an edge; cached.

    Returns
    -------
    (n,) float64, mm
        Over the foot's ground, at most 45; 0 where no part of the foot is within 7 mm.
    """
    make = lambda: _measured(foot, insole_edge(foot, outline))  # noqa: E731
    return foot.derived.get("flank heights", outline, make)


def _measured(foot: Foot, edge: Edge) -> FloatArray:
    points = foot.even.points
    low = points[points[:, 2] <= _HIGHEST_MM]
    beside = scipy.spatial.KDTree(low[:, :2]).query_ball_point(edge.points_mm, _BESIDE_MM)
    highest = np.array([low[near, 2].max(initial=0.0) for near in beside])
    return np.asarray(
        scipy.ndimage.gaussian_filter1d(highest, _SIGMA_MM / edge.step_mm, mode="wrap")
    )
