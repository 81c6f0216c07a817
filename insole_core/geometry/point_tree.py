"""Search for the nearest of many points."""

from __future__ import annotations

import scipy

from insole_core.geometry.arrays import FloatArray


def point_tree(points: FloatArray) -> scipy.spatial.cKDTree:
    """Return a tree for the nearest neighbours among points on a surface or a line (n, d).

    Its boxes are halved in the middle and not at the median point: for evenly spread points it is
    built and searched in less time.
    """
    return scipy.spatial.cKDTree(points, balanced_tree=False)
