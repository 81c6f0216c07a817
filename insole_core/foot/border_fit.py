"""How far a foot reaches in a direction, strip by strip across it, with its uncertainty.

The border of a foot is round in a section. Described by its support function, the distance H of the
tangent whose slope against the vertical is b, it has three parameters near the outermost point:

    H(b) = reach + height b + radius b² / 2      and the tangent touches at   height + radius b

(the derivative of the support function). So contours in images, of which only the tangents are
known, the measured surface, and the usual radius and height form one linear least-squares problem,
whose covariance gives the uncertainty of the reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import ContourConstraints

_LEAST_TOWARDS = 0.75  # cosine against the direction: beyond, three parameters do not suffice
_STRIP_MM, _SPREAD_MM = 2.0, 2.5
_TOUCH_MM, _TOUCHES_SHARED = 0.35, 2.0  # noise of a contour, and how many points share it
_SURFACE_MM, _PLACE_MM, _SURFACE_WORTH = 0.8, 2.0, 2.0
"""Noise of the measured surface near its rim, of the height there, and the number of independent
points to which a strip of it is equivalent."""
_OUTLYING_TOUCH_MM, _OUTLYING = 1.0, 2.0
_ROUNDS = 4
_LEAST_WEIGHT = 0.05
_NOTHING_MM = 1e4
_SUMMIT_MM = 1.0  # depth of the strips about whose middle an arc is fitted
_ARC = 0.3
"""Share of its radius, to either side of its outermost point, in which a border is like an arc."""
USUAL_MM = 12.0
"""Distance from its usual position at which an end must lie one millimetre farther out."""


@dataclass(frozen=True)
class UsualBorder:
    """The usual shape of a border about its outermost point.

    Parameters
    ----------
    height_mm, radius_mm
        Height of that point and radius of the section there, each with its standard deviation.
    bend_mm
        Radius of the border as seen from below; None where it is too small to be used.
    """

    height_mm: tuple[float, float]
    radius_mm: tuple[float, float]
    bend_mm: float | None = None

    def scaled(self, factor: float) -> UsualBorder:
        """Scale all lengths, for a foot of another size."""
        height, radius = (
            (factor * value, factor * spread) for value, spread in (self.height_mm, self.radius_mm)
        )
        return UsualBorder(height, radius, None if self.bend_mm is None else factor * self.bend_mm)


@dataclass(frozen=True, eq=False)
class BorderFit:
    """The fitted border in strips across the direction.

    Parameters
    ----------
    across_mm, reach_mm, height_mm, deviation_mm : (s,) float64
        Middle of each strip, how far the foot reaches there, at which height, and the standard
        deviation of the reach.
    touched : (s,) float64
        Total weight of the contour points there.
    """

    across_mm: FloatArray
    reach_mm: FloatArray
    height_mm: FloatArray
    deviation_mm: FloatArray
    touched: FloatArray

    def summit(self, counts: BoolArray, bend_mm: float | None, usual_mm: float | None) -> Extremum:
        """Find where the border reaches farthest.

        Where its bend is known, it is fitted to all strips near the farthest one: often a single
        strip is the farthest only by its noise.

        Parameters
        ----------
        counts : (s,) bool
            The strips that are used, at least one.
        bend_mm
            See `UsualBorder`.
        usual_mm
            Usual position across the direction; away from it the border must reach farther to be
            rated as far. None when there is none.

        Returns
        -------
        Extremum
        """
        pull = 0.0 if usual_mm is None else USUAL_MM**-2
        aside = self.across_mm - (usual_mm or 0.0)
        rated = np.where(counts, self.reach_mm - pull * aside**2, -np.inf)
        if bend_mm is None:
            best = int(rated.argmax())
            return Extremum(float(self.across_mm[best]), float(self.reach_mm[best]), best)
        highest = np.maximum(rated - rated[counts].max() + _SUMMIT_MM, 0.0)
        middle = float(highest @ self.across_mm / highest.sum())
        away = self.across_mm - middle
        window = np.maximum(1 - (away / (_ARC * bend_mm)) ** 2, 0.0)
        near = counts & (window > 0)
        if near.sum() < 3:
            near = counts
        bend, way = 0.5 / bend_mm + pull, away[near]
        weights = np.maximum(window[near], _LEAST_WEIGHT) / self.deviation_mm[near]
        rows = np.column_stack([weights, weights * way])
        height, slope = np.linalg.lstsq(rows, weights * (rated[near] + bend * way**2))[0]
        ahead = float(np.clip(slope / (2 * bend), way.min(), way.max()))
        across = middle + ahead
        reach = height + slope * ahead - bend * ahead**2 + pull * (across - (usual_mm or 0.0)) ** 2
        strip = int(np.where(counts, np.abs(away - ahead), np.inf).argmin())
        return Extremum(across, float(reach), strip)


@dataclass(frozen=True)
class Extremum:
    """Where a border reaches farthest: across and along the direction, and the strip there."""

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
    """Fit the border of a foot in strips across a direction, by its support function (see above).

    Parameters
    ----------
    surface
        Points and normals of the measured surface, mm.
    touches
        Contour points with their normals, same frame.
    direction : (3,) float64
        Along an axis of the frame, horizontal.
    between_mm
        Range of the coordinate across the direction: of x along y, or of y along x.
    usual
        The prior.

    Returns
    -------
    BorderFit
    """
    outlines, measured = (_Rows.of(seen, direction, between_mm) for seen in (touches, surface))
    count = max(int(np.ptp(between_mm) / _STRIP_MM), 1)
    middles = between_mm[0] + (np.arange(count) + 0.5) * np.ptp(between_mm) / count
    fits = np.array([_fit(outlines, measured, middle, usual) for middle in middles])
    return BorderFit(middles, *fits.T)


@dataclass(frozen=True, eq=False)
class _Rows:
    """Tangents of sections: position across, distance, slope, and height of the point touched."""

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
    """Compute reach, height, standard deviation of the reach, and contour weight of one strip."""
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
    std = float(np.sqrt(np.linalg.inv(normal)[0, 0]))
    return float(solution[0]), float(solution[1]), std, float(touched.sum())


def _tangents(slope: FloatArray) -> FloatArray:
    return np.column_stack([np.ones_like(slope), slope, slope**2 / 2])


def _places(slope: FloatArray) -> FloatArray:
    return np.column_stack([np.zeros_like(slope), np.ones_like(slope), slope])
