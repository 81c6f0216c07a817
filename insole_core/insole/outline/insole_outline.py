"""The edge of the insole seen from above: from the foot, from the shoe size, or drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, Landmarks, find_landmarks
from insole_core.foot.measures import PARIS_MM
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.geometry.side import Side
from insole_core.insole.fields import Place
from insole_core.insole.outline.foot_border import fair_curve, foot_border
from insole_core.insole.outline.shoe_fit import placed_inside, trimmed_to
from insole_core.insole.outline.trim_line import TrimLine, trim_points
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.primitives.blending import smooth_step
from insole_core.insole.primitives.outline_curve import closed_curve, evenly_spread, smoothed_along

# All as shares of the foot's length.
_HEEL_TO_BALL = (0.30, 0.55)
_TOES = (0.75, 1.0)
_WAIST_BEGIN, _WAIST_END = 0.20, (0.62, 0.46)  # medial, lateral

# Least and greatest curvature, per mm: a fair edge is convex everywhere but at the waist.
_ROUND, _HOLLOW = (1 / 700, 1 / 19), (-1 / 45, 1 / 19)

# The front edge of a short insole runs along the outer heads; its sagitta is a share of its length.
_BEHIND_HEADS_MM = 8.0
_STEEPEST, _SHORTEST = 0.5, 0.35
_BOW, _FRONT_POINTS = 0.04, 60
_ROUNDINGS, _ROUNDING_MM, _EVENING_MM, _CORNER_MM = 6, 6.0, 2.0, (25.0, 45.0)
_TRIM_CORNER_MM = (12.0, 24.0)  # smaller, so that the edge runs through the points of a trim line
_HANDLES = 36  # points of an outline that starts to be drawn


def insole_outline(foot: Foot, design: InsoleDesign, landmarks: Landmarks) -> FloatArray:
    """Compute the outline that a design specifies.

    Parameters
    ----------
    landmarks
        Only read for a three-quarter outline, which ends behind the metatarsal heads, or at the
        trim line of its shell.

    Returns
    -------
    (n, 2) float64, mm, insole frame
        A closed curve, counter-clockwise, the first point not repeated. From foot or shoe size it
        is concave at most at the waist; a mirrored foot has the mirrored outline.

    Raises
    ------
    DesignError
        If a trim line leaves no shell.
    """
    outline = design.outline
    if outline.source == "drawn" and outline.points_mm is not None:
        drawn = closed_curve(outline_points(foot, design, landmarks))
        return _in_shoe(foot, outline, drawn, foot.side)
    curve = _in_shoe(foot, outline, _full(foot, outline), None)
    if outline.extent == "three_quarter":
        curve = _three_quarter(foot, design, curve, landmarks)
    if foot.side.medial_sign > 0:
        return curve
    return np.roll(curve[::-1], 1, axis=0) * [-1.0, 1.0]


def outline_reach(foot: Foot, outline: Outline) -> FloatArray:
    """Compute the bounding box of an outline in its full length.

    Parameters
    ----------
    outline
        Its extent is ignored.

    Returns
    -------
    (2, 2) float64, mm, insole frame
        Least and greatest (x, y).
    """
    curve = full_outline(foot, outline)
    return np.stack([curve.min(axis=0), curve.max(axis=0)])


def full_outline(foot: Foot, outline: Outline) -> FloatArray:
    """Compute an outline in its full length: `insole_outline` that ignores the extent."""
    return insole_outline(
        foot, InsoleDesign(foot.side, outline=replace(outline, extent="full")), {}
    )


def outline_points(foot: Foot, design: InsoleDesign, landmarks: Landmarks) -> tuple[Place, ...]:
    """Return the control points of a design's outline.

    Parameters
    ----------
    landmarks
        Only read for a three-quarter outline.

    Returns
    -------
    tuple of (x, y), mm, insole frame
        Counter-clockwise. Of an outline that is not drawn, points on its curve, from which drawing
        can start.
    """
    outline = design.outline
    if outline.source == "drawn" and outline.points_mm is not None:
        points = np.array(outline.points_mm)
        points = points if signed_area_mm2(points) > 0 else points[::-1]
    else:
        curve = insole_outline(foot, design, landmarks)
        points = curve[:: len(curve) // _HANDLES]
    return tuple((float(x), float(y)) for x, y in points)


def shoe_inside(foot: Foot, outline: Outline) -> FloatArray | None:
    """Return the inside (n, 2) of an outline's shoe round the foot's insole, mm, insole frame."""
    if outline.shoe is None:
        return None
    return _inside(foot, outline, outline.shoe, foot.side)


_Front: TypeAlias = Callable[[FloatArray, FloatArray], FloatArray]


def _full(foot: Foot, outline: Outline) -> FloatArray:
    """Return the outline around the whole foot, medial = +x."""
    key = replace(outline, extent="full")
    return foot.derived.get("full outline", key, lambda: _about_foot(foot, outline))


def _in_shoe(foot: Foot, outline: Outline, curve: FloatArray, side: Side | None) -> FloatArray:
    """Return a curve trimmed to the outline's shoe, if that is asked; no side: medial = +x."""
    shoe = outline.shoe
    if shoe is None or not shoe.trim:
        return curve
    key = outline, curve.tobytes()
    return foot.derived.get(
        "in shoe",
        key,
        lambda: trimmed_to(curve, _inside(foot, outline, shoe, side), shoe),
    )


