"""How far a foot reaches in a direction, strip by strip across it, and how certain that is.

The border of a foot is round in a section. Written by its support function, the distance H of the
tangent whose slope against the upright is b, it needs three numbers near the outermost place:

    H(b) = reach + height b + radius b² / 2      and the place touched lies at   height + radius b

(the derivative of the support function). So outlines in pictures, of which only the tangents are
known, the measured surface, and what is usual of radius and height come together in one linear
least-squares problem, whose covariance tells how far to trust the reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.contour_constraints import ContourConstraints

_LEAST_TOWARDS = 0.75  # cosine against the direction: farther round, three numbers do not do
_STRIP_MM, _SPREAD_MM = 2.0, 2.5
_TOUCH_MM, _TOUCHES_SHARED = 0.35, 2.0  # noise of an outline, and how many share it
_SURFACE_MM, _PLACE_MM, _SURFACE_WORTH = 0.8, 2.0, 2.0
"""Noise of the measured surface near its rim, of the height there, and how many independent places
a strip of it is worth."""
_OUTLYING_TOUCH_MM, _OUTLYING = 1.0, 2.0
_ROUNDS = 4
_LEAST_WEIGHT = 0.05
_NOTHING_MM = 1e4
_ARC = 0.2
"""Share of its radius, on either side of its outermost place, that a border is about an arc."""
USUAL_MM = 12.0
"""So far from its usual place an end must lie a millimetre farther out."""


@dataclass(frozen=True)
class UsualBorder:
    """What is usual of a border about its outermost place.

    Parameters
    ----------
    height_mm, radius_mm
        Of that place, and of the section there, each with its standard deviation.
    bend_mm
        Radius of the border as seen from below; None where it is too small to go by.
    """

    height_mm: tuple[float, float]
    radius_mm: tuple[float, float]
    bend_mm: float | None = None

    def scaled(self, factor: float) -> UsualBorder:
        """For a foot of another size."""
        height, radius = (
            (factor * value, factor * spread) for value, spread in (self.height_mm, self.radius_mm)
        )
        return UsualBorder(height, radius, None if self.bend_mm is None else factor * self.bend_mm)


@dataclass(frozen=True, eq=False)
class BorderFit:
    """The border in strips across the direction.

    Parameters
    ----------
    across_mm, reach_mm, height_mm, deviation_mm : (s,) float64
        Middle of each strip, how far the foot reaches there, at which height, and the standard
        deviation of the reach.
    touched : (s,) float64
        How many outlines count there.
    """

    across_mm: FloatArray
    reach_mm: FloatArray
    height_mm: FloatArray
    deviation_mm: FloatArray
    touched: FloatArray

    def summit(self, counts: BoolArray, bend_mm: float | None, usual_mm: float | None) -> Extremum:
        """Find where the border reaches farthest.

        Where its bend is known, the strips about the one that reaches farthest tell it together:
        alone it is often its noise that makes a strip the farthest.

        Parameters
        ----------
        counts : (s,) bool
            Strips to go by; one at least.
        bend_mm
            See `UsualBorder`.
        usual_mm
            Where across the direction the place usually lies: aside of it, the border must reach
            farther to count as far.
        """
        pull = 0.0 if usual_mm is None else USUAL_MM**-2
        aside = self.across_mm - (usual_mm or 0.0)
        rated = np.where(counts, self.reach_mm - pull * aside**2, -np.inf)
        best = int(rated.argmax())
        if bend_mm is None:
            return Extremum(float(self.across_mm[best]), float(self.reach_mm[best]), best)
        away = self.across_mm - self.across_mm[best]
        near = counts & (np.abs(away) <= _ARC * bend_mm)
        bend, weights, way = 0.5 / bend_mm + pull, 1 / self.deviation_mm[near], away[near]
        rows = np.column_stack([weights, weights * way])
        height, slope = np.linalg.lstsq(rows, weights * (rated[near] + bend * way**2))[0]
        ahead = float(np.clip(slope / (2 * bend), way.min(), way.max()))
        reach = height + slope * ahead - bend * ahead**2 + pull * (aside[best] + ahead) ** 2
        strip = int(np.where(counts, np.abs(away - ahead), np.inf).argmin())
        return Extremum(float(self.across_mm[best]) + ahead, float(reach), strip)


@dataclass(frozen=True)
class Extremum:
    """Where a border reaches farthest: across the direction and along it; and the strip there."""

    across_mm: float
    reach_mm: float
    strip: int


def fit_border(
    surface: ContourConstraints,
    touches: ContourConstraints,
    direction: FloatArray,
    between_mm: tuple[float, float],
    usual: UsualBorder,
) -> BorderFit:
    """Fit the border in strips.

    Parameters
    ----------
    surface
        Places and normals of what was measured.
    touches
        Outlines.
    direction : (3,) horizontal
    between_mm
        Of the coordinate across the direction, x along y or y along x.
    usual
    """
    outlines, measured = (_Rows.of(seen, direction, between_mm) for seen in (touches, surface))
    count = max(int(np.ptp(between_mm) / _STRIP_MM), 1)
    middles = between_mm[0] + (np.arange(count) + 0.5) * np.ptp(between_mm) / count
    fits = np.array([_fit(outlines, measured, middle, usual) for middle in middles])
    return BorderFit(middles, *fits.T)


@dataclass(frozen=True, eq=False)
class _Rows:
    """Tangents of sections: where across, distance, slope, and height of the place."""

    across: FloatArray
    distance: FloatArray
    slope: FloatArray
    height: FloatArray

    @staticmethod
    def of(
        seen: ContourConstraints, direction: FloatArray, between_mm: tuple[float, float]
    ) -> _Rows:
        aside = np.abs(direction[[1, 0, 2]])
        towards, across = seen.normals @ direction, seen.points @ aside
        low, high = between_mm
        margin = 3 * _SPREAD_MM
        near = towards > _LEAST_TOWARDS
        near &= (across > low - margin) & (across < high + margin)
        points, normals = seen.points[near], seen.normals[near]
        towards, across = towards[near], across[near]
        distance = np.einsum("kc,kc->k", points, normals) - normals @ aside * across
        return _Rows(across, distance / towards, normals[:, 2] / towards, points[:, 2])

    def weights(self, middle: float) -> FloatArray:
        return np.asarray(np.exp(-0.5 * ((self.across - middle) / _SPREAD_MM) ** 2))


def _fit(
    outlines: _Rows, measured: _Rows, middle: float, usual: UsualBorder
) -> tuple[float, float, float, float]:
    """Reach, height, deviation of the reach, and weight of the outlines of one strip."""
    touched, near = outlines.weights(middle), measured.weights(middle)
    worth = _SURFACE_WORTH * near / max(near.sum(), _SURFACE_WORTH)
    rows = np.concatenate(
        [_tangents(outlines.slope), _tangents(measured.slope), _places(measured.slope)]
    )
    values = np.concatenate([outlines.distance, measured.distance, measured.height])
    information = np.concatenate(
        [
            touched / (_TOUCHES_SHARED * _TOUCH_MM**2),
            worth / _SURFACE_MM**2,
            worth / _PLACE_MM**2,
        ]
    )
    outlying = np.repeat(
        [_OUTLYING_TOUCH_MM, _OUTLYING * _SURFACE_MM, _OUTLYING * _PLACE_MM],
        [len(touched), len(near), len(near)],
    )
    counts = np.concatenate([touched, near, near]) > _LEAST_WEIGHT
    rows, values, information = rows[counts], values[counts], information[counts]
    outlying = outlying[counts]
    (height, height_spread), (radius, radius_spread) = usual.height_mm, usual.radius_mm
    prior = np.diag([_NOTHING_MM**-2, height_spread**-2, radius_spread**-2])
    known = np.array([0.0, height, radius])
    weights = information
    for _ in range(_ROUNDS):
        normal = rows.T @ (weights[:, None] * rows) + prior
        solution = np.linalg.solve(normal, rows.T @ (weights * values) + prior @ known)
        off = (values - rows @ solution) / outlying
        weights = information / (1 + off**2) ** 2
    deviation = float(np.sqrt(np.linalg.inv(normal)[0, 0]))
    return float(solution[0]), float(solution[1]), deviation, float(touched.sum())


def _tangents(slope: FloatArray) -> FloatArray:
    return np.column_stack([np.ones_like(slope), slope, slope**2 / 2])


def _places(slope: FloatArray) -> FloatArray:
    return np.column_stack([np.zeros_like(slope), np.ones_like(slope), slope])
