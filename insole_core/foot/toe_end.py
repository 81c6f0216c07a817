"""Find the end of a toe: its tip may be seen as an outline, have a frayed border, or be cut off.

The foremost vertex is the noisiest one, so the whole end is fitted as a round one (`round_end`).
Where the surface was measured up to its end, how far it reaches there counts; where it stops short,
and no outline shows the end, the fit continues it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.outermost import Border, ramp, reach
from insole_core.foot.round_end import Evidence, RoundEnd, UsualEnd, fit_round_end
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.weighted import weighted_quantile

SURE, GUESS = 0.95, 0.3
_LEAST = 0.05
MERGED = 0.45
"""Greatest confidence of a toe that does not stand out from the others."""
_MERGED_TOES = UsualEnd((12.0, 4.0), (30.0, 15.0), (9.0, 3.0), (15.0, 6.0))
_MERGED_HALF_MM = 12.0
_AHEAD = np.array([0.0, 1.0, 0.0])
_HALF_MM = 8.0  # to either side, where a toe of a foot of 240 mm is round
_TIP_MM = 5.0  # to either side, where its outermost part lies
_END_DEPTH_MM = 3.0
_WHOLE = (0.9, 0.97)  # cosine against straight ahead, of a whole end
_BEYOND_MM = (0.0, 2.0)  # height above the end up to which a whole tip was measured
_LESS_MM, _MOST_MM = 1.0, 6.0  # how far the fit may end before and beyond the surface
CERTAIN_MM, DOUBT = 0.5, 0.25
"""Negligible standard deviation, and loss of confidence per mm beyond it."""
TRUSTED_MM, LEAST_TOUCHED = 1.2, 0.5
"""Standard deviation up to which outlines determine an end, and their least weight."""
_MERGED_TRUSTED_MM = 2.0
"""The same where toes melt together, of whose blunt front the surface shows 2 to 4 mm less."""
TOE = UsualEnd((11.0, 5.0), (9.0, 2.0), (9.0, 2.0), (9.0, 2.0))
"""Its height over the pulp: a toe may be raised."""


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


def find_toe_end(front: Evidence, start: FloatArray, pulp_mm: float, scale: float) -> End:
    """Find the tip of one toe.

    Parameters
    ----------
    front
        What was seen of the toes; ahead = +y.
    start : (3,) float64, mm
        About where the tip lies.
    pulp_mm
        Height of the lowest part of the toe.
    scale
        Of the foot, against one of 240 mm.

    Returns
    -------
    End
    """
    usual = TOE.scaled(scale).raised(pulp_mm)
    fit = fit_round_end(front, _AHEAD, start, scale * _HALF_MM, usual)
    across = float(np.clip(fit.across_mm, start[0] - _TIP_MM, start[0] + _TIP_MM))
    if is_outlined(fit):
        doubt = DOUBT * max(float(fit.deviations_mm[0]) - CERTAIN_MM, 0.0)
        point = np.array([across, start[1] + _ahead(fit.reach_mm - start[1]), fit.height_mm])
        return End(point, SURE - doubt, float(fit.deviations_mm[0]))
    away = np.abs(front.surface.points[:, 0] - across)
    tip = front.surface.part(away < scale * _TIP_MM)
    if len(tip.points) == 0:
        return End(start, GUESS)
    top = reach(tip.points[:, 1], tip.area_mm2)
    short = 1 - _wholeness(tip, fit.height_mm, top)
    z = tip.points[:, 2]
    height = float(np.clip(fit.height_mm, z.min(), z.max() + _MOST_MM))
    doubt = short * DOUBT * max(float(fit.deviations_mm[0]) - CERTAIN_MM, 0.0)
    confidence = float(np.clip(SURE - doubt, _LEAST, SURE))
    return End(np.array([across, top + short * _ahead(fit.reach_mm - top), height]), confidence)


def find_merged_end(
    front: Evidence, start: FloatArray, half_mm: float, pulp_mm: float, scale: float
) -> End:
    """Find how far the foot reaches about the place of a toe that does not stand out from others.

    Parameters as of `find_toe_end`; across the foot the end stays at `start`, and what reaches
    farthest up to `half_mm` beside it counts.
    """
    usual = _MERGED_TOES.scaled(scale).raised(pulp_mm)
    fit = fit_round_end(front, _AHEAD, start, scale * _MERGED_HALF_MM, usual)
    if not is_outlined(fit, _MERGED_TRUSTED_MM):
        return End(start, MERGED)
    farthest = float(np.clip(fit.across_mm, start[0] - half_mm, start[0] + half_mm))
    along = start[1] + _ahead(fit.reach_at(farthest) - start[1])
    deviation_mm = float(fit.deviations_mm[0])
    return End(np.array([start[0], along, fit.height_mm]), MERGED, deviation_mm)


def is_outlined(fit: RoundEnd, trusted_mm: float = TRUSTED_MM) -> bool:
    """Return whether outlines determine how far an end reaches, to a standard deviation."""
    return fit.touched > LEAST_TOUCHED and float(fit.deviations_mm[0]) < trusted_mm


def _ahead(way_mm: float) -> float:
    """Limit how far before or beyond the surface an end may lie."""
    return float(np.clip(way_mm, -_LESS_MM, _MOST_MM))


def _wholeness(tip: Border, height_mm: float, top: float) -> float:
    """Return to what degree a tip faces ahead and was measured past the height of its end."""
    end = tip.part(tip.points[:, 1] > top - _END_DEPTH_MM)
    turned = weighted_quantile(end.normals[:, 1], end.area_mm2, 0.9)
    above = weighted_quantile(tip.points[:, 2], tip.area_mm2, 0.97) - height_mm
    return float(ramp(turned, _WHOLE) * ramp(above, _BEYOND_MM))
