"""How far measures and surface scatter when the same foot is captured, taken off and put back.

The captures have no truth: what they have in common by a wrong calibration does not show. The
± of a measure is Student's t for the captures times their standard deviation: in 95 of 100 cases
one further capture lies no farther from the mean of many.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.compare.best_fit import best_fit
from insole_core.compare.seen_surface import Grid, SeenMesh, grid_over
from insole_core.errors import CalibrationError
from insole_core.foot.foot import Foot
from insole_core.foot.measures import DEFINITIONS, SIZES, Measured
from insole_core.geometry.arrays import FloatArray
from insole_core.progress import SILENT, Progress

LEAST_CAPTURES, MOST_CAPTURES = 3, 10
_DOWN = np.array([0.0, 0.0, -1.0])
_PITCH_MM = 2.0
_APART_MM, _LONGER_SHARE = 0.7, 0.025
"""Median distance of two soles laid on each other, and share by which one foot is longer: more is
seen in no two captures of one foot (0.21 to 0.26 mm), but in those of two (0.8 mm, or 8 %)."""


@dataclass(frozen=True, eq=False)
class RepeatedCapture:
    """A foot as one of the captures shows it."""

    name: str
    foot: Foot
    measures: Measured


@dataclass(frozen=True)
class Repeated:
    """How one measure scattered, in its unit.

    Parameters
    ----------
    deviation
        Standard deviation over the captures.
    limits_95
        Half of the limits within which 95 % of further captures lie about the mean of many.
    captures
        That have the measure.
    """

    deviation: float
    limits_95: float
    captures: int


@dataclass(frozen=True, eq=False)
class RepeatEvaluation:
    """What the captures of a repeat test have shown.

    Parameters
    ----------
    captures
    measures
        Of those that at least three captures have, without the sizes, which follow the length.
    grid
        In the frame of the first capture's foot.
    deviation_mm : (rows, columns) float64
        Standard deviation of the height of the sole, each laid on the first capture by its best
        fit; NaN where fewer than three show it.
    """

    captures: tuple[RepeatedCapture, ...]
    measures: Mapping[str, Repeated]
    grid: Grid
    deviation_mm: FloatArray

    def values(self, name: str) -> FloatArray:
        """Return a measure of all captures that have it."""
        found = (capture.measures.get(name) for capture in self.captures)
        return np.array([value for value in found if value is not None])


def evaluate_repeat(
    captures: Sequence[RepeatedCapture], progress: Progress = SILENT
) -> RepeatEvaluation:
    """Compare the captures of one foot with each other.

    Parameters
    ----------
    captures
        At least three, of one side.

    Raises
    ------
    CalibrationError
        When two of them show two different feet.
    Cancelled
    """
    first = captures[0]
    grid = grid_over(first.foot.mesh, _PITCH_MM)
    laid = [SeenMesh(first.foot.mesh).heights(grid, from_above=False)]
    for capture, part in zip(captures[1:], progress.parts(len(captures) - 1), strict=True):
        part.step(0.0, "Laying {name} on {first}", name=capture.name, first=first.name)
        heights = _laid_on(first, capture, grid)
        _check_same(first, capture, heights - laid[0])
        laid.append(heights)
    measures = {}
    for name in DEFINITIONS:
        values = [v for capture in captures if (v := capture.measures.get(name)) is not None]
        if name not in SIZES and len(values) >= LEAST_CAPTURES:
            measures[name] = scatter(np.array(values))
    return RepeatEvaluation(tuple(captures), measures, grid, _deviation(np.array(laid)))


def scatter(values: FloatArray) -> Repeated:
    """Return how values scatter.

    Parameters
    ----------
    values : (n,) float64
        At least two.
    """
    deviation, count = float(values.std(ddof=1)), len(values)
    return Repeated(deviation, float(scipy.stats.t.ppf(0.975, count - 1)) * deviation, count)


def _laid_on(first: RepeatedCapture, other: RepeatedCapture, grid: Grid) -> FloatArray:
    """Return the heights of a sole on the pixels of the first one, by the best fit."""
    target, moved = (SeenMesh(one.foot.mesh).points(_DOWN, _PITCH_MM) for one in (first, other))
    fit = best_fit(target, moved)
    if fit is None:
        raise CalibrationError(
            "{first} and {other} do not show the same foot: their soles do not fit each other.",
            first=first.name,
            other=other.name,
        )
    return SeenMesh(other.foot.mesh).heights(grid, from_above=False, mesh2grid=fit.b2a)


def _check_same(first: RepeatedCapture, other: RepeatedCapture, apart_mm: FloatArray) -> None:
    """Check that two captures show one foot: by their soles, and by their lengths."""
    mine, theirs = (one.measures.get("foot_length") for one in (first, other))
    longer_mm = 0.0 if mine is None or theirs is None else abs(mine - theirs)
    median_mm = float(np.nanmedian(np.abs(apart_mm)))
    if median_mm > _APART_MM or longer_mm > _LONGER_SHARE * first.foot.length_mm:
        raise CalibrationError(
            "{first} and {other} show two different feet, or one that was held quite differently: "
            "their soles lie {apart_mm:.1f} mm apart, and one is {longer_mm:.1f} mm longer; take "
            "the same foot of the same person, or the same cast, each time.",
            first=first.name,
            other=other.name,
            apart_mm=median_mm,
            longer_mm=longer_mm,
        )


def _deviation(laid_mm: FloatArray) -> FloatArray:
    known = np.isfinite(laid_mm).sum(axis=0) >= LEAST_CAPTURES
    deviation = np.full(known.shape, np.nan)
    deviation[known] = np.nanstd(laid_mm[:, known], axis=0, ddof=1)
    return deviation
