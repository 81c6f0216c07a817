"""The border of a foot seen from above, and the fair closed curve close to it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh_graph import relaxed
from insole_core.geometry.sampling import sample_triangles
from insole_core.insole.primitives.outline_curve import evenly_spread, way_round

_HARMONICS = 16
_POINTS, _WATCHED = 720, slice(None, None, 5)
# Weights relative to the mean squared distance, in mm, of the points from the curve.
_STIFFNESS = 6e-6  # of the third derivative with respect to the phase
_EVENNESS, _STAYING = 1e3, 1e-4  # of uneven speed, and of any change
_HOLDING = 1e6  # of a curvature beyond its limits
_OUTSIDE = 20.0  # of a point that the curve would cut off
_COURSES, _ROUNDS = 3, 6
_BORDER_HEIGHT_MM = 30.0  # higher parts do not widen the outline
_ABOVE_MM = 8.0
_PITCH_MM = 1.0
_SMOOTHINGS = 10
_EVENING_MM = 5.0
_GAP_MM = 24.0  # gaps between toes up to this width are bridged
_CELL_MM = 4.0  # of the flank; the mean of a cell counts, not its outermost point
_DEPTH_MM = 3.0  # thickness of the outer layer of a cell
_LEAST_POINTS = 3
_ROUND = 0.15  # radius of the half circles of the track, as a share of the foot's length


def fair_curve(places: FloatArray, bends_per_mm: FloatArray) -> FloatArray:
    """Fit a closed curve with slowly changing curvature to points.

    The curve is a Fourier series in arc length. Among all curves whose curvature keeps its limits
    it minimises the sum of the squared normal distances and the squared third derivative; a point
    outside the curve weighs more than one inside.

    Parameters
    ----------
    places : (n, 2) float64, mm
        Points in counter-clockwise order; the first is not repeated.
    bends_per_mm : (n, 2) float64, 1/mm
        Least and greatest curvature at each point; negative where the curve is hollow.

    Returns
    -------
    (720, 2) float64, mm
        Counter-clockwise, nearly evenly spaced; starts near the first point.
    """
    rows = _series(way_round(places)[:-1], 0)
    normal = rows.T @ rows / len(rows) + _ENERGY
    series = np.asarray(np.linalg.solve(normal, rows.T @ places / len(rows)), dtype=float)
    for _ in range(_COURSES):
        series = _settled(_Problem.about(_evened(series), places, bends_per_mm))
    return np.asarray(_CURVE.places @ series)


class _Rows(NamedTuple):
    """Matrices that map the series to points of the curve and their derivatives over the phase."""

    places: FloatArray
    slopes: FloatArray
    bends: FloatArray


def _series(phase: FloatArray, derivative: int) -> FloatArray:
    """Return (n, 2 h + 1) cosines and sines of the harmonics, or a derivative; phase 0 to 1."""
    turns = 2 * np.pi * np.arange(1, _HARMONICS + 1)
    angle = np.outer(phase, turns) + derivative * np.pi / 2
    scale = turns**derivative
    constant = np.full((len(phase), 1), float(derivative == 0))
    return np.hstack([constant, np.cos(angle) * scale, np.sin(angle) * scale])


_CURVE = _Rows(*(_series(np.arange(_POINTS) / _POINTS, order) for order in range(3)))
_ENERGY = _STIFFNESS * np.diag(np.r_[0, np.tile(np.arange(1.0, _HARMONICS + 1), 2)] ** 6)


def _evened(series: FloatArray) -> FloatArray:
    """Return the same curve as a series in arc length."""
    spread = evenly_spread(_CURVE.places @ series, _POINTS)
    scale = np.r_[1.0, np.full(2 * _HARMONICS, 2.0)] / _POINTS
    return np.asarray(_CURVE.places.T @ spread * scale[:, None])


@dataclass(frozen=True, eq=False)
class _Problem:
    """The convex problem that remains when directions and speed are taken from a nearby curve.

    The unknowns are the series of both coordinates, one after the other.

    Parameters
    ----------
    start : (u,) float64
        The nearby curve.
    across_rows, across_mm : (n, u), (n,) float64
        Position of the curve, and of the measured points beside it, along the outward normal.
    bend_rows, bends_per_mm : (w, u), (w, 2) float64
        Curvature and its limits.
    even_rows : (w, u) float64
        Speed relative to that of the nearby curve.
    """

    start: FloatArray
    across_rows: FloatArray
    across_mm: FloatArray
    bend_rows: FloatArray
    bends_per_mm: FloatArray
    even_rows: FloatArray

    @classmethod
    def about(cls, near: FloatArray, places: FloatArray, bends_per_mm: FloatArray) -> _Problem:
        """Linearise the problem about a nearby curve, given as a series."""
        curve, slopes = _CURVE.places @ near, _CURVE.slopes @ near
        lengths = np.hypot(*slopes.T)
        along, speed = slopes / lengths[:, None], lengths.mean()
        across = np.column_stack([along[:, 1], -along[:, 0]])
        spot = _nearest(curve, places)
        return cls(
            near.T.ravel(),
            _projected(_CURVE.places[spot], across[spot]),
            (places * across[spot]).sum(axis=1),
            _projected(_CURVE.bends, -across / speed**2)[_WATCHED],
            bends_per_mm[_nearest(places, curve[_WATCHED])],
            _projected(_CURVE.slopes, along / speed)[_WATCHED],
        )


def _settled(problem: _Problem) -> FloatArray:
    """Return the series (m, 2) of the best curve; the active limits are found by iteration."""
    rows, goal, found = problem.across_rows, problem.across_mm, problem.start
    even = problem.even_rows
    fixed = np.kron(np.eye(2), _ENERGY) + _STAYING * np.eye(len(found))
    fixed += _EVENNESS * even.T @ even / len(even)
    towards = _STAYING * found + _EVENNESS * even.mean(axis=0)
    for _ in range(_ROUNDS):
        weight = np.where(rows @ found < goal, _OUTSIDE, 1.0) / len(goal)
        bend = problem.bend_rows @ found
        kept = np.clip(bend, *problem.bends_per_mm.T)
        beyond = bend != kept
        held = _HOLDING * problem.bend_rows[beyond]
        found = np.linalg.solve(
            fixed + rows.T @ (rows * weight[:, None]) + held.T @ problem.bend_rows[beyond],
            towards + rows.T @ (weight * goal) + held.T @ kept[beyond],
        )
    return np.asarray(found.reshape(2, -1).T)


def _projected(rows: FloatArray, direction: FloatArray) -> FloatArray:
    """Return rows for the series of both coordinates, projected on directions (n, 2)."""
    return np.hstack([rows * direction[:, :1], rows * direction[:, 1:]])


def _nearest(among: FloatArray, places: FloatArray) -> IntArray:
    """Return the index of the nearest point of `among` to each of `places`."""
    return np.asarray(scipy.spatial.cKDTree(among).query(places)[1])


@dataclass(frozen=True, eq=False)
class Border:
    """Points around a foot, counter-clockwise from the rear of the heel; medial = +x.

    Parameters
    ----------
    places, outward : (n, 2) float64, mm
        Outermost points of the foot, and the unit direction in which each was sought.
    """

    places: FloatArray
    outward: FloatArray


def foot_border(foot: Foot) -> Border:
    """Find the border of the foot below 30 mm above the ground; cached with the foot."""
    return foot.derived.get("border", (), lambda: _find(foot))


def _find(foot: Foot) -> Border:
    points = _low_points(foot)
    track = _Track(_ROUND * foot.length_mm, foot.length_mm)
    way, distance = track.of(points[:, :2])
    count = round(track.round_mm / _CELL_MM)
    column = np.floor(way / track.round_mm * count).astype(int) % count
    level = np.floor(np.clip(points[:, 2], 0, None) / _CELL_MM).astype(int)
    reach = _outside(column, level, distance, count)
    known = np.flatnonzero(np.isfinite(reach))
    reach = np.interp(np.arange(count), known, reach[known], period=count)
    gap = round(_GAP_MM / _CELL_MM) + 1
    reach = scipy.ndimage.grey_closing(reach, size=(gap,), mode="wrap")
    reach = scipy.ndimage.gaussian_filter1d(reach, _EVENING_MM / _CELL_MM, mode="wrap")
    base, outward = track.at((np.arange(count) + 0.5) / count * track.round_mm)
    return Border(base + reach[:, None] * outward, outward)


def _low_points(foot: Foot) -> FloatArray:
    """Sample points (n, 3) evenly over the lower foot, medial = +x."""
    part = foot.mesh.part(foot.mesh.vertices[:, 2] < _BORDER_HEIGHT_MM + _ABOVE_MM)
    even = replace(part, vertices=relaxed(part, _SMOOTHINGS))
    points = sample_triangles(even, _PITCH_MM).points
    low = points[points[:, 2] < _BORDER_HEIGHT_MM]
    return np.asarray(low * [foot.side.medial_sign, 1.0, 1.0])


def _outside(column: IntArray, level: IntArray, distance: FloatArray, count: int) -> FloatArray:
    """Return how far out each column reaches, (count,): as far as its outermost cell.

    A cell reaches to the mean plus the standard deviation of its outer layer: a vertical flank
    ends at its mean, a sloping surface beyond it.
    """
    levels = int(level.max()) + 1
    cell, cells = column * levels + level, count * levels
    outermost = np.full(cells, -np.inf)
    np.maximum.at(outermost, cell, distance)
    near = distance > outermost[cell] - _DEPTH_MM
    cell, distance = cell[near], distance[near]
    number = np.bincount(cell, minlength=cells)
    mean, square = (
        np.bincount(cell, distance**power, minlength=cells) / np.maximum(number, 1)
        for power in (1, 2)
    )
    std = np.sqrt(np.maximum(square - mean**2, 0.0))
    reach = np.where(number >= _LEAST_POINTS, mean + std, -np.inf)
    return np.asarray(reach.reshape(count, levels).max(axis=1))


@dataclass(frozen=True)
class _Track:
    """A closed track around the middle line of a foot: two straights and two half circles."""

    radius_mm: float
    length_mm: float

    @property
    def _quarter_mm(self) -> float:
        return np.pi / 2 * self.radius_mm

    @property
    def _straight_mm(self) -> float:
        return self.length_mm - 2 * self.radius_mm

    @property
    def round_mm(self) -> float:
        """Length of the track."""
        return 2 * (2 * self._quarter_mm + self._straight_mm)

    def of(self, xy: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the arc length (n,) along the track and the distance (n,) from the middle line.

        The arc length starts at the rear and runs over +x.
        """
        x, y = xy.T
        along = np.clip(y - self.radius_mm, 0, self._straight_mm)
        ahead = y - self.radius_mm - along
        angle = np.arctan2(np.abs(x), -ahead)
        way = along + angle * self.radius_mm
        return np.where(x < 0, self.round_mm - way, way), np.hypot(x, ahead)

    def at(self, way: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return points (n, 2) of the middle line, and the unit outward directions there."""
        half = np.minimum(way, self.round_mm - way)
        along = np.clip(half - self._quarter_mm, 0, self._straight_mm)
        angle = (half - along) / self.radius_mm
        side = np.where(way > self.round_mm / 2, -1.0, 1.0)
        base = np.column_stack([np.zeros_like(along), self.radius_mm + along])
        return base, np.column_stack([side * np.sin(angle), -np.cos(angle)])
