"""Separate the toes by their pulps, each of which stands out from below.

The tips themselves are often hidden from sensors below the foot, and the gaps between them are
bridged; the pulps stand out nevertheless, and a tip lies ahead of its pulp.
"""

from __future__ import annotations

import numpy as np

from insole_core.foot.outermost import reach
from insole_core.geometry.arrays import FloatArray

_STRIP_MM = 1.5
_BAND = (0.13, 0.015)  # shares of the length behind the tip, between which a pulp lies
_PROMINENCE_MM = 1.0
_SUMMIT_MM = 2.0
_ROUNDS, _AT_REST_MM = 30, 1e-5


def pulp_line(
    sole: FloatArray, area_mm2: FloatArray, length_mm: float, tip: FloatArray, search_mm: float
) -> float | None:
    """Find x of the lowest line of one toe.

    Parameters
    ----------
    sole : (n, 3) float64, mm
        Points that face the ground; toes towards +y.
    area_mm2 : (n,) float64
    length_mm
        Of the foot.
    tip : (2,) float64, mm
        Usual position of the tip.
    search_mm
        How far to either side of it the toe may lie.

    Returns
    -------
    float or None
        None when no toe stands out there.
    """
    behind = (tip[1] - sole[:, 1]) / length_mm
    near = (behind < _BAND[0]) & (behind > _BAND[1]) & (np.abs(sole[:, 0] - tip[0]) < 3 * search_mm)
    if not near.any():
        return None
    x, z = _lower_envelope(sole[near])
    found = prominences(-z)
    summits = np.array([at for at in found if found[at] >= _PROMINENCE_MM], dtype=np.int64)
    summits = summits[np.abs(x[summits] - tip[0]) < search_mm]
    if len(summits) == 0:
        return None
    best = summits[np.abs(x[summits] - tip[0]).argmin()]
    return _summit(sole[near], area_mm2[near], float(x[best]), search_mm / 2)


def prominences(heights: FloatArray) -> dict[int, float]:
    """Return the prominence of each peak of a profile (n,), by its place.

    Like SciPy's `find_peaks`, whose import alone takes longer than a reconstruction.
    """
    inner = heights[1:-1]
    rising = np.flatnonzero((inner > heights[:-2]) & (inner >= heights[2:])) + 1
    return {int(at): _prominence(heights, int(at)) for at in rising}


def _prominence(heights: FloatArray, at: int) -> float:
    higher = np.flatnonzero(heights > heights[at])
    low = higher[higher < at].max(initial=-1) + 1
    high = higher[higher > at].min(initial=len(heights))
    return float(heights[at] - max(heights[low : at + 1].min(), heights[at:high].min()))


def _summit(points: FloatArray, area_mm2: FloatArray, x: float, reach_mm: float) -> float:
    """Return the mean x of the lowest part about x; with strips alone it would jump."""
    across, lift = np.ascontiguousarray(points[:, 0]), -points[:, 2]
    for _ in range(_ROUNDS):
        away = np.abs(across - x) / reach_mm
        near = np.flatnonzero(away < 1)
        lifts, areas = lift[near], area_mm2[near]
        low = np.maximum(lifts - reach(lifts, areas) + _SUMMIT_MM, 0.0)
        weights = areas * low * (1 - away[near] ** 2) ** 2
        before, x = x, float(weights @ across[near] / weights.sum())
        if abs(x - before) < _AT_REST_MM:
            break
    return x


def _lower_envelope(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return middle and least height of each strip along the foot, slightly smoothed."""
    strip = np.floor(points[:, 0] / _STRIP_MM).astype(int)
    first = strip.min()
    lowest = np.full(strip.max() - first + 1, np.inf)
    np.minimum.at(lowest, strip - first, points[:, 2])
    x = (np.arange(len(lowest)) + first + 0.5) * _STRIP_MM
    seen = np.isfinite(lowest)
    ring = np.pad(lowest[seen], 1, mode="edge")
    return x[seen], (ring[:-2] + 2 * ring[1:-1] + ring[2:]) / 4
