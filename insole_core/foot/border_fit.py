"""How far a foot reaches in a direction, strip by strip across it, with its uncertainty.

The border of a foot is round in a section. Described by its support function, the distance H of the
tangent whose slope against the vertical is b, it has four parameters near the outermost point:

    H(b) = reach + height b + radius b² / 2      and the tangent touches at   height + radius b

(the derivative of the support function), with one radius below that point and another one above it,
where the leg or the back of the foot goes on. So contours in images, of which only the tangents are
known, the measured surface, and the usual radii and height form one linear least-squares problem,
whose covariance gives the uncertainty of the reach. Sections beside each other are alike, those
farther apart less and less: height and radii are Gaussian processes along the border.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import ContourConstraints
from insole_core.geometry.weighted import outermost_mean

_LEAST_TOWARDS = 0.75  # cosine against the direction: beyond, three parameters do not suffice
_STRIP_MM, _SPREAD_MM = 2.0, 2.5
_TOUCH_MM, _TOUCHES_SHARED = 0.35, 2.0  # noise of a contour, and how many points share it
_SURFACE_MM, _SLOPE, _SURFACE_WORTH = 0.8, 0.1, 1.0
"""Noise of the measured surface near its rim, of its slope there, and the number of independent
equations to which those of a millimetre of it, all together, are equivalent."""
_LEAST_RADIUS_MM, _STEEPEST = 6.0, 1.2
"""Of a section on which the points of a surface lie, and the slope beyond which it is straight."""
_WIDE_MM, _OUTERMOST_MM2 = 3.0, 6.0
"""Half of the width of a strip of a measured surface, and the part whose mean is its reach."""
_OUTLYING_TOUCH_MM, _OUTLYING = 0.5, 1.0
_ROUNDS, _ROUNDS_BY_POINTS = 4, 8
_MORE = 3  # strips beyond each end of the border that take part
_BENDS = 3.0
"""How much the bend of a border varies, in shares of it."""
_KNOTS_MM = 8.0  # between the places along a border where its section has parameters of its own
_UNLIKE = 1e-4  # share of the variance of a section's parameter that is no other place's
_LEAST_WEIGHT = 0.05
_NOTHING_MM = 1e4
_SUMMIT_MM = 1.0  # depth of the strips about whose middle an arc is fitted
_TOP_MM = 5.0  # to either side of the summit, whose strips tell how far it reaches
_ARC = 0.45
"""Share of its radius, to either side of its outermost point, in which a border is like an arc."""


@dataclass(frozen=True)
class UsualBorder:
    """The usual shape of a border about its outermost point.

    Parameters
    ----------
    height_mm, below_mm, above_mm
        Height of that point, and radius of the section below and above it: where the border
        begins, in its middle, where it ends, and the standard deviation of each.
    bend_mm
        Radius of the border as seen from below.
    pull_mm
        Distance from its usual position at which its end must lie one millimetre farther out.
    by_points
        Whether of the measured surface only its points count, not the slope that its normals tell.
    alike_mm
        Way along the border over which its section is alike: the length of the correlation.
    """

    height_mm: tuple[float, float, float, float]
    below_mm: tuple[float, float, float, float]
    above_mm: tuple[float, float, float, float]
    bend_mm: float
    pull_mm: float
    by_points: bool = False
    alike_mm: float = 50.0

    def scaled(self, factor: float) -> UsualBorder:
        """Scale all lengths, for a foot of another size."""
        height, below, above = (
            (factor * rear, factor * middle, factor * front, factor * spread)
            for rear, middle, front, spread in (self.height_mm, self.below_mm, self.above_mm)
        )
        return replace(
            self,
            height_mm=height,
            below_mm=below,
            above_mm=above,
            bend_mm=factor * self.bend_mm,
            alike_mm=factor * self.alike_mm,
        )


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

    def summit(
        self, counts: BoolArray, bend_mm: float, usual_mm: float = 0.0, pull_mm: float = np.inf
    ) -> Extremum:
        """Find where the border reaches farthest.

        Its usual bend is fitted to all strips near the farthest one: often a single strip is the
        farthest only by its noise.

        Parameters
        ----------
        counts : (s,) bool
            The strips that are used, at least one.
        bend_mm
            See `UsualBorder`.
        usual_mm
            Usual position across the direction.
        pull_mm
            Distance from it at which the border must reach one millimetre farther to be rated as
            far; infinite where no position is usual.

        Returns
        -------
        Extremum
        """
        pull = pull_mm**-2
        aside = self.across_mm - usual_mm
        rated = np.where(counts, self.reach_mm - pull * aside**2, -np.inf)
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
        slope = np.linalg.lstsq(rows, weights * (rated[near] + bend * way**2))[0][1]
        ahead = float(np.clip(slope / (2 * bend), way.min(), way.max()))
        across = middle + ahead
        beside = np.where(counts, np.abs(away - ahead), np.inf)
        strip = int(beside.argmin())
        top = beside <= max(_TOP_MM, beside[strip])
        arc = self.reach_mm[top] + (bend - pull) * beside[top] ** 2
        reach = np.average(arc, weights=self.deviation_mm[top] ** -2.0)
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
    middles = _middles(between_mm)
    step = np.ptp(between_mm) / len(middles)
    nodes = middles[0] + step * np.arange(-_MORE, len(middles) + _MORE)
    reach, height, deviation = _fit(outlines, measured, nodes, usual)
    inner = slice(_MORE, _MORE + len(middles))
    touched = outlines.weights(middles).sum(axis=1)
    return BorderFit(middles, reach[inner], height[inner], deviation[inner], touched)


def measured_border(
    points: FloatArray, area_mm2: FloatArray, direction: FloatArray, between_mm: tuple[float, float]
) -> BorderFit:
    """Return how far a surface that was measured up to its border reaches, strip by strip.

    Parameters
    ----------
    points : (n, 3) float64, mm
    area_mm2 : (n,) float64
        That each point represents.
    direction, between_mm
        As of `fit_border`.
    """
    middles = _middles(between_mm)
    across, along = points @ np.abs(direction[[1, 0, 2]]), points @ direction
    reaches, heights = np.full((2, len(middles)), np.nan)
    for number, middle in enumerate(middles):
        near = np.abs(across - middle) < _WIDE_MM
        if near.any():
            reaches[number] = outermost_mean(along[near], area_mm2[near], _OUTERMOST_MM2)
            heights[number] = points[near][along[near].argmax(), 2]
    ones = np.ones(len(middles))
    return BorderFit(middles, reaches, heights, ones, np.where(np.isfinite(reaches), ones, 0.0))


def _middles(between_mm: tuple[float, float]) -> FloatArray:
    count = max(int(np.ptp(between_mm) / _STRIP_MM), 1)
    return np.asarray(between_mm[0] + (np.arange(count) + 0.5) * np.ptp(between_mm) / count)


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
        margin = _MORE * _STRIP_MM
        near = towards > _LEAST_TOWARDS
        near &= (across > low - margin) & (across < high + margin)
        points, normals = seen.points[near], seen.normals[near]
        towards, across = towards[near], across[near]
        distance = np.einsum("kc,kc->k", points, normals) - normals @ aside * across
        return _Rows(across, distance / towards, normals[:, 2] / towards, points[:, 2])

    def columns(self, nodes: FloatArray, parts: FloatArray) -> FloatArray:
        """Return equations (k, nodes + 3 knots) for parts (k, 4) of reach, height and radii."""
        hats = _hats(self.across, _knots(nodes))
        reach, *shape = parts.T[:, :, None]
        section = [part * hats for part in shape]
        return np.concatenate([reach * _hats(self.across, nodes), *section], axis=1)

    def on_section(self, nodes: FloatArray, shape: FloatArray) -> _Rows:
        """Return the tangents of sections of some shape (3 knots,) at the heights of the points.

        The support function is least sensitive to the slope there, so its error hardly counts.
        """
        hats = _hats(self.across, _knots(nodes))
        height, below, above = (hats @ part for part in np.split(shape, 3))
        over = self.height - height
        radius = np.maximum(np.where(over < 0, below, above), _LEAST_RADIUS_MM)
        slope = np.clip(over / radius, -_STEEPEST, _STEEPEST)
        along = self.distance - self.slope * self.height
        return replace(self, slope=slope, distance=along + slope * self.height)

    def weights(self, middles: FloatArray) -> FloatArray:
        """Return how near (s, k) each tangent is to some strips."""
        return np.asarray(np.exp(-0.5 * ((self.across - middles[:, None]) / _SPREAD_MM) ** 2))


def _fit(
    outlines: _Rows, measured: _Rows, nodes: FloatArray, usual: UsualBorder
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Compute reach, height and standard deviation of the reach at some places along a border.

    The reach bends as usual from each place to the next, and height and radii of the section
    are alike beside it: where outlines show only one side of it, those beside tell how round it is.
    """
    prior, known = _prior(nodes, usual)
    rows, values, noise_mm, outlying_mm = _equations(outlines, measured, nodes, usual)
    information = 1 / noise_mm**2
    weights = information
    for _ in range(_ROUNDS_BY_POINTS if usual.by_points else _ROUNDS):
        normal = rows.T @ (weights[:, None] * rows) + prior
        solution = np.asarray(np.linalg.solve(normal, rows.T @ (weights * values) + known), float)
        if usual.by_points:
            measured = measured.on_section(nodes, solution[len(nodes) :])
            rows, values, _, _ = _equations(outlines, measured, nodes, usual)
        off = (values - rows @ solution) / outlying_mm
        weights = information / (1 + off**2) ** 2
    count = len(nodes)
    deviation = np.sqrt(np.diag(np.linalg.inv(normal))[:count])
    height = np.split(solution[count:], 3)[0]
    return solution[:count], _hats(nodes, _knots(nodes)) @ height, deviation


