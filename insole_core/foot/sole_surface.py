"""The lower part of a foot and its outermost points; medial is +x for either side."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from insole_core.foot.border_fit import (
    BorderFit,
    Extremum,
    UsualBorder,
    fit_border,
    measured_border,
)
from insole_core.foot.foot import Foot
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.outermost import Border, cap, ramp, reach
from insole_core.foot.round_end import Evidence, UsualEnd, fit_round_end
from insole_core.foot.toe_end import (
    CERTAIN_MM,
    GUESS,
    LEAST_TOUCHED,
    SURE,
    TRUSTED_MM,
    End,
    find_merged_end,
    find_toe_end,
    is_outlined,
)
from insole_core.foot.toes import pulp_line
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import ContourConstraints
from insole_core.geometry.transforms import rotation_about
from insole_core.geometry.weighted import weighted_quantile
from insole_core.imprints.form import Form

_END_DEPTH_MM = 3.0  # points this near to the outermost one belong to the end
_CAP_MM = 1.5  # depth of the cap whose middle is the place of the outermost point
_TURNING = (0.05, 0.15)  # cosine from which on the border turns towards its end
_WHOLE = (0.87, 0.97)  # cosine against the direction from which on the end itself was measured
_TURN = 0.4  # before the last measured cosine, over which the border is continued
_MOST_MM, _CONTINUED = 6.0, 0.35  # how far an end is continued at most, and its confidence then
_BORDER_RADIUS_MM = 16.0
_RADIUS_SPREAD_MM, _ROUGHNESS_MM = 4.0, 1.0
_PULL_MM = 12.0
"""Distance from its usual position at which a frayed end must lie one millimetre farther out."""
_LEAST_POINTS = 6
_FRAYED_MM = (1.5, 3.0)  # from the boundary of an open surface, where it counts in part
_RIM_MM, _CUT_SHARE, _UPRIGHT = 4.0, 0.3, 0.985
"""Of a scan that is cut off at an end: how near to its border the end is, on which share of it, and
the horizontal part of a normal below which the surface there is not upright yet."""
_UPRIGHT_IN_FOAM = 0.95
"""All walls of an imprint end where the foam does, and lean there before its edge curls over."""
_FRONT_MM = 6.0  # least way from the side of a foot to the end of the scan
_EDGE_MM = (-1.0, 1.0)  # beside the edge of a region, where the surface counts in part
_PATCH_MM = 4.0
_FACING = -0.5
_TOE_ACROSS = (0.23, 0.44, 0.165, 0.145, 0.145)
"""In ball widths: of the 1st and 2nd toe from the medial border, of the others from the last."""
_TOE_REACH = (1.0, 0.99, 0.955, 0.905, 0.85)  # of the length
_TOE_SEARCH = (0.12, 0.12, 0.075, 0.075, 0.075)
_AHEAD = np.array([0.0, 1.0, 0.0])
_PULP = 0.05  # share of a toe that lies lower than its pulp
_TOE_HALF_MM, _TIP_HEIGHT_MM = 4.0, 12.0
_BAND = 0.1
_TO_TOES = 0.95  # share of the length that a scan with toes covers

_USUAL_LENGTH_MM = 240.0
_REAR_MM = 14.0
_DOUBT = 0.4  # loss of confidence per mm of standard deviation
_UNSEEN, _UNSEEN_MM = 0.45, 2.0
"""Confidence and standard deviation of an end without a contour, on a foot that has contours: its
measured surface may lie that far outside of the foot."""
_CUT_OFF = 0.65
"""Confidence in the surface alone, below which its end was continued by 3 mm and more: a side of
the foot may be missing, and nothing tells how much of it."""


@dataclass(frozen=True, eq=False)
class LowFoot:
    """The part of a foot below `OUTLINE_HEIGHT_MM`, mm, insole frame.

    Parameters
    ----------
    foot
    whole
        Evenly spread, with the frayed borders of an open surface. Beside the foot a border lies a
        millimetre or two off; before the toes it is all that was measured of their tips.
    inner
        Without these borders.
    rim
        What lies beside them.
    touches
        Contour constraints, if there are any.
    """

    foot: Foot
    whole: Border
    inner: Border
    rim: Border
    touches: ContourConstraints | None

    @staticmethod
    def of(foot: Foot) -> LowFoot:
        """Cut the lower part out of a foot."""
        even = foot.even
        low = even.points[:, 2] < OUTLINE_HEIGHT_MM
        whole = Border(even.points, even.normals, even.area_mm2).part(low)
        inner = whole.weighted(ramp(even.rim_mm[low], _FRAYED_MM))
        if len(inner.points) < len(whole.points) / 2:
            inner = whole
        rim = whole.part(even.rim_mm[low] < _RIM_MM)
        touches = foot.mesh.touches
        return LowFoot(foot, whole, inner, rim, None if touches is None else _low_touches(touches))


class SoleSurface:
    """The lower part of a foot in a sole frame: medial +x, and +y in a chosen direction.

    Parameters
    ----------
    low
    yaw_deg
        Direction of +y, from the insole frame's +y towards medial.
    """

    def __init__(self, low: LowFoot, yaw_deg: float = 0.0) -> None:
        mirror = np.diag([low.foot.side.medial_sign, 1.0, 1.0])
        self._low, self._yaw_deg = low, yaw_deg
        self._insole2sole = rotation_about(np.array([0.0, 0.0, 1.0]), yaw_deg) @ mirror
        self._inner = low.inner.turned(self._insole2sole)
        self._whole = low.whole.turned(self._insole2sole)
        self._rim = low.rim.turned(self._insole2sole)
        self.back_mm = -reach(-self._inner.points[:, 1], self._inner.area_mm2)
        self.length_mm = low.foot.length_mm
        self._touches = None if low.touches is None else self._turned(low.touches)
        facing = self._inner.normals[:, 2] < _FACING
        facing = facing if facing.any() else np.ones(len(facing), dtype=bool)
        self._sole = self._inner.part(facing)

    @cached_property
    def _tree(self) -> scipy.spatial.cKDTree:
        return scipy.spatial.cKDTree(self._sole.points[:, :2])

    def along(self, way: FloatArray) -> SoleSurface:
        """Return the same part with +y in another direction (3,), given in this sole frame."""
        return SoleSurface(self._low, self._yaw_deg + float(np.degrees(np.arctan2(way[0], way[1]))))

    def from_insole(self, point: FloatArray) -> FloatArray:
        """Transform a point (3,) from the insole frame to the sole frame."""
        return np.asarray(self._insole2sole @ point)

    def to_insole(self, point: FloatArray) -> FloatArray:
        """Transform a point (3,) from the sole frame to the insole frame."""
        return np.asarray(point @ self._insole2sole)

    def on_sole(self, xy: FloatArray) -> FloatArray:
        """Return the point (3,) of the sole above (x, y): on the plane fitted to it, or nearest."""
        near = self._tree.query_ball_point(xy, _PATCH_MM)
        if len(near) < _LEAST_POINTS:
            return np.array([*xy, self._sole.points[self._tree.query(xy)[1]][2]])
        away = self._sole.points[near] - [*xy, 0.0]
        weights = self._sole.area_mm2[near] * (1 - (away[:, :2] ** 2).sum(axis=1) / _PATCH_MM**2)
        rows = np.column_stack([np.ones(len(away)), away[:, :2]])
        normal = rows.T @ (weights[:, None] * rows) + weights.sum() * np.diag([0.0, 0.1, 0.1])
        height = np.linalg.solve(normal, rows.T @ (weights * away[:, 2]))[0]
        return np.array([*xy, height])

    def support(
        self,
        direction: FloatArray,
        shares: tuple[float, float],
        usual_share: float | None = None,
        border: UsualBorder | None = None,
    ) -> End:
        """Find the outermost point in a horizontal direction, between shares of the length.

        Where the surface stops short of its end, it is continued as a round border; where it is
        nearly straight, the end lies towards the usual share of the length.

        Parameters
        ----------
        direction : (2,) float64
            Along an axis of the sole frame.
        shares
            Range of y in shares of the length, from the heel.
        usual_share
            Usual position of the end; None when there is none.
        border
            Usual shape of the border, for a foot of 240 mm; with it the contours are used.

        Returns
        -------
        End
            mm, sole frame.
        """
        region = self._between(self._inner, shares)
        region = region if len(region.points) else self._inner
        usual = None
        if usual_share is not None:
            usual = float(direction[0]) * (self.back_mm + usual_share * self.length_mm)
        towards = np.array([*direction, 0.0])
        end, whole = _end(region, towards, _BORDER_RADIUS_MM, usual)
        if self._touches is None and self._is_cut(towards, shares):
            end = replace(end, confidence=min(end.confidence, _CONTINUED))
        if usual_share is None or border is None:
            return end
        if self._front_mm - end.point[1] < _FRONT_MM:
            return replace(end, confidence=GUESS)  # the scan ends before the border turns back
        low, high, middle = (self.back_mm + s * self.length_mm for s in (*shares, usual_share))
        scaled = border.scaled(self._scale)
        if self._touches is not None:
            return self._touched(end, towards, (low, high), scaled, middle)
        if whole == 0:
            return end
        points, area_mm2 = region.points, region.area_mm2
        strips = measured_border(points, area_mm2, towards, (low, high))
        summit = strips.summit(strips.touched > 0, scaled.bend_mm)
        found = _point(summit, strips, towards)
        return replace(end, point=whole * found + (1 - whole) * end.point)

    @cached_property
    def _front_mm(self) -> float:
        return reach(self._inner.points[:, 1], self._inner.area_mm2)

    def _is_cut(self, direction: FloatArray, shares: tuple[float, float]) -> bool:
        """Return whether the scan ends at an end before its border turns back.

        Another scanner's file may be cropped there; how much of the foot is missing, nothing tells.
        """
        whole, rim = (self._between(part, shares) for part in (self._whole, self._rim))
        if not len(rim.points):
            return False
        top_mm = reach(whole.points @ direction, whole.area_mm2) - _END_DEPTH_MM
        near, beside = whole.points @ direction > top_mm, rim.points @ direction > top_mm
        if rim.area_mm2[beside].sum() < _CUT_SHARE * whole.area_mm2[near].sum():
            return False
        # Upright is enough: in plan, a border may run on beyond the shares of the length.
        upright = np.linalg.norm(rim.normals[beside][:, :2], axis=1)
        least = _UPRIGHT_IN_FOAM if self._low.foot.form is Form.IMPRINT else _UPRIGHT
        return weighted_quantile(upright, rim.area_mm2[beside], 0.5) < least

    def _between(self, part: Border, shares: tuple[float, float]) -> Border:
        """Return what lies between shares of the length, at their edges in part."""
        own = self._shares_of(part)
        inside_mm = (own - shares[0]).clip(max=shares[1] - own) * self.length_mm
        return part.weighted(ramp(inside_mm, _EDGE_MM))

    @property
    def _shares(self) -> FloatArray:
        """(n,) y of the inner points in shares of the length, from the heel."""
        return self._shares_of(self._inner)

    def _shares_of(self, part: Border) -> FloatArray:
        return np.asarray((part.points[:, 1] - self.back_mm) / self.length_mm)

    def _turned(self, touches: ContourConstraints) -> ContourConstraints:
        turn = self._insole2sole.T
        return ContourConstraints(touches.points @ turn, touches.normals @ turn)

    def rear(self, shares: tuple[float, float], usual: UsualEnd) -> End:
        """Find the rearmost point, between shares of the length; mm, sole frame."""
        end = self.support(-_AHEAD[:2], shares)
        scaled = usual.scaled(self._scale)
        fit = fit_round_end(
            Evidence(self._whole, self._touches), -_AHEAD, end.point, _REAR_MM, scaled
        )
        across = float(np.clip(fit.across_mm, end.point[0] - _REAR_MM, end.point[0] + _REAR_MM))
        if not is_outlined(fit):
            confidence = end.confidence
            deviation_mm = None
            if self._touches is not None:
                confidence, deviation_mm = min(confidence, _UNSEEN), _UNSEEN_MM
            return End(np.array([across, *end.point[1:]]), confidence, deviation_mm)
        deviation_mm = float(fit.deviations_mm[0])
        confidence = SURE - _DOUBT * max(deviation_mm - CERTAIN_MM, 0.0)
        return End(np.array([across, -fit.reach_mm, fit.height_mm]), confidence, deviation_mm)

    @property
    def _scale(self) -> float:
        return self.length_mm / _USUAL_LENGTH_MM

    def _touched(
        self,
        end: End,
        direction: FloatArray,
        between_mm: tuple[float, float],
        usual: UsualBorder,
        usual_mm: float,
    ) -> End:
        """Refine an end by the contours; unchanged in position where they do not determine it."""
        assert self._touches is not None
        surface = ContourConstraints(self._whole.points, self._whole.normals)
        fit = fit_border(surface, self._touches, direction, between_mm, usual)
        trusted = (fit.touched > LEAST_TOUCHED) & (fit.deviation_mm < TRUSTED_MM)
        if not trusted.any():
            unseen_mm = None if end.confidence < _CUT_OFF else _UNSEEN_MM
            return replace(end, confidence=min(end.confidence, _UNSEEN), deviation_mm=unseen_mm)
        summit = fit.summit(trusted, usual.bend_mm, usual_mm, usual.pull_mm)
        deviation_mm = float(fit.deviation_mm[summit.strip])
        confidence = SURE - _DOUBT * max(deviation_mm - CERTAIN_MM, 0.0)
        return End(_point(summit, fit, direction), float(confidence), deviation_mm)

    def toe_tips(self) -> list[End]:
        """Find the five tips, medial to lateral, mm, sole frame; a guess where no toe was found."""
        tips: list[End] = []
        for toe in range(len(_TOE_ACROSS)):
            # Beyond the 2nd, a toe lies about one toe's width beside the previous one.
            tips.append(self._tip(toe, float(tips[-1].point[0]) if toe > 1 else None))
        return tips

    def second_toe_tip(self) -> End:
        """Find the tip of the 2nd toe alone, as `toe_tips` does."""
        return self._tip(1)

    def _tip(self, toe: int, beside_mm: float | None = None) -> End:
        """Find the tip of a toe, counted from 0, across from the medial border or a given x."""
        lateral, medial = self._ball
        width = medial - lateral
        from_x = medial if beside_mm is None else beside_mm
        usual = np.array(
            [
                from_x - _TOE_ACROSS[toe] * width,
                self.back_mm + _TOE_REACH[toe] * self.length_mm,
            ]
        )
        return self._toe_tip(usual, _TOE_SEARCH[toe] * width)

    @cached_property
    def _ball(self) -> tuple[float, float]:
        """Lateral and medial x of the ball."""
        ball = self._inner.points[np.abs(self._shares - 0.68) < 0.03]
        ball = ball if len(ball) else self._inner.points
        return float(ball[:, 0].min()), float(ball[:, 0].max())

    def _toe_tip(self, usual: FloatArray, search_mm: float) -> End:
        x = pulp_line(self._sole.points, self._sole.area_mm2, self.length_mm, usual, search_mm)
        middle, half_mm = (usual[0], search_mm / 2) if x is None else (x, _TOE_HALF_MM)
        across, along, _ = self._whole.points.T
        toe = (np.abs(across - middle) < half_mm) & (along > usual[1] - _BAND * self.length_mm)
        is_cut = self._front_mm < self.back_mm + _TO_TOES * self.length_mm
        if not toe.any() or (x is None and is_cut):
            return End(np.array([*usual, _TIP_HEIGHT_MM]), GUESS)
        strip = self._whole.part(toe)
        start = np.array([middle, reach(strip.points[:, 1], strip.area_mm2), _TIP_HEIGHT_MM])
        pulp_mm = weighted_quantile(strip.points[:, 2], strip.area_mm2, _PULP)
        seen = Evidence(self._whole, self._touches)
        if x is None:
            return find_merged_end(seen, start, half_mm, pulp_mm, self._scale)
        return find_toe_end(seen, start, pulp_mm, self._scale)


def _point(summit: Extremum, border: BorderFit, direction: FloatArray) -> FloatArray:
    point = summit.reach_mm * direction + summit.across_mm * np.abs(direction[[1, 0, 2]])
    point[2] = border.height_mm[summit.strip]
    return point


def _end(
    border: Border, direction: FloatArray, radius_mm: float, usual_mm: float | None = None
) -> tuple[End, float]:
    """Find the outermost point of a part of the surface, continued where its normals fall short.

    Returned with the degree to which the surface was measured up to it.
    `radius_mm` is that of the usual border; `usual_mm` is the usual position of the end across the
    direction, which decides where a border is nearly straight and frayed.
    """
    points, area_mm2 = border.points, border.area_mm2
    along, facing = points @ direction, border.normals @ direction
    top = reach(along, area_mm2)
    near = along > top - _END_DEPTH_MM
    faced = weighted_quantile(facing[near], area_mm2[near], 0.9)
    whole = float(ramp(faced, _WHOLE))
    short = 1 - whole
    rated = along
    if usual_mm is not None:  # the border itself, where it was measured, is the best evidence
        across = points @ np.array([-direction[1], direction[0], 0.0])
        rated = along - short * ((across - usual_mm) / _PULL_MM) ** 2
    place = cap(points, rated, area_mm2, _CAP_MM)
    turning = float(ramp(faced, _TURNING)) if near.sum() >= _LEAST_POINTS else 0.0
    end_mm, confidence = top, GUESS + (SURE - GUESS) * turning
    short *= turning
    if short > 0:
        last = (along > top - 2 * _END_DEPTH_MM) & (facing > max(faced - _TURN, 0.1))
        round_mm, height = _round_end(points[last], border.normals[last], direction, radius_mm)
        end_mm += short * float(np.clip(round_mm - top, 0.0, _MOST_MM))
        place[2] += short * (height - place[2])
        confidence = min(confidence, SURE - (SURE - _CONTINUED) * (end_mm - top) / _MOST_MM)
    return End(place + (end_mm - place @ direction) * direction, confidence), whole


def _round_end(
    points: FloatArray, normals: FloatArray, direction: FloatArray, radius_mm: float
) -> tuple[float, float]:
    """Fit a circle to a border that was measured in part; return its end and the height there.

    On a circle the position along the direction grows with the normal's component in it, and the
    height with its upward component, both by the radius; the usual radius is the prior.
    """
    outward, upward = normals @ direction, normals[:, 2]
    level = np.maximum(np.hypot(outward, upward), 1e-9)
    one, none = np.ones(len(points)), np.zeros(len(points))
    rows = np.concatenate(
        [
            np.column_stack([one, none, outward / level - 1]),
            np.column_stack([none, one, upward / level]),
            [[0.0, 0.0, np.sqrt(len(points)) * _ROUGHNESS_MM / _RADIUS_SPREAD_MM]],
        ]
    )
    values = np.concatenate([points @ direction, points[:, 2], [rows[-1, 2] * radius_mm]])
    reach, height, _ = np.linalg.lstsq(rows, values)[0]
    return float(reach), float(height)


def _low_touches(touches: ContourConstraints) -> ContourConstraints:
    low = touches.points[:, 2] < OUTLINE_HEIGHT_MM
    return ContourConstraints(touches.points[low], touches.normals[low])
