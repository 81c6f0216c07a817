"""The two axes of the rearfoot seen from behind: of the Achilles tendon and of the calcaneus.

Both run through the rearmost points of horizontal sections. The back of a section is nearly round:
the position across it grows linearly with the sideways part of its normal, and the rearmost point
is where that part is 0. So the whole back determines the line, not a single point; and all sections
determine it together, since line and roundness change linearly with the height.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.outermost import ramp
from insole_core.geometry.arrays import FloatArray, IndexArray

_LEG_MM, _LEG_TURN = (60.0, 140.0), 0.65
_HEEL_MM, _HEEL_TURN = (24.0, 60.0), 0.8
"""Heights of the sections, and largest sideways part of a normal on the back."""
_SLICE_MM = 4.0
_REACH_MM = 25.0  # how far before the rearmost point the back of a section reaches
_FADING, _LEAST_SHARE = (0.0, 0.1), 1e-3  # shares before the limits where points count less
_LEAST_SLICES, _LEAST_POINTS = 5, 6
_SPREAD_MM = 3.0
_ROUNDS, _ROBUST = 4, 2.5


@dataclass(frozen=True, eq=False)
class Axis:
    """An axis of the rearfoot, from its lower to its upper end.

    Parameters
    ----------
    lower, upper : (3,) float64, mm, insole frame
    confidence
        0 to 1.
    """

    lower: FloatArray
    upper: FloatArray
    confidence: float

    def lean_deg(self, up: FloatArray, ahead: FloatArray, medial: FloatArray) -> float:
        """Compute the lean of the axis as seen along a direction.

        Parameters
        ----------
        up, ahead, medial : (3,) float64
            Orthogonal unit vectors, insole frame.

        Returns
        -------
        float, degrees
            Angle to `up` in the plane across `ahead`; > 0 when the upper end lies medially.
        """
        way = self.upper - self.lower
        way = way - (way @ ahead) * ahead
        return float(np.degrees(np.arctan2(way @ medial, way @ up)))


def achilles_axis(foot: Foot) -> Axis | None:
    """Fit the axis of the Achilles tendon, at 60 to 140 mm; None when the leg was not measured."""
    return _axis(foot, _LEG_MM, _LEG_TURN)


def calcaneus_axis(foot: Foot) -> Axis | None:
    """Fit the axis of the heel's back, at 24 to 60 mm; None when it was not measured."""
    return _axis(foot, _HEEL_MM, _HEEL_TURN)


def _axis(foot: Foot, heights_mm: tuple[float, float], turned: float) -> Axis | None:
    back, sideways, section, rear_mm = _back(foot, heights_mm, turned)
    seen = np.flatnonzero(np.isfinite(rear_mm))
    middles = np.arange(*heights_mm, _SLICE_MM)[seen] + _SLICE_MM / 2
    if len(seen) < _LEAST_SLICES or np.ptp(middles) < 0.6 * np.diff(heights_mm)[0]:
        return None
    x, z = foot.even.points[back][:, [0, 2]].T
    rows = np.stack([np.ones_like(z), z, sideways, z * sideways], axis=1)
    # Evenly down to nothing: which points lie just within the limits changes as a scan is turned.
    beside, over = sideways / turned, (z - np.mean(heights_mm)) / (np.ptp(heights_mm) / 2)
    within = ramp(1 - np.abs(beside), _FADING) * ramp(1 - np.abs(over), _FADING) + _LEAST_SHARE
    line, off = _robust_fit(rows, x, within * foot.even.area_mm2[back])
    along = np.polyfit(middles, rear_mm[seen], 1)
    lower, upper = (
        np.array([line[0] + line[1] * height, np.polyval(along, height), height])
        for height in heights_mm
    )
    count = np.bincount(section, minlength=len(rear_mm))[seen]
    means = np.bincount(section, off, minlength=len(rear_mm))[seen] / count
    spread = float(np.sqrt(np.mean(means**2)))
    return Axis(lower, upper, float(np.clip(1 - spread / _SPREAD_MM, 0.1, 0.95)))


def _robust_fit(
    rows: FloatArray, values: FloatArray, areas: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Solve by least squares with Geman & McClure's weights; return solution and residuals."""
    weights = areas
    for _ in range(_ROUNDS):
        root = np.sqrt(weights)
        solution = np.linalg.lstsq(rows * root[:, None], values * root)[0]
        off = values - rows @ solution
        spread = max(1.48 * float(np.median(np.abs(off))), 1e-3)
        weights = areas / (1 + (off / spread / _ROBUST) ** 2) ** 2
    return np.asarray(solution), np.asarray(off)


def _back(
    foot: Foot, heights_mm: tuple[float, float], turned: float
) -> tuple[IndexArray, FloatArray, IndexArray, FloatArray]:
    """Find the points on the back of the sections.

    Returns
    -------
    back : (n,) int64
        Index of the points.
    sideways : (n,) float64
        Sideways part of their normals.
    section : (n,) int64
        Number of their section.
    rear_mm : (sections,) float64
        Rearmost y of each section, NaN where its back was not measured from side to side.
    """
    points, normals = foot.even.points, foot.even.normals
    level = np.hypot(normals[:, 0], normals[:, 1])
    sideways = np.divide(normals[:, 0], level, out=np.ones_like(level), where=level > 0.3)
    count = len(np.arange(*heights_mm, _SLICE_MM))
    number = np.floor((points[:, 2] - heights_mm[0]) / _SLICE_MM).astype(int)
    here = (normals[:, 1] < 0) & (np.abs(sideways) < turned) & (number >= 0) & (number < count)
    rear_mm = np.full(count, np.inf)
    np.minimum.at(rear_mm, number[here], points[here, 1])
    here[here] = points[here, 1] < rear_mm[number[here]] + _REACH_MM
    widest, least = np.full(count, -np.inf), np.full(count, np.inf)
    np.maximum.at(widest, number[here], sideways[here])
    np.minimum.at(least, number[here], sideways[here])
    shown = np.bincount(number[here], minlength=count) >= _LEAST_POINTS
    shown &= widest - least > turned
    back = np.flatnonzero(here)
    back = back[shown[number[back]]]
    return back, sideways[back], number[back], np.where(shown, rear_mm, np.nan)
