"""A fair closed curve close to measured points: with slowly changing curvature, without wiggles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.insole.primitives.outline_curve import evenly_spread, way_round

_HARMONICS = 16
_POINTS, _WATCHED = 720, slice(None, None, 5)

# Weights relative to the mean squared distance, in mm, of the points from the curve.
_STIFFNESS = 6e-6  # of the third derivative with respect to the phase
_EVENNESS, _STAYING = 1e3, 1e-4  # of uneven speed, and of any change
_HOLDING = 1e6  # of a curvature beyond its limits
_OUTSIDE = 20.0  # of a point that the curve would cut off

_COURSES, _ROUNDS = 3, 6


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