def _inside(foot: Foot, outline: Outline, shoe: Shoe, side: Side | None) -> FloatArray:
    """Return where a shoe lies about the usual insole of the foot."""
    source = "foot" if outline.source == "drawn" else outline.source
    whole = _full(foot, replace(outline, source=source, shoe=None))
    inside = placed_inside(shoe, whole)
    if side is None or side.medial_sign > 0:
        return inside
    return np.asarray(inside[::-1] * [-1.0, 1.0])


def _about_foot(foot: Foot, outline: Outline) -> FloatArray:
    places, share, before_mm = _allowed(foot, outline)
    waist = (share > _WAIST_BEGIN) & (share < np.where(places[:, 0] > 0, *_WAIST_END))
    curve = fair_curve(places, np.where(waist[:, None], _HOLLOW, _ROUND))
    low, high = curve[:, 1].min(), curve[:, 1].max()
    whole_mm = before_mm + outline.heel_allowance_mm
    y = (curve[:, 1] - low) / (high - low) * whole_mm - outline.heel_allowance_mm
    return np.column_stack([curve[:, 0], y])


def _allowed(foot: Foot, outline: Outline) -> tuple[FloatArray, FloatArray, float]:
    """Return the foot's border with the allowances, its shares of the length, and the front's y.

    The toe allowance grows over the toes, that of a shoe size over the whole length.
    """
    border, heel_mm = foot_border(foot), outline.heel_allowance_mm
    share = border.places[:, 1] / foot.length_mm
    ball = smooth_step(share, *_HEEL_TO_BALL)
    wider = heel_mm + (outline.ball_allowance_mm - heel_mm) * ball
    x = border.places[:, 0] + wider * border.outward[:, 0]
    if outline.source == "shoe_size" and outline.shoe_size_eu is not None:
        before_mm = PARIS_MM * outline.shoe_size_eu - heel_mm
        y = share * before_mm
    else:
        before_mm = foot.length_mm + outline.toe_allowance_mm
        y = border.places[:, 1] + outline.toe_allowance_mm * smooth_step(share, *_TOES)
    y = y + heel_mm * np.minimum(border.outward[:, 1], 0)
    places = np.column_stack([x, y])
    if outline.width_mm is not None:
        places[:, 0] += _narrowing(foot, outline.width_mm, places, share)
    return places, share, before_mm


def _narrowing(foot: Foot, width_mm: float, places: FloatArray, share: FloatArray) -> FloatArray:
    """Return by how much the medial border moves so that it passes the 1st head at a distance.

    It moves more and more from the heel to the head, and ahead of it as much.
    """
    first = find_landmarks(foot)[HEADS[0]].point[:2] * [foot.side.medial_sign, 1.0]
    medial = np.flatnonzero((places[:, 0] > 0) & (share > _HEEL_TO_BALL[0]))
    beside = medial[np.abs(places[medial, 1] - first[1]).argmin()]
    at_head = first[1] / foot.length_mm
    moved = smooth_step(share, _HEEL_TO_BALL[0], at_head)
    moved *= smooth_step(places[:, 0] / places[beside, 0], 0.0, 0.6)
    return np.asarray((first[0] + width_mm - places[beside, 0]) * moved)


