"""The edge of the insole from above, as the design asks for it: foot, shoe size or drawn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks
from insole_core.foot.measures import PARIS_MM
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.sampling import sample_triangles
from insole_core.insole.blending import smooth_step
from insole_core.insole.design import InsoleDesign, Outline, Place
from insole_core.insole.outline_curve import closed_curve

_STATIONS = np.array(
    [0.03, 0.08, 0.14, 0.22, 0.32, 0.42, 0.52, 0.60, 0.67, 0.74, 0.81, 0.88, 0.94, 0.98]
)
_BAND = 0.02
_BORDER_HEIGHT_MM = 30.0  # what lies higher does not widen the outline
_HEEL_TO_BALL = (0.30, 0.55)
_TOES = (0.75, 1.0)
_BEHIND_HEADS_MM = 8.0
_PITCH_MM = 1.0
_CORNER = 0.04  # share of the length over which the front corners are rounded


def insole_outline(foot: Foot, design: InsoleDesign, landmarks: Landmarks) -> FloatArray:
    """Give the outline that a design asks for.

    Returns
    -------
    (n, 2) float64, mm, insole frame
        A closed curve, counter-clockwise, the first point not repeated.
    """
    return closed_curve(outline_points(foot, design.outline, landmarks))


def outline_reach(foot: Foot, outline: Outline) -> FloatArray:
    """Give the box (2, 2), mm, about the outline in its full length."""
    curve = closed_curve(outline_points(foot, replace(outline, extent="full"), {}))
    return np.stack([curve.min(axis=0), curve.max(axis=0)])


def outline_points(foot: Foot, outline: Outline, landmarks: Landmarks) -> tuple[Place, ...]:
    """The places that the outline runs through; a drawn one begins with them to be dragged."""
    if outline.source == "drawn" and outline.points_mm is not None:
        points = np.array(outline.points_mm)
        return _places(points if _turns_left(points) else points[::-1])
    stations = _STATIONS
    if outline.extent == "three_quarter":
        end = _three_quarter_end(foot, landmarks)
        stations = stations[stations < end - _CORNER]
        left, right = _edges(foot, outline, np.append(stations, end))
        front = right[-1] + np.array([[0.2], [0.5], [0.8]]) * (left[-1] - right[-1])
        left, right = left[:-1], right[:-1]
    else:
        left, right = _edges(foot, outline, stations)
        front = np.array([_tip(foot, outline)])
    heel = np.array([[(left + right)[0, 0] / 2, -outline.heel_allowance_mm]])
    return _places(np.concatenate([heel, right, front, left[::-1]]))


def _three_quarter_end(foot: Foot, landmarks: Landmarks) -> float:
    """Share of the length where an insole ends behind the heads."""
    heads = min(float(landmarks[f"metatarsal_head_{n}"].point[1]) for n in range(1, 6))
    return (heads - _BEHIND_HEADS_MM) / foot.length_mm


def _edges(foot: Foot, outline: Outline, stations: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places (n, 2) of the left and the right edge of the insole."""
    left, right = _borders(foot, stations)
    ball = smooth_step(stations, *_HEEL_TO_BALL)
    heel_mm, ball_mm = outline.heel_allowance_mm, outline.ball_allowance_mm
    wider, y = heel_mm + (ball_mm - heel_mm) * ball, _stretched(stations, foot.length_mm, outline)
    return np.column_stack([left - wider, y]), np.column_stack([right + wider, y])


@dataclass(frozen=True, eq=False)
class _Low:
    """What of a foot may widen its outline.

    Parameters
    ----------
    points : (n, 3) float64, mm, by rising y
        All vertices, and some within large triangles.
    length_mm
        Of the foot.
    """

    points: FloatArray
    length_mm: float

    def near(self, share: float) -> FloatArray:
        """The x of the points about a share of the length."""
        y, middle, band = self.points[:, 1], share * self.length_mm, _BAND * self.length_mm
        first, end = np.searchsorted(y, [middle - band, middle + band])
        return self.points[first:end, 0]

    @cached_property
    def tip_x_mm(self) -> float:
        """Mean x of the foremost points."""
        y = self.points[:, 1]
        front = self.points[np.searchsorted(y, y[-1] - _BAND * self.length_mm) :, 0]
        return float(front.mean())


_lows: WeakKeyDictionary[Foot, _Low] = WeakKeyDictionary()


def _borders(foot: Foot, stations: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest x of the foot about each share of its length."""
    low = _low(foot)
    left, right = (np.full(len(stations), np.nan) for _ in range(2))
    for i, station in enumerate(stations):
        x = low.near(station)
        if len(x):
            left[i], right[i] = x.min(), x.max()
    known = np.isfinite(left)
    left, right = (np.interp(stations, stations[known], side[known]) for side in (left, right))
    return left, right


def _low(foot: Foot) -> _Low:
    """Kept for each foot: an outline that is dragged asks for it again and again."""
    if foot not in _lows:
        part = foot.mesh.part(foot.mesh.vertices[:, 2] < _BORDER_HEIGHT_MM)
        samples = sample_triangles(part, _PITCH_MM).points
        points = np.concatenate([part.vertices, samples])
        _lows[foot] = _Low(points[points[:, 1].argsort()], foot.length_mm)
    return _lows[foot]


def _stretched(stations: FloatArray, length_mm: float, outline: Outline) -> FloatArray:
    """y of the stations: the toes' allowance grows over the toes, a shoe's length over all."""
    if outline.source == "shoe_size" and outline.shoe_size_eu is not None:
        return stations * (PARIS_MM * outline.shoe_size_eu - outline.heel_allowance_mm)
    return stations * length_mm + outline.toe_allowance_mm * smooth_step(stations, *_TOES)


def _tip(foot: Foot, outline: Outline) -> list[float]:
    return [_low(foot).tip_x_mm, float(_stretched(np.ones(1), foot.length_mm, outline)[0])]


def _turns_left(points: FloatArray) -> bool:
    x, y = points.T
    return bool((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() > 0)


def _places(points: FloatArray) -> tuple[Place, ...]:
    return tuple((float(x), float(y)) for x, y in points)
