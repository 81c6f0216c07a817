"""A fair closed curve about measured places: as a shoemaker draws it, without wiggles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.insole.outline.outline_curve import evenly_spread, way_round

_HARMONICS = 16
_POINTS, _WATCHED = 720, slice(None, None, 5)

# Weights against the mean square, in mm, of the distances of the places from the curve.
_STIFFNESS = 6e-6  # of the third derivative over a turn
_EVENNESS, _STAYING = 1e3, 1e-4  # of an uneven speed, and of every change
_HOLDING = 1e6  # of a bend beyond its limits
_OUTSIDE = 20.0  # of a place that the curve would cut off

_COURSES, _ROUNDS = 3, 6


def fair_curve(places: FloatArray, bends_per_mm: FloatArray) -> FloatArray:
    """Lay a curve with slowly changing curvature about places.

    The curve is a Fourier series of the place over the way along it. Of all whose curvature keeps
    its limits it has the least squares of the distances across it and of the third derivative;
    a place that it would cut off counts more than one that it leaves inside.

    Parameters
    ----------
    places : (n, 2) float64, mm
        In order, counter-clockwise; the first is not repeated.
    bends_per_mm : (n, 2) float64
        The least and the greatest curvature at each place; below zero it bends inwards.

    Returns
    -------
    (720, 2) float64, mm
        Counter-clockwise, nearly evenly spread; begins beside the first place.
    """
    rows = _series(way_round(places)[:-1], 0)
    normal = rows.T @ rows / len(rows) + _ENERGY
    series = np.asarray(np.linalg.solve(normal, rows.T @ places / len(rows)), dtype=float)
    for _ in range(_COURSES):
        series = _settled(_Problem.about(_evened(series), places, bends_per_mm))
    return np.asarray(_CURVE.places @ series)


class _Rows(NamedTuple):
    """What gives, times the series, places of the curve, and derivatives over a turn."""

    places: FloatArray
    slopes: FloatArray
    bends: FloatArray


def _series(phase: FloatArray, derivative: int) -> FloatArray:
    """(n, 2 h + 1) cosines and sines of whole turns, or a derivative of them; phase 0 to 1."""
    turns = 2 * np.pi * np.arange(1, _HARMONICS + 1)
    angle = np.outer(phase, turns) + derivative * np.pi / 2
    scale = turns**derivative
    constant = np.full((len(phase), 1), float(derivative == 0))
    return np.hstack([constant, np.cos(angle) * scale, np.sin(angle) * scale])


_CURVE = _Rows(*(_series(np.arange(_POINTS) / _POINTS, order) for order in range(3)))
_ENERGY = _STIFFNESS * np.diag(np.r_[0, np.tile(np.arange(1.0, _HARMONICS + 1), 2)] ** 6)


def _evened(series: FloatArray) -> FloatArray:
    """The same curve as a series over the way along it."""
    spread = evenly_spread(_CURVE.places @ series, _POINTS)
    scale = np.r_[1.0, np.full(2 * _HARMONICS, 2.0)] / _POINTS
    return np.asarray(_CURVE.places.T @ spread * scale[:, None])


@dataclass(frozen=True, eq=False)
class _Problem:
    """The convex problem that is left when directions and speed of a near curve are taken as given.

    Unknown are the series of both coordinates, one behind the other.

    Parameters
    ----------
    start : (u,) float64
        The near curve.
    across_rows, across_mm : (n, u), (n,) float64
        Places of the curve beside the measured ones, and those, along the outward direction.
    bend_rows, bends_per_mm : (w, u), (w, 2) float64
        Curvature, and its limits.
    even_rows : (w, u) float64
        Speed against that of the near curve.
    """

    start: FloatArray
    across_rows: FloatArray
    across_mm: FloatArray
    bend_rows: FloatArray
    bends_per_mm: FloatArray
    even_rows: FloatArray

    @classmethod
    def about(cls, near: FloatArray, places: FloatArray, bends_per_mm: FloatArray) -> _Problem:
        """The problem about a near curve, given as a series."""
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
    """The series (m, 2) of the best curve; which limits hold is found by trying."""
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
    """Rows for the series of both coordinates: what they give along directions (n, 2)."""
    return np.hstack([rows * direction[:, :1], rows * direction[:, 1:]])


def _nearest(among: FloatArray, places: FloatArray) -> IntArray:
    """Index of the nearest of `among` to each place."""
    return np.asarray(cKDTree(among).query(places)[1])
