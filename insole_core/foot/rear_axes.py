"""The two lines seen from behind: along the Achilles tendon, and through the calcaneus.

Both run through the rearmost places of horizontal sections. The back of a section is nearly round:
the way across it grows linearly with the sideways part of its normal, and the rearmost place is
where that part is 0. So the whole back of the section tells where it lies, and not a single point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray

_LEG_MM, _LEG_TURN = (60.0, 140.0), 0.45
_HEEL_MM, _HEEL_TURN = (24.0, 60.0), 0.8
"""Heights of the sections, and the sideways part of a normal up to which a place counts as back."""
_SLICE_MM = 4.0
_REACH_MM = 25.0  # how far before the rearmost place the back of a section reaches
_LEAST_SLICES, _LEAST_POINTS = 5, 6
_SPREAD_MM = 3.0


@dataclass(frozen=True, eq=False)
class Axis:
    """A line from its lower to its upper end.

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
        """Angle against `up` seen along `ahead`; > 0 with the upper end medial."""
        way = self.upper - self.lower
        way = way - (way @ ahead) * ahead
        return float(np.degrees(np.arctan2(way @ medial, way @ up)))


def achilles_axis(foot: Foot) -> Axis | None:
    """Lay the line along the tendon, at 60 to 140 mm; None where there is no leg."""
    return _axis(foot, _LEG_MM, _LEG_TURN)


def calcaneus_axis(foot: Foot) -> Axis | None:
    """Lay the line through the heel's back, at 24 to 60 mm; None where it was not measured."""
    return _axis(foot, _HEEL_MM, _HEEL_TURN)


def _axis(foot: Foot, heights_mm: tuple[float, float], turned: float) -> Axis | None:
    places = _rear_places(foot, heights_mm, turned)
    if len(places) < _LEAST_SLICES or np.ptp(places[:, 2]) < 0.6 * np.diff(heights_mm)[0]:
        return None
    x, y, z = places.T
    across = np.polyfit(z, x, 1)
    off = np.abs(x - np.polyval(across, z))
    keep = off <= max(3 * float(np.median(off)), 0.5)
    across, along = np.polyfit(z[keep], x[keep], 1), np.polyfit(z[keep], y[keep], 1)
    lower, upper = (
        np.array([np.polyval(across, height), np.polyval(along, height), height])
        for height in heights_mm
    )
    spread = float(np.sqrt(np.mean((x[keep] - np.polyval(across, z[keep])) ** 2)))
    return Axis(lower, upper, float(np.clip(1 - spread / _SPREAD_MM, 0.1, 0.95)))


def _rear_places(foot: Foot, heights_mm: tuple[float, float], turned: float) -> FloatArray:
    """(n, 3) rearmost place of each section, from below."""
    points, normals = foot.mesh.vertices, foot.mesh.vertex_normals
    level = np.hypot(normals[:, 0], normals[:, 1])
    sideways = np.divide(normals[:, 0], level, out=np.ones_like(level), where=level > 0.3)
    back = (normals[:, 1] < 0) & (np.abs(sideways) < turned)
    places = []
    for low in np.arange(*heights_mm, _SLICE_MM):
        here = np.flatnonzero(back & (points[:, 2] >= low) & (points[:, 2] < low + _SLICE_MM))
        if len(here):
            here = here[points[here, 1] < points[here, 1].min() + _REACH_MM]
        if len(here) >= _LEAST_POINTS and np.ptp(sideways[here]) > turned:
            x = np.polyval(np.polyfit(sideways[here], points[here, 0], 1), 0.0)
            places.append([x, points[here, 1].min(), low + _SLICE_MM / 2])
    return np.array(places).reshape(-1, 3)
