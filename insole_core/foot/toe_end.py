"""Find the end of a toe whose tip was measured with a frayed border or in part.

The foremost vertex is the noisiest one, so the surface about it is used: its outline, smoothed
across the toe, and a circle fitted to its cross-section, of a radius that is nearly known. Where
the surface was measured up to its end, the outline counts; where it stops short, the circle
continues it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.outermost import Border, cap, ramp, reach
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.weighted import weighted_quantile

SURE, GUESS = 0.95, 0.3
_LEAST = 0.05
_RADIUS_MM, _RADIUS_SPREAD_MM = 10.0, 2.5  # of the cross-section, and its standard deviation
_BEND_MM, _HALF_MM = 9.0, 5.0  # radius of the outline from above, and half of the width used
_SLOPE = 0.3  # standard deviation of the outline's slant
_SUMMIT_MM = 1.0  # depth of the part about whose middle the tip is fitted
_DEPTH_MM, _END_DEPTH_MM = 6.0, 3.0  # depth behind the outline of the tip, and of the end
_FACING, _WHOLE = 0.15, (0.9, 0.97)  # cosine against straight ahead: of a tip, of a whole end
_BEYOND_MM = (0.0, 2.0)  # height above the end up to which a whole tip was measured
_LESS_MM, _MOST_MM = 1.0, 6.0  # how far the circle may end before and beyond the outline
_NOISE_MM, _PATCH_MM2 = 0.5, 25.0  # noise of a point, and the area over which it is the same
_ROUNDS, _FIRST_ROUNDS, _STEP_MM, _ROBUST = 12, 3, 3.0, 2.5
_CERTAIN_MM, _DOUBT = 0.5, 0.25  # negligible standard deviation, and loss of confidence per mm
_LEAST_POINTS = 8


@dataclass(frozen=True, eq=False)
class End:
    """The outermost point in a direction.

    Parameters
    ----------
    point : (3,) float64, mm
        Medial = +x.
    confidence
        0 to 1.
    deviation_mm
        Standard deviation along the direction, where contours give it.
    """

    point: FloatArray
    confidence: float
    deviation_mm: float | None = None


def find_toe_end(toe: Border) -> End:
    """Find the tip of one toe.

    Parameters
    ----------
    toe
        Its surface; ahead = +y.

    Returns
    -------
    End
        A guess at the summit when there are too few points.
    """
    aside = toe.points[:, 0] - _middle(toe, _SUMMIT_MM)[0]
    near = np.abs(aside) < _HALF_MM
    shell, aside = toe.part(near), aside[near]
    top = reach(shell.points[:, 1], shell.area_mm2)
    depth = top - _slope(aside) - shell.points[:, 1]
    kept = (depth < _DEPTH_MM) & (shell.normals[:, 1] > _FACING)
    place = _middle(toe, _END_DEPTH_MM)
    if kept.sum() < _LEAST_POINTS:
        return End(place, GUESS)
    shell = shell.part(kept)
    fitted = _fit(shell, aside[kept], top)
    short = 1 - _wholeness(shell, fitted.height_mm, top)
    z = shell.points[:, 2]
    height = float(np.clip(fitted.height_mm, z.min(), z.max() + _MOST_MM))
    ahead = float(np.clip(fitted.reach_mm - top, -_LESS_MM, _MOST_MM))
    place[1:] = top + short * ahead, place[2] + short * (height - place[2])
    doubt = short * _DOUBT * max(fitted.deviation_mm - _CERTAIN_MM, 0.0)
    return End(place, float(np.clip(SURE - doubt, _LEAST, SURE)))


def _middle(toe: Border, depth_mm: float) -> FloatArray:
    return cap(toe.points, toe.points[:, 1], toe.area_mm2, depth_mm)


def _slope(aside: FloatArray) -> FloatArray:
    """Return how far the usual outline falls behind its tip."""
    return np.asarray(aside**2 / (2 * _BEND_MM))


def _wholeness(shell: Border, height_mm: float, top: float) -> float:
    """Return to what degree a tip faces ahead and was measured past the height of its end."""
    end = shell.part(shell.points[:, 1] > top - _END_DEPTH_MM)
    if len(end.points) == 0:  # of a child's toe nothing there may face ahead
        return 0.0
    turned = weighted_quantile(end.normals[:, 1], end.area_mm2, 0.9)
    above = weighted_quantile(shell.points[:, 2], shell.area_mm2, 0.97) - height_mm
    return float(ramp(turned, _WHOLE) * ramp(above, _BEYOND_MM))


@dataclass(frozen=True)
class _RoundEnd:
    """The end of a round tip: position along y, height, and standard deviation."""

    reach_mm: float
    height_mm: float
    deviation_mm: float


def _fit(shell: Border, aside: FloatArray, top: float) -> _RoundEnd:
    """Fit a circle to the cross-section of a tip whose outline is bent and slanted.

    Robust least squares (Geman & McClure) with a prior on the radius, the slant and the bend; the
    unknowns are centre (along, z), radius, slant and bend.
    """
    _, along, z = shell.points.T
    radius, bend = _RADIUS_MM, 1 / _BEND_MM
    usual = np.array([0.0, 0.0, radius, 0.0, bend])
    information = np.array([1e3, 1e3, _RADIUS_SPREAD_MM, _SLOPE, bend / 2]) ** -2.0
    known = np.array([top - radius, np.median(z) + radius / 2, radius, 0.0, bend])
    patches = max(4.0, 2 * _HALF_MM * max(float(np.ptp(z)), 3.0) / _PATCH_MM2)
    shares = patches * shell.area_mm2 / shell.area_mm2.sum() / _NOISE_MM**2
    for number in range(_ROUNDS):
        ahead = along - known[3] * aside + known[4] * aside**2 / 2 - known[0]
        above = z - known[1]
        distance = np.maximum(np.hypot(ahead, above), 1e-6)
        off = distance - known[2]
        out, up = ahead / distance, above / distance
        rows = np.column_stack([-out, -up, -np.ones_like(off), -out * aside, out * aside**2 / 2])
        weights = shares
        if number >= _FIRST_ROUNDS:
            spread = max(1.48 * float(np.median(np.abs(off))), 0.2)
            weights = shares / (1 + (off / spread / _ROBUST) ** 2) ** 2
        normal = rows.T @ (rows * weights[:, None]) + np.diag(information)
        change = np.linalg.solve(normal, information * (usual - known) - rows.T @ (weights * off))
        known = known + np.clip(change, -_STEP_MM, _STEP_MM)
    end = np.array([1.0, 0.0, 1.0, 0.0, 0.0])
    deviation_mm = float(np.sqrt(end @ np.linalg.solve(normal, end)))
    return _RoundEnd(float(known[0] + known[2]), float(known[1]), deviation_mm)