def _three_quarter(
    foot: Foot, design: InsoleDesign, whole: FloatArray, landmarks: Landmarks
) -> FloatArray:
    """Return the part of the full outline behind the heads, front bowed, corners rounded."""
    sign = np.array([foot.side.medial_sign, 1.0])
    if design.shell is not None:
        points = np.array(trim_points(design.shell, foot.side, landmarks)) * sign
        return foot.derived.get(
            "trimmed outline",
            (design.outline, points.tobytes()),
            lambda: _trimmed(whole, points, foot.length_mm),
        )
    heads = np.array([landmarks[name].point[:2] for name in HEADS]) * sign
    key = design.outline, heads.tobytes()
    return foot.derived.get(
        "three-quarter outline", key, lambda: _shortened(whole, heads, foot.length_mm)
    )


def _trimmed(whole: FloatArray, points: FloatArray, length_mm: float) -> FloatArray:
    """Return the part of an outline behind a trim line."""
    line = TrimLine(points)
    front = partial(line.between, count=_FRONT_POINTS - 2)
    return _cut(whole, line.ahead_mm(whole, length_mm), front, _TRIM_CORNER_MM)


def _shortened(whole: FloatArray, heads: FloatArray, length_mm: float) -> FloatArray:
    across, ahead = heads[0] - heads[-1]
    slope = float(np.clip(ahead / max(across, 1.0), -_STEEPEST, _STEEPEST))
    edge_mm = float((heads[:, 1] - slope * heads[:, 0]).min()) - _BEHIND_HEADS_MM
    edge_mm = max(edge_mm, _SHORTEST * length_mm)
    ahead_mm = whole[:, 1] - edge_mm - slope * whole[:, 0]
    return whole if (ahead_mm < 0).all() else _cut(whole, ahead_mm, _bow)


def _cut(
    whole: FloatArray,
    ahead_mm: FloatArray,
    front: _Front,
    corner_mm: tuple[float, float] = _CORNER_MM,
) -> FloatArray:
    """Return the part of an outline behind a line, closed along it, its corners rounded.

    Parameters
    ----------
    ahead_mm : (n,) float64
        How far each point of the outline lies ahead of the line.
    front
        Returns the points of the line between its medial and its lateral end.
    corner_mm
        Distance from these up to which the curve is rounded, and from which on it is not.
    """
    behind = np.flatnonzero(ahead_mm < 0)
    gap = int(np.diff(behind).argmax())
    inside = behind[[gap, gap + 1]]
    outside = inside + np.array([1, -1])
    share = ahead_mm[inside] / (ahead_mm[inside] - ahead_mm[outside])
    medial, lateral = whole[inside] + share[:, None] * (whole[outside] - whole[inside])
    edge = np.stack([medial, *front(medial, lateral), lateral])
    cut = evenly_spread(np.insert(whole[behind], gap + 1, edge, axis=0), len(whole))
    return _rounded(cut, corner_mm, medial, lateral)


def _bow(start: FloatArray, end: FloatArray) -> FloatArray:
    """Return points between two others on a flat parabola that bulges to the right."""
    share = np.linspace(0, 1, _FRONT_POINTS)[1:-1, None]
    way = end - start
    aside = np.array([way[1], -way[0]])
    return np.asarray(start + share * way + 4 * _BOW * share * (1 - share) * aside)


def _rounded(curve: FloatArray, corner_mm: tuple[float, float], *corners: FloatArray) -> FloatArray:
    """Round a closed curve at its corners, and hardly elsewhere."""
    curve = smoothed_along(curve, _EVENING_MM)
    for _ in range(_ROUNDINGS):
        away_mm = np.min([np.hypot(*(curve - corner).T) for corner in corners], axis=0)
        rounding = 1 - smooth_step(away_mm, *corner_mm)
        curve = curve + rounding[:, None] * (smoothed_along(curve, _ROUNDING_MM) - curve)
        curve = evenly_spread(curve, len(curve))
    return smoothed_along(curve, _EVENING_MM)
