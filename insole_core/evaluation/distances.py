"""A known object: all distances between its marked points (thesis 5.5, figures 17 - 19)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray

AXES = ("x", "y", "z", "space")
_ALONG = 0.999
"""Least cosine of a distance that counts as along an axis of the object."""


@dataclass(frozen=True)
class DistanceError:
    """One distance: its two points, its axis, true and measured length."""

    first: str
    second: str
    axis: str
    true_mm: float
    measured_mm: float

    @property
    def error_mm(self) -> float:
        """Measured minus true."""
        return self.measured_mm - self.true_mm

    @property
    def relative(self) -> float:
        """Thesis (23)."""
        return abs(self.error_mm) / self.true_mm


@dataclass(frozen=True)
class ObjectEvaluation:
    """All distances of an object, and their summary in mm."""

    distances: tuple[DistanceError, ...]
    mean_abs_mm: float
    sd_abs_mm: float
    max_abs_mm: float
    mean_relative: float
    mean_abs_by_axis_mm: dict[str, float]


def evaluate_object(
    names: list[str], true_mm: FloatArray, measured_mm: FloatArray
) -> ObjectEvaluation:
    """Compare all distances between the marked points of an object with the true ones.

    Parameters
    ----------
    names
        Of the n points.
    true_mm : (n, 3) float64, mm, the object's own axes
    measured_mm : (n, 3) float64, mm, any frame; NaN for a point that was not seen

    Raises
    ------
    InputError
        If fewer than two points were seen, or the lists differ in length.
    """
    if true_mm.shape != (len(names), 3) or measured_mm.shape != true_mm.shape:
        raise InputError(
            "{names} points are named, but {true_points} true and {measured_points} measured "
            "positions are given; give each point's both positions.",
            names=len(names),
            true_points=len(true_mm),
            measured_points=len(measured_mm),
        )
    seen = np.flatnonzero(np.isfinite(measured_mm).all(axis=1))
    if len(seen) < 2:
        raise InputError("Fewer than two points of the object were measured; mark them again.")
    return summarise(
        DistanceError(
            names[i],
            names[j],
            _axis(true_mm[j] - true_mm[i]),
            float(np.linalg.norm(true_mm[j] - true_mm[i])),
            float(np.linalg.norm(measured_mm[j] - measured_mm[i])),
        )
        for i, j in combinations(seen.tolist(), 2)
    )


def summarise(distances: Iterable[DistanceError]) -> ObjectEvaluation:
    """Summarise distances of one object, or of several positions of it.

    Raises
    ------
    InputError
        If there are none.
    """
    listed = tuple(distances)
    if not listed:
        raise InputError("No distance of the object was measured; mark its points again.")
    size = np.array([abs(d.error_mm) for d in listed])
    return ObjectEvaluation(
        distances=listed,
        mean_abs_mm=float(size.mean()),
        sd_abs_mm=float(size.std()),
        max_abs_mm=float(size.max()),
        mean_relative=float(np.mean([d.relative for d in listed])),
        mean_abs_by_axis_mm={
            axis: float(np.mean([abs(d.error_mm) for d in listed if d.axis == axis]))
            for axis in AXES
            if any(d.axis == axis for d in listed)
        },
    )


def _axis(direction: FloatArray) -> str:
    length = np.linalg.norm(direction)
    if not length > 0:
        raise InputError("Two points of the object have the same true position; correct the list.")
    share = np.abs(direction) / length
    return AXES[int(np.argmax(share))] if share.max() > _ALONG else "space"
