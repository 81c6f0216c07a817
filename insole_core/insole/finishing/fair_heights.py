"""The nearest heights along a closed edge that nowhere bend sharply."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import gcd

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray, IntArray

STEP_MM = 5.0
MOST_BEND_MM = 0.36
"""Greatest second difference of a rim in steps of 5 mm; 0.4 is asked of the finished surface."""
_START = 30.0  # of the multipliers; those of a rim are between 1 and some thousands
_TO_BOUND = 0.99  # share of the way to the nearest bound that a round goes
_ROUNDS = 60  # random rims take 8 to 15
_NEARNESS_MM = 2e-3
"""Root mean square distance from the nearest fair heights at which the search ends."""
_BAND = 5  # a second difference's square links two neighbours on either side, folded four


def fair_heights(height_mm: FloatArray, step_mm: float) -> FloatArray:
    """Return the heights nearest to the given ones whose second difference is limited.

    The least squares problem with bounds is solved by a primal-dual interior point method (Boyd &
    Vandenberghe 2004, section 11.7). It begins with level heights and never leaves the bounds, so
    that the limit holds whenever it ends.

    Parameters
    ----------
    height_mm : (n,) float64
        At evenly spaced points of a closed curve, `step_mm` apart.

    Returns
    -------
    (n,) float64, mm
        The given heights to the bit, if they are fair.
    """
    lag = max(1, round(STEP_MM / step_mm))
    most_mm = MOST_BEND_MM * (lag * step_mm / STEP_MM) ** 2
    rings = _rings(len(height_mm), lag)
    wanted = height_mm[rings]
    if np.abs(_second_difference(wanted)).max() <= most_mm:
        return height_mm
    fair = np.empty_like(height_mm)
    fair[rings] = _nearest_within(wanted, most_mm)
    return fair


def _rings(count: int, lag: int) -> IntArray:
    """Return the points (g, m) in rings whose neighbours lie `lag` points apart."""
    number = gcd(count, lag)
    return (np.arange(number)[:, None] + lag * np.arange(count // number)) % count


def _nearest_within(wanted: FloatArray, most: float) -> FloatArray:
    """Return the nearest values (g, m) whose second difference along the rings is at most `most`.

    Either bound has a slack and a multiplier, whose product is driven to zero (Mehrotra 1992).
    """
    least_gap = wanted.size * _NEARNESS_MM**2 / 2
    values = np.full_like(wanted, wanted.mean())
    slack = np.full((2, *wanted.shape), most)
    multiplier = np.full_like(slack, _START)
    system = _RingSystem.of(*wanted.shape)
    for _ in range(_ROUNDS):
        gap = float((multiplier * slack).sum())
        missing = wanted - values
        off = missing - _second_difference(multiplier[0] - multiplier[1])
        if gap <= least_gap and np.abs(off).max() <= _NEARNESS_MM:
            break
        stiffness = multiplier / slack
        solve = system.solver(stiffness[0] + stiffness[1])
        _, slack_step, multiplier_step = _step(solve, missing, slack, multiplier, 0.0)
        ahead = slack + _way(slack, slack_step) * slack_step
        ahead *= multiplier + _way(multiplier, multiplier_step) * multiplier_step
        aim = (float(ahead.sum()) / gap) ** 3 * gap / slack.size - slack_step * multiplier_step
        step, slack_step, multiplier_step = _step(solve, missing, slack, multiplier, aim)
        way = _TO_BOUND * min(_way(slack, slack_step), _way(multiplier, multiplier_step))
        values += way * step
        slack += way * slack_step
        multiplier += way * multiplier_step
    return values


def _step(
    solve: Callable[[FloatArray], FloatArray],
    missing: FloatArray,
    slack: FloatArray,
    multiplier: FloatArray,
    product: FloatArray | float,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return Newton's steps of values, slacks and multipliers to a product of the latter two."""
    aim = product / slack
    pull = _second_difference(aim[0] - aim[1])
    step = solve(missing - pull)
    bend = _second_difference(step)
    slack_step = np.stack([-bend, bend])
    return step, slack_step, aim - multiplier - multiplier / slack * slack_step


def _way(positive: FloatArray, step: FloatArray) -> float:
    """Return the share of a step, at most 1, in which no value becomes negative."""
    return 1.0 / max(1.0, -float((step / positive).min()))


@dataclass(frozen=True, eq=False)
class _RingSystem:
    """The matrix 1 + D' W D on rings, with D the second difference and W diagonal.

    A ring is folded flat, so that the matrix is banded: its points are numbered from both ends.

    Parameters
    ----------
    place : (g, m) int64
        Of each point in the folded order.
    entries : (2, g, m) int64
        Indices into the raveled lower band of the entries that link each point with the next and
        with the one after it.
    """

    place: IntArray
    entries: IntArray

    @classmethod
    def of(cls, number: int, count: int) -> _RingSystem:
        index = np.arange(count)
        ring = np.minimum(2 * index, 2 * (count - index) - 1)
        place = ring + count * np.arange(number)[:, None]
        others = np.stack([np.roll(place, -1, axis=1), np.roll(place, -2, axis=1)])
        entries = np.abs(others - place) * place.size + np.minimum(others, place)
        return cls(place, entries)

    def solver(self, stiffness: FloatArray) -> Callable[[FloatArray], FloatArray]:
        """Factorise the matrix for stiffnesses (g, m) > 0, and return what solves it."""
        around = _around(stiffness)
        before, after = around[..., :-2], around[..., 2:]
        band = np.zeros((_BAND, stiffness.size))
        band[0, self.place] = 1 + before + 4 * stiffness + after
        entries = band.reshape(-1)
        entries[self.entries[0]] = -2 * (stiffness + after)
        entries[self.entries[1]] = after
        factor = scipy.linalg.cholesky_banded(
            band, overwrite_ab=True, lower=True, check_finite=False
        )

        def solve(right: FloatArray) -> FloatArray:
            folded = np.empty(right.size)
            folded[self.place] = right
            solved = scipy.linalg.cho_solve_banded(
                (factor, True), folded, overwrite_b=True, check_finite=False
            )
            return np.asarray(solved[self.place])

        return solve


def _second_difference(values: FloatArray) -> FloatArray:
    """Return the second difference (g, m) along rings."""
    around = _around(values)
    return np.asarray(around[..., :-2] - 2 * values + around[..., 2:])


def _around(values: FloatArray) -> FloatArray:
    """Return values (g, m + 2) of rings with their last point before the first, and vice versa."""
    return np.concatenate([values[..., -1:], values, values[..., :1]], axis=-1)
