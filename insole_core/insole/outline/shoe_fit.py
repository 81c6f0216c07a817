"""An outline in a shoe: where it is wider than the inside, and trimming it."""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.prescription.outline import Shoe
from insole_core.insole.primitives.outline_curve import (
    closed_curve,
    evenly_spread,
    inside_curve,
    smoothed_along,
)

HEEL_SHARE, BALL_SHARE = 0.15, 0.67
"""Shares of the length where the middles of an insole and of its shoe coincide."""
_BAND = 0.02
_POINTS, _EVENING_MM = 1440, 2.0
_LEAST_MM = 0.25
"""An insole that is wider by less fits."""


@dataclass(frozen=True, eq=False)
class ShoeFit:
    """Where an insole is wider than its shoe.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame
        Of the insole.
    inside : (m, 2) float64, mm, insole frame
        Of the shoe.
    over_mm : (n,) float64
        How far each point of the outline lies outside the shoe; negative inside.
    """

    outline: FloatArray
    inside: FloatArray
    over_mm: FloatArray

    @property
    def most_over_mm(self) -> float:
        """Greatest excess; 0 when the insole fits."""
        most = float(self.over_mm.max())
        return most if most > _LEAST_MM else 0.0

    def wider(self) -> list[FloatArray]:
        """Return the pieces (k, 2) of the outline that lie outside."""
        outside = self.over_mm > _LEAST_MM
        if outside.all() or not outside.any():
            return [self.outline] if outside.any() else []
        start = int(np.flatnonzero(~outside)[0])
        edge, outside = np.roll(self.outline, -start, axis=0), np.roll(outside, -start)
        ends = np.flatnonzero(np.diff(outside.astype(np.int8), append=0))
        return [edge[first + 1 : last + 1] for first, last in ends.reshape(-1, 2)]

    @property
    def widest_place(self) -> FloatArray:
        """(2,) point of the outline that is farthest outside."""
        return np.asarray(self.outline[self.over_mm.argmax()])


def fit_in(outline: FloatArray, inside: FloatArray) -> ShoeFit:
    """Compare an outline (n, 2) with the inside (m, 2) of a shoe, mm, insole frame."""
    return ShoeFit(outline, inside, _over_mm(outline, inside))


def placed_inside(shoe: Shoe, whole: FloatArray) -> FloatArray:
    """Return the inside (m, 2) of a shoe where it lies round an insole, mm, medial = +x.

    Parameters
    ----------
    shoe
    whole : (n, 2) float64, mm, insole frame, medial = +x
        Outline of the insole in its full length, not trimmed. It lies at the rear of the shoe but
        for the clearance, and the middles of its heel and ball in those of the shoe.
    """
    inside = closed_curve(shoe.inside_mm)
    heel, ball = middles(inside)
    to_heel, to_ball = middles(whole)
    turn = np.arctan2(*(to_ball - to_heel)) - np.arctan2(*(ball - heel))
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    turned = (inside - heel) @ rotation.T
    turned[:, 0] += to_heel[0]
    turned[:, 1] += whole[:, 1].min() - shoe.clearance_mm - turned[:, 1].min()
    return np.asarray(turned)


def middles(curve: FloatArray) -> FloatArray:
    """Return the middles (2, 2) of a closed curve at heel and ball."""
    low, high = curve[:, 1].min(), curve[:, 1].max()
    dense = evenly_spread(curve, _POINTS)
    found = []
    for share in (HEEL_SHARE, BALL_SHARE):
        y = low + share * (high - low)
        x = dense[np.abs(dense[:, 1] - y) < _BAND * (high - low), 0]
        found.append(((x.min() + x.max()) / 2, y))
    return np.array(found)


def trimmed_to(outline: FloatArray, inside: FloatArray, shoe: Shoe) -> FloatArray:
    """Return the part (n, 2) of an outline within a shoe, with the clearance that it asks.

    Parameters
    ----------
    outline : (n, 2) float64, mm, insole frame
        Counter-clockwise; returned as it is when it fits.
    inside : (m, 2) float64, mm, insole frame
        Of the shoe, as placed.

    Raises
    ------
    DesignError
        When nothing is left of it.
    """
    if (_over_mm(outline, inside) <= _LEAST_MM - shoe.clearance_mm).all():
        return outline
    room = _section(inside).offset(-shoe.clearance_mm, manifold3d.JoinType.Round)
    rough = _largest(_section(outline) ^ room, shoe)
    fair = smoothed_along(evenly_spread(rough, _POINTS), _EVENING_MM)
    within = evenly_spread(_largest(_section(fair) ^ room, shoe), len(outline))
    start = np.hypot(*(within - outline[0]).T).argmin()
    return np.roll(within, -int(start), axis=0)


def _section(curve: FloatArray) -> manifold3d.CrossSection:
    return manifold3d.CrossSection([curve], manifold3d.FillRule.NonZero)


def _largest(section: manifold3d.CrossSection, shoe: Shoe) -> FloatArray:
    parts = sorted(section.decompose(), key=lambda part: part.area())
    if not parts:
        raise DesignError(
            'Nothing of the insole lies in the shoe "{shoe}"; choose the right shoe.',
            shoe=shoe.name,
        )
    return np.asarray(parts[-1].to_polygons()[0], float)


def _over_mm(outline: FloatArray, inside: FloatArray) -> FloatArray:
    """Return the signed distances (n,) of an outline from a closed curve, positive outside."""
    dense = evenly_spread(inside, 4 * _POINTS)
    away = scipy.spatial.cKDTree(dense).query(outline)[0]
    return np.asarray(np.where(inside_curve(inside, outline), -away, away))