def _equations(
    outlines: _Rows, measured: _Rows, nodes: FloatArray, usual: UsualBorder
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return rows (k, unknowns), values, noise and size of an outlier (k,) of all that was seen.

    Of the surface these are its tangents and, unless only its points count, where they touch it.
    """
    touch = np.full(len(outlines.slope), _TOUCH_MM)
    plane = np.full(len(measured.slope), _SURFACE_MM)
    radius = np.where(measured.slope < 0, usual.below_mm[1], usual.above_mm[1])
    place = _SLOPE * radius[: 0 if usual.by_points else None]
    rows = [
        outlines.columns(nodes, _tangents(outlines.slope)),
        measured.columns(nodes, _tangents(measured.slope)),
        measured.columns(nodes, _places(measured.slope))[: len(place)],
    ]
    values = [outlines.distance, measured.distance, measured.height[: len(place)]]
    equations = max(len(plane) + len(place), 1)
    worth = min(1.0, _SURFACE_WORTH * float(np.ptp(nodes)) / equations) ** 0.5
    noise_mm = [_TOUCHES_SHARED**0.5 * touch, plane / worth, place / worth]
    outlying_mm = [np.full(len(touch), _OUTLYING_TOUCH_MM), _OUTLYING * plane, _OUTLYING * place]
    row, value, noise, outlier = map(np.concatenate, (rows, values, noise_mm, outlying_mm))
    return row, value, noise, outlier


def _prior(nodes: FloatArray, usual: UsualBorder) -> tuple[FloatArray, FloatArray]:
    """Return the usual shape as normal equations: of the reaches, the height and the radii."""
    count, bend = len(nodes), float(np.ptp(nodes[:2])) ** 2 / usual.bend_mm
    bends = np.diff(np.eye(count), 2, axis=0) / (_BENDS * bend)
    knots = _knots(nodes)
    apart = (knots[:, None] - knots) / usual.alike_mm
    unlike = np.linalg.inv(np.exp(-(apart**2) / 2) + _UNLIKE * np.eye(len(knots)))
    way = 2 * (knots - nodes.mean()) / np.ptp(nodes)
    along = np.column_stack([way * (way - 1) / 2, 1 - way**2, way * (way + 1) / 2])
    *means, spreads = np.transpose([usual.height_mm, usual.below_mm, usual.above_mm])
    section = scipy.linalg.block_diag(*(unlike / spread**2 for spread in spreads))
    normal = scipy.linalg.block_diag(bends.T @ bends, section)
    known = [bends.T @ np.full(count - 2, -1 / _BENDS), section @ (along @ means).T.ravel()]
    return normal + np.eye(len(normal)) * _NOTHING_MM**-2, np.concatenate(known)


def _knots(nodes: FloatArray) -> FloatArray:
    """Return the places along a border where the section has parameters of its own."""
    return np.linspace(nodes[0], nodes[-1], max(round(float(np.ptp(nodes)) / _KNOTS_MM), 1) + 1)


def _hats(across: FloatArray, nodes: FloatArray) -> FloatArray:
    """Return the shares (k, nodes) of even nodes at some places, linearly between two of them."""
    place = np.clip((across - nodes[0]) / (nodes[1] - nodes[0]), 0.0, len(nodes) - 1.0)
    return np.asarray(np.maximum(1 - np.abs(place[:, None] - np.arange(len(nodes))), 0.0))


def _tangents(slope: FloatArray) -> FloatArray:
    below, above = np.minimum(slope, 0.0), np.maximum(slope, 0.0)
    return np.column_stack([np.ones_like(slope), slope, below**2 / 2, above**2 / 2])


def _places(slope: FloatArray) -> FloatArray:
    below, above = np.minimum(slope, 0.0), np.maximum(slope, 0.0)
    return np.column_stack([np.zeros_like(slope), np.ones_like(slope), below, above])
