"""Polygons of files to triangles."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import IndexArray, IntArray
from insole_core.messages import Message

MOST_CORNERS = 1000
"""Of one polygon; a scan has triangles, seldom four corners."""


def fans(corners: IntArray, counts: IntArray) -> IntArray:
    """Split polygons into triangles around their first corners.

    Parameters
    ----------
    corners : (n,) int64
        Of all polygons, one after the other.
    counts : (m,) int64
        Corners of each; polygons with fewer than three are dropped.

    Returns
    -------
    (k, 3) int64
        Places in `corners`.

    Raises
    ------
    ValueError
        When a polygon has far more corners than a scan's.
    """
    if counts.max(initial=0) > MOST_CORNERS:
        raise ValueError(Message("a polygon has more than {most} corners", most=MOST_CORNERS))
    firsts = np.cumsum(counts) - counts
    if (counts == 3).all():
        return np.arange(len(corners)).reshape(-1, 3)
    parts = [
        firsts[counts > number + 1][:, None] + [0, number, number + 1]
        for number in range(1, int(counts.max(initial=0)) - 1)
    ]
    return np.concatenate(parts) if parts else np.empty((0, 3), dtype=np.int64)


def as_indices(corners: IntArray) -> IndexArray:
    """Return corners as int32; what no mesh has stays beyond every mesh."""
    return np.clip(corners, -1, np.iinfo(np.int32).max).astype(np.int32)
