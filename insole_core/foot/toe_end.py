"""Find the end of a toe whose tip was measured with a frayed border or in part.

The foremost vertex is the noisiest one, so the surface about it is used: its outline, smoothed
across the toe, and a circle fitted to its cross-section, of a radius that is nearly known. Where
the surface was measured up to its end, the outline counts; where it stops short, the circle
continues it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d

from insole_core.geometry.arrays import FloatArray, IndexArray

SURE, GUESS = 0.95, 0.3
_LEAST = 0.05
_RADIUS_MM, _RADIUS_SPREAD_MM = 10.0, 2.5  # of the cross-section, and its standard deviation
_BEND_MM, _HALF_MM = 9.0, 5.0  # radius of the outline from above, and half of the width used
_SLOPE = 0.3  # standard deviation of the outline's slant
_STRIP_MM = 2.0
_DEPTH_MM, _END_DEPTH_MM = 6.0, 3.0  # depth behind the outline of the tip, and of the end
_FACING, _WHOLE = 0.15, 0.97  # cosine against straight ahead: of a tip, of a whole end
_BEYOND_MM = 1.0  # least height above the end up to which a whole tip was measured
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


def find_toe_end(points: FloatArray, normals: FloatArray, summit_mm: float) -> End:
    """Find the tip of one toe.

    Parameters
    ----------
    points, normals : (n, 3) float64, mm
        Of the toe; ahead = +y.
    summit_mm
        Position x about which the tip is fitted.

    Returns
    -------
    End
        A guess at the summit when there are too few points.
    """
    aside = points[:, 0] - summit_mm
    shell, top = _shell(aside, points[:, 1], normals[:, 1])
    place = points[points[:, 1].argmax()].copy()
    if len(shell) < _LEAST_POINTS:
        return End(place, GUESS)
    along, z = points[shell, 1], points[shell, 2]
    fitted = _fit(aside[shell], along, z, top)
    if _is_whole(normals[shell, 1][along > top - _END_DEPTH_MM], z, fitted.height_mm):
        place[1] = top
        return End(place, SURE)
    place[1] = np.clip(fitted.reach_mm, top - _LESS_MM, top + _MOST_MM)
    place[2] = np.clip(fitted.height_mm, z.min(), z.max() + _MOST_MM)
    confidence = SURE - _DOUBT * max(fitted.deviation_mm - _CERTAIN_MM, 0.0)
    return End(place, float(np.clip(confidence, _LEAST, SURE)))


def _outermost(strip: IndexArray, along: FloatArray) -> FloatArray:
    """Return the greatest value of each strip; a strip without points gets the least of them."""
    profile = np.full(strip.max() + 1, -np.inf)
    np.maximum.at(profile, strip, along)
    profile[~np.isfinite(profile)] = profile[np.isfinite(profile)].min()
    return profile


def _shell(aside: FloatArray, along: FloatArray, facing: FloatArray) -> tuple[IndexArray, float]:
    """Return the tip's points about the summit, and the smoothed outline's value there."""
    near = np.flatnonzero(np.abs(aside) < _HALF_MM)
    strip = np.floor((aside[near] + _HALF_MM) / _STRIP_MM).astype(int)
    outline = gaussian_filter1d(_outermost(strip, along[near]), 1.0, mode="nearest")
    kept = (along[near] > outline[strip] - _DEPTH_MM) & (facing[near] > _FACING)
    return near[kept], float(outline[int(_HALF_MM / _STRIP_MM)])


def _is_whole(facing: FloatArray, z: FloatArray, height_mm: float) -> bool:
    """Return whether the surface faces ahead and was measured past the height of its end."""
    turned = len(facing) > 0 and float(np.quantile(facing, 0.9)) >= _WHOLE
    return turned and height_mm < float(np.quantile(z, _WHOLE)) - _BEYOND_MM


@dataclass(frozen=True)
class _RoundEnd:
    """The end of a round tip: position along y, height, and standard deviation."""

    reach_mm: float
    height_mm: float
    deviation_mm: float


def _fit(aside: FloatArray, along: FloatArray, z: FloatArray, top: float) -> _RoundEnd:
    """Fit a circle to the cross-section of a tip whose outline is bent and slanted.

    Robust least squares (Geman & McClure) with a prior on the radius, the slant and the bend; the
    unknowns are centre (along, z), radius, slant and bend.
    """
    radius, bend = _RADIUS_MM, 1 / _BEND_MM
    usual = np.array([0.0, 0.0, radius, 0.0, bend])
    information = np.array([1e3, 1e3, _RADIUS_SPREAD_MM, _SLOPE, bend / 2]) ** -2.0
    known = np.array([top - radius, np.median(z) + radius / 2, radius, 0.0, bend])
    patches = max(4.0, 2 * _HALF_MM * max(float(np.ptp(z)), 3.0) / _PATCH_MM2)
    share = patches / len(z) / _NOISE_MM**2
    for number in range(_ROUNDS):
        ahead = along - known[3] * aside + known[4] * aside**2 / 2 - known[0]
        above = z - known[1]
        distance = np.maximum(np.hypot(ahead, above), 1e-6)
        off = distance - known[2]
        out, up = ahead / distance, above / distance
        rows = np.column_stack([-out, -up, -np.ones_like(off), -out * aside, out * aside**2 / 2])
        weights = np.full(len(off), share)
        if number >= _FIRST_ROUNDS:
            spread = max(1.48 * float(np.median(np.abs(off))), 0.2)
            weights /= (1 + (off / spread / _ROBUST) ** 2) ** 2
        normal = rows.T @ (rows * weights[:, None]) + np.diag(information)
        change = np.linalg.solve(normal, information * (usual - known) - rows.T @ (weights * off))
        known = known + np.clip(change, -_STEP_MM, _STEP_MM)
    end = np.array([1.0, 0.0, 1.0, 0.0, 0.0])
    deviation_mm = float(np.sqrt(end @ np.linalg.solve(normal, end)))
    return _RoundEnd(float(known[0] + known[2]), float(known[1]), deviation_mm)
