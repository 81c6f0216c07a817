"""Where a round end of a foot lies, such as that of a toe or of the heel, with its uncertainty.

A round end is described by its support function: the distance H of the tangent plane whose normal
has the slopes a across and b upwards against the direction of the end,

    H(a, b) = reach + across a + height b + bend f(a) + twist a b + below f(b₋) + above f(b₊)

with f(s) = √(1 + s²) − 1, whose second derivative is a radius: of the outline seen from below
(bend), and of the upright section below and above the end, where b is negative (b₋) and positive
(b₊): a heel is round below and nearly straight above. It is linear in its parameters, so tangent
planes (outlines in pictures, the surface), the places where the surface touches them, and the usual
radii form one least-squares problem, whose covariance gives the uncertainty. Of an outline only the
plane counts; where along its ray it touches the foot is known no better than the surface.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.foot.outermost import Border
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import ContourConstraints

_LEAST_TOWARDS = 0.5  # cosine against the direction of the planes that count
_ASIDE = 0.6  # slope across up to which planes count less and less
_DEPTH_MM = 8.0  # to either side of the end, beyond which nothing belongs to it
_TOUCH_MM, _TOUCHES_SHARED = 0.2, 2.0  # noise of a contour, and how many points share it
_OUTLYING_TOUCH_MM, _OUTLYING = 1.0, 2.0
_PATCH_MM2 = 25.0  # over which the noise of the surface is the same
_TWIST = 0.3  # usual twist, in shares of the bend
_ROUNDS = 8
_NOTHING_MM = 1e4


@dataclass(frozen=True)
class UsualEnd:
    """Height of an end, radii of its outline and of its section: mean and deviation, mm each."""

    height_mm: tuple[float, float]
    bend_mm: tuple[float, float]
    below_mm: tuple[float, float]
    above_mm: tuple[float, float]

    def scaled(self, factor: float) -> UsualEnd:
        """Scale all lengths, for a foot of another size."""
        return UsualEnd(
            *(
                (factor * value, factor * spread)
                for value, spread in (self.height_mm, self.bend_mm, self.below_mm, self.above_mm)
            )
        )

    def raised(self, by_mm: float) -> UsualEnd:
        """Move it upwards."""
        height, spread = self.height_mm
        return replace(self, height_mm=(height + by_mm, spread))


@dataclass(frozen=True, eq=False)
class RoundEnd:
    """A fitted end.

    Parameters
    ----------
    reach_mm, across_mm, height_mm
        The outermost point: along the direction, across it, and upwards.
    bend_mm
        Radius of the outline there.
    deviations_mm : (3,) float64
        Standard deviations of the point.
    touched
        Total weight of the outlines that determine it.
    """

    reach_mm: float
    across_mm: float
    height_mm: float
    bend_mm: float
    deviations_mm: FloatArray
    touched: float

    def reach_at(self, across_mm: float) -> float:
        """Return how far the outline reaches beside its end."""
        beside = min(abs(across_mm - self.across_mm), abs(self.bend_mm))
        back = self.bend_mm - np.sign(self.bend_mm) * np.sqrt(self.bend_mm**2 - beside**2)
        return float(self.reach_mm - back)


@dataclass(frozen=True)
class SurfaceTrust:
    """Noise of a patch of a measured surface, and the slope upwards of planes that count at most.

    The noise is that of its planes, and of the places where they touch it.
    """

    plane_mm: float
    place_mm: float
    steepest: float


ALONE = SurfaceTrust(0.5, 0.8, 1.5)
BESIDE_OUTLINES = SurfaceTrust(0.8, 2.0, 0.9)
"""Near its rim, where a surface is continued towards the outlines."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was seen of an end, mm: its surface, and the outlines about it if there are any."""

    surface: Border
    touches: ContourConstraints | None


