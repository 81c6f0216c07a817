"""The length of a tape round a section of a foot."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray

_MOST_GAP_MM = 10.0  # a tape that bridges more than this is measurably shorter than the foot


def tape_length(section: FloatArray) -> float | None:
    """Measure round the convex hull of a section.

    Parameters
    ----------
    section : (k, 2, 2) float64, mm
        Segments in the plane of the section, in no particular order, each counter-clockwise round
        the foot.

    Returns
    -------
    float or None, mm
        None when the section is open by more than 10 mm along the tape.
    """
    if len(section) < 3:
        return None
    points = section.reshape(-1, 2)
    hull = scipy.spatial.ConvexHull(points)
    corners = points[hull.vertices]
    ways = np.roll(corners, -1, axis=0) - corners
    straight = np.linalg.norm(ways, axis=1) > _MOST_GAP_MM
    for corner, way in zip(corners[straight], ways[straight], strict=True):
        if _gap_mm(section - corner, way) > _MOST_GAP_MM:
            return None
    return float(hull.area)  # of a plane figure its circumference


def _gap_mm(section: FloatArray, way: FloatArray) -> float:
    """Return the longest part of a straight piece of tape without a surface under it."""
    length = float(np.linalg.norm(way))
    starts, ends = (section @ way / length).T
    under = ends > starts  # what runs the other way is the far side of the foot
    order = np.argsort(starts[under])
    reached = np.concatenate([[0.0], np.maximum.accumulate(ends[under][order]).clip(0.0, length)])
    gaps = np.concatenate([starts[under][order].clip(0.0, length), [length]]) - reached
    return float(gaps.max())
