"""The edge of an insole as a way round the foot, its places, and how far the foot reaches up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.insole.fields import Place
from insole_core.insole.outline.insole_outline import full_outline
from insole_core.insole.prescription.finish import HEADS_ALONG
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.outline_curve import evenly_spread, way_round

_PITCH_MM = 1.0
_LEAST_SHARE = 0.05
"""Least share of a border on either side of its head, where an outline is drawn short."""
_HIGHEST_MM = 45.0  # no rim is higher
_BESIDE_MM = 7.0
_SIGMA_MM = 4.0


@dataclass(frozen=True, eq=False)
class Edge:
    """Points along the edge of a full-length insole.

    The way starts in front of the toes and runs along the medial border to the heel, and from there
    along the lateral border back to the toes.

    Parameters
    ----------
    points_mm : (n, 2) float64, insole frame
        Evenly spaced, about 1 mm apart; the first is not repeated.
    length_mm
        Of the whole edge.
    heel_mm, medial_head_mm, lateral_head_mm
        Arc lengths behind the heel, beside the 1st and beside the 5th head; that of the toes is 0.
    """

    points_mm: FloatArray
    length_mm: float
    heel_mm: float
    medial_head_mm: float
    lateral_head_mm: float

    @property
    def step_mm(self) -> float:
        """Distance between neighbouring points along the edge."""
        return self.length_mm / len(self.points_mm)

    @property
    def arc_mm(self) -> FloatArray:
        """(n,) arc length of each point."""
        return np.asarray(np.arange(len(self.points_mm)) * self.step_mm)

    @property
    def is_medial(self) -> BoolArray:
        """(n,) whether a point belongs to the medial border."""
        return np.asarray(self.arc_mm <= self.heel_mm)

    @property
    def along(self) -> FloatArray:
        """(n,) share of its border's way at each point; see `RimStation.along`."""
        return self.along_of(self.arc_mm)

    @property
    def turn(self) -> float:
        """+1 if the points run counter-clockwise (right foot), -1 if clockwise."""
        return float(np.sign(signed_area_mm2(self.points_mm)))

    def along_of(self, arc_mm: FloatArray) -> FloatArray:
        """Return the share of their border's way (k,) at arc lengths (k,)."""
        marks = [0.0, self.medial_head_mm, self.heel_mm, self.lateral_head_mm, self.length_mm]
        return np.asarray(np.interp(arc_mm, marks, [1.0, HEADS_ALONG, 0.0, HEADS_ALONG, 1.0]))

    def arc_of(self, border: str, along: float) -> float:
        """Return the arc length of a share of the way along a border, "medial" or "lateral"."""
        head = self.medial_head_mm if border == "medial" else self.lateral_head_mm
        toes = 0.0 if border == "medial" else self.length_mm
        return float(np.interp(along, [0.0, HEADS_ALONG, 1.0], [self.heel_mm, head, toes]))

    def border_of(self, arc_mm: float) -> str:
        """Return the border, "medial" or "lateral", to which an arc length belongs."""
        return "medial" if arc_mm <= self.heel_mm else "lateral"

    def point_at(self, arc_mm: float) -> Place:
        """Return the point (x, y), mm, insole frame, at an arc length."""
        return (
            float(self.at(self.points_mm[:, 0], arc_mm)),
            float(self.at(self.points_mm[:, 1], arc_mm)),
        )

    def at(self, values: FloatArray, arc_mm: FloatArray | float) -> FloatArray:
        """Interpolate values (n,) at the edge's points at arc lengths."""
        return np.asarray(np.interp(arc_mm, self.arc_mm, values, period=self.length_mm))

    def nearest_arc_mm(self, x_mm: float, y_mm: float) -> float:
        """Return the arc length of the edge's point nearest to a place, insole frame."""
        _, nearest = scipy.spatial.KDTree(self.points_mm).query([x_mm, y_mm])
        return float(self.arc_mm[nearest])


def insole_edge(foot: Foot, outline: Outline) -> Edge:
    """Return the edge of an outline in its full length; cached with the foot.

    Parameters
    ----------
    outline
        Its extent is ignored: a short insole has the same rim, as far as it reaches.
    """
    return foot.derived.get("insole edge", outline, lambda: _measured(foot, outline))


def _measured(foot: Foot, outline: Outline) -> Edge:
    medial = foot.side.medial_sign
    curve = full_outline(foot, outline) * [medial, 1.0]
    if medial > 0:
        curve = curve[::-1]  # the outline is counter-clockwise: it passes the toes laterally
    curve = np.roll(curve, -int(curve[:, 1].argmax()), axis=0)
    steps_mm = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T)
    length_mm = float(steps_mm.sum())
    points = evenly_spread(curve, round(length_mm / _PITCH_MM))
    heel_mm = float(way_round(curve)[curve[:, 1].argmin()]) * length_mm
    heads = [find_landmarks(foot)[f"metatarsal_head_{n}"].point[:2] * [medial, 1.0] for n in (1, 5)]
    arc_mm = np.asarray(np.arange(len(points)) * (length_mm / len(points)))
    borders = ((0.0, heel_mm), (heel_mm, length_mm))
    beside = [
        _nearest_mm(points, arc_mm, border, head)
        for border, head in zip(borders, heads, strict=True)
    ]
    return Edge(points * [medial, 1.0], length_mm, heel_mm, *beside)


def _nearest_mm(
    points: FloatArray, arc_mm: FloatArray, border: tuple[float, float], head: FloatArray
) -> float:
    """Return the arc length of the point of a border that is nearest to a head."""
    margin = _LEAST_SHARE * (border[1] - border[0])
    on_border = (arc_mm >= border[0] + margin) & (arc_mm <= border[1] - margin)
    away = np.hypot(*(points[on_border] - head).T)
    return float(arc_mm[on_border][away.argmin()])


def flank_heights(foot: Foot, outline: Outline) -> FloatArray:
    """Return the greatest height of the level foot beside each point of an edge; cached.

    Returns
    -------
    (n,) float64, mm
        Over the foot's ground, at most 45; 0 where no part of the foot is within 7 mm.
    """
    make = lambda: _measured_heights(foot, insole_edge(foot, outline))  # noqa: E731
    return foot.derived.get("flank heights", outline, make)


def _measured_heights(foot: Foot, edge: Edge) -> FloatArray:
    points = foot.even.points
    low = points[points[:, 2] <= _HIGHEST_MM]
    beside = scipy.spatial.KDTree(low[:, :2]).query_ball_point(edge.points_mm, _BESIDE_MM)
    highest = np.array([low[near, 2].max(initial=0.0) for near in beside])
    return np.asarray(
        scipy.ndimage.gaussian_filter1d(highest, _SIGMA_MM / edge.step_mm, mode="wrap")
    )