def fit_round_end(
    seen: Evidence,
    direction: FloatArray,
    start: FloatArray,
    half_mm: float,
    usual: UsualEnd,
) -> RoundEnd:
    """Fit a round end to outlines and surface near it.

    Parameters
    ----------
    seen
    direction : (3,) float64
        Along an axis of the frame, horizontal.
    start : (3,) float64, mm
        About where the end lies.
    half_mm
        How far to either side of the end it is round.
    usual
        The prior.

    Returns
    -------
    RoundEnd
    """
    surface, touches = seen.surface, seen.touches
    trust = ALONE if touches is None else BESIDE_OUTLINES
    measured = _Planes.of(surface.points, surface.normals, direction)
    outlines = None if touches is None else _Planes.of(touches.points, touches.normals, direction)
    shares = surface.area_mm2[measured.index] / _PATCH_MM2
    twist = 0.0, _TWIST * usual.bend_mm[0]
    means = np.array([usual.height_mm, usual.bend_mm, twist, usual.below_mm, usual.above_mm])
    place = start @ direction, start @ np.abs(direction[[1, 0, 2]])
    known = np.array([*place, *means[:, 0]])
    prior = np.diag(np.array([_NOTHING_MM, _NOTHING_MM, *means[:, 1]]) ** -2.0)
    solution, touched = known, 0.0
    for number in range(_ROUNDS):
        system = _System(solution, number > 0)
        weights = measured.window(solution, half_mm, trust.steepest) * shares
        system.add(measured.tangents(), measured.distance, weights, trust.plane_mm)
        for rows, values in measured.places():
            system.add(rows, values, weights, trust.place_mm)
        if outlines is not None:
            weights = outlines.window(solution, half_mm, trust.steepest)
            touched = float(weights.sum())
            system.add(
                outlines.tangents(),
                outlines.distance,
                weights / _TOUCHES_SHARED,
                _TOUCH_MM,
                _OUTLYING_TOUCH_MM,
            )
        normal = system.normal + prior
        solution = np.linalg.solve(normal, system.right + prior @ known)
    deviations = np.sqrt(np.diag(np.linalg.inv(normal)))[:3]
    reach, across, height, bend = (float(value) for value in solution[:4])
    return RoundEnd(reach, across, height, bend, deviations, touched)


class _System:
    """Normal equations of robust least squares (Geman & McClure) about a solution."""

    def __init__(self, solution: FloatArray, is_robust: bool) -> None:
        count = len(solution)
        self._solution, self._is_robust = solution, is_robust
        self.normal, self.right = np.zeros((count, count)), np.zeros(count)

    def add(
        self,
        rows: FloatArray,
        values: FloatArray,
        weights: FloatArray,
        noise_mm: float,
        outlying_mm: float | None = None,
    ) -> None:
        information = weights / noise_mm**2
        if self._is_robust:
            off = (values - rows @ self._solution) / (outlying_mm or _OUTLYING * noise_mm)
            information = information / (1 + off**2) ** 2
        self.normal += rows.T @ (information[:, None] * rows)
        self.right += rows.T @ (information * values)


@dataclass(frozen=True, eq=False)
class _Planes:
    """Tangent planes: slopes, distance, and where the surface touches them."""

    index: IntArray
    aside: FloatArray
    upwards: FloatArray
    distance: FloatArray
    along: FloatArray
    across: FloatArray
    height: FloatArray

    @staticmethod
    def of(points: FloatArray, normals: FloatArray, direction: FloatArray) -> _Planes:
        beside = np.abs(direction[[1, 0, 2]])
        towards = normals @ direction
        index = np.flatnonzero(towards > _LEAST_TOWARDS)
        points, normals, towards = points[index], normals[index], towards[index]
        distance = np.einsum("kc,kc->k", points, normals) / towards
        aside, upwards = normals @ beside / towards, normals[:, 2] / towards
        return _Planes(
            index, aside, upwards, distance, points @ direction, points @ beside, points[:, 2]
        )

    def window(self, solution: FloatArray, half_mm: float, steepest: float) -> FloatArray:
        beside = (self.across - solution[1]) / half_mm
        shares = [beside, self.aside / _ASIDE, self.upwards / steepest]
        near = np.abs(self.along - solution[0]) < _DEPTH_MM
        return np.asarray(near * np.prod([np.maximum(1 - s**2, 0) ** 2 for s in shares], axis=0))

    def tangents(self) -> FloatArray:
        a, b = self.aside, self.upwards
        return np.column_stack([np.ones_like(a), a, b, _arc(a), a * b, *map(_arc, _halves(b))])

    def places(self) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]:
        """Return rows and values of the places across and of the heights: the derivatives of H."""
        a, b = self.aside, self.upwards
        none, one = np.zeros_like(a), np.ones_like(a)
        across = np.column_stack([none, one, none, _arc_slope(a), b, none, none])
        upwards = np.column_stack([none, none, one, none, a, *map(_arc_slope, _halves(b))])
        return (across, self.across), (upwards, self.height)


def _halves(slope: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.minimum(slope, 0.0), np.maximum(slope, 0.0)


def _arc(slope: FloatArray) -> FloatArray:
    return np.asarray(np.hypot(1.0, slope) - 1.0)


def _arc_slope(slope: FloatArray) -> FloatArray:
    return np.asarray(slope / np.hypot(1.0, slope))
