"""Nonlinear least squares with the standard deviation of every unknown.

Not `scipy.optimize.least_squares`: on these problems it is 2 to 5 times slower, with a dense or a
sparse Jacobian (with its default regularisation hundreds of times, and short of the minimum), and
from the usual start of a tangent model it ends beside the minimum.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid

_STEP = 1e-5
_TOLERANCE = 1e-9
_STEPS = 60
_DAMPING = 1e-4
_MOST_DAMPING = 1e9


@dataclass(frozen=True, eq=False)
class Adjustment:
    """The result of a least squares fit.

    Parameters
    ----------
    values, std : (n,) float64
        The unknowns and their standard deviations.
    residuals : (m,) float64
    """

    values: FloatArray
    std: FloatArray
    residuals: FloatArray

    @property
    def sigma(self) -> float:
        """Standard deviation of one residual, corrected for the degrees of freedom."""
        free = max(len(self.residuals) - len(self.values), 1)
        return float(np.sqrt((self.residuals**2).sum() / free))


def least_squares(
    fun: Callable[[FloatArray], FloatArray],
    start: FloatArray,
    blocks: Blocks | None = None,
    robust: float | None = None,
) -> Adjustment:
    """Minimise the squared residuals (Levenberg and Marquardt).

    Parameters
    ----------
    fun
        Maps unknowns (n,) to residuals (m,).
    start : (n,) float64
    blocks, optional
        Which residuals depend on which unknowns; saves most evaluations.
    robust, optional
        Residuals beyond this count linearly only (Huber).

    Returns
    -------
    Adjustment
        Standard deviations are scaled by the weighted residuals.
    """
    blocks = blocks or Blocks((len(fun(start)),), len(start), 0)
    unknowns, residuals = np.asarray(start, dtype=float), fun(start)
    damping = _DAMPING
    for _ in range(_STEPS):
        weight = huber_weight(residuals, robust)
        jacobian = blocks.jacobian(fun, unknowns)
        normal = jacobian.T @ (weight[:, None] * jacobian)
        rhs = jacobian.T @ (weight * residuals)
        before = _cost(residuals, robust)
        while True:
            damped = normal + damping * np.diag(np.diag(normal) + 1e-12)
            trial = unknowns - np.linalg.solve(damped, rhs)
            trial_residuals = fun(trial)
            better = _cost(trial_residuals, robust) < before
            if better or damping > _MOST_DAMPING:
                break
            damping *= 10
        if not better:
            break
        unknowns, residuals, damping = trial, trial_residuals, damping / 10
        if _cost(residuals, robust) > before * (1 - _TOLERANCE):
            break
    return _judged(unknowns, residuals, blocks.jacobian(fun, unknowns), robust)


def _judged(
    unknowns: FloatArray, residuals: FloatArray, jacobian: FloatArray, robust: float | None
) -> Adjustment:
    weight = huber_weight(residuals, robust)
    # Scaled to a unit diagonal, so that rad, mm and px can be inverted together.
    scale = np.sqrt((weight[:, None] * jacobian**2).sum(0)) + 1e-12
    scaled = jacobian / scale
    inverse = np.linalg.pinv(scaled.T @ (weight[:, None] * scaled), rcond=1e-13, hermitian=True)
    variance = (weight * residuals**2).sum() / max(len(residuals) - len(unknowns), 1)
    std = np.sqrt(np.maximum(np.diag(inverse), 0) * variance) / scale
    return Adjustment(unknowns, std, residuals)


def huber_weight(residuals: FloatArray, robust: float | None) -> FloatArray:
    """Return the Huber weight of each residual: 1 up to `robust` in size, less beyond it."""
    if robust is None:
        return np.ones_like(residuals)
    return np.asarray(robust / np.maximum(np.abs(residuals), robust))


def _cost(residuals: FloatArray, robust: float | None) -> float:
    if robust is None:
        return float((residuals**2).sum())
    size = np.abs(residuals)
    return float(np.where(size <= robust, size**2, robust * (2 * size - robust)).sum())


@dataclass(frozen=True)
class Blocks:
    """The block structure of the Jacobian: which residuals depend on which unknowns.

    The first `shared` unknowns act on all residuals; after them, every `own` unknowns (six of a
    pose) act on one block of residuals alone.

    Parameters
    ----------
    lengths
        Number of residuals in each block.
    """

    lengths: tuple[int, ...]
    shared: int
    own: int = 6

    def jacobian(self, fun: Callable[[FloatArray], FloatArray], unknowns: FloatArray) -> FloatArray:
        """Differentiate by central differences, the same unknown of all blocks at once.

        Parameters
        ----------
        fun
            Maps unknowns (n,) to residuals (m,).
        unknowns : (n,) float64

        Returns
        -------
        (m, n) float64
        """
        jacobian = np.zeros((sum(self.lengths), len(unknowns)))
        step = _STEP * np.maximum(np.abs(unknowns), 1e-2)
        for column in range(self.shared):
            jacobian[:, column] = _slope(fun, unknowns, step, [column])
        ends = np.cumsum(self.lengths).tolist()
        for number in range(self.own):
            columns = self.shared + number + self.own * np.arange(len(self.lengths))
            change = _slope(fun, unknowns, step, columns.tolist(), per_unit=False)
            for end, length, column in zip(ends, self.lengths, columns.tolist(), strict=True):
                rows = slice(end - length, end)
                jacobian[rows, column] = change[rows] / (2 * step[column])
        return jacobian


def _slope(
    fun: Callable[[FloatArray], FloatArray],
    unknowns: FloatArray,
    step: FloatArray,
    columns: list[int],
    per_unit: bool = True,
) -> FloatArray:
    """Return the central difference of the residuals when some unknowns move by one step."""
    move = np.zeros_like(unknowns)
    move[columns] = step[columns]
    change = fun(unknowns + move) - fun(unknowns - move)
    return np.asarray(change / (2 * step[columns[0]]) if per_unit else change)


def pose(vector: FloatArray) -> FloatArray:
    """Return the transform (4, 4) of a rotation vector (rad) and a translation (mm), (6,)."""
    return rigid(cv2.Rodrigues(np.asarray(vector[:3], dtype=float))[0], vector[3:6])


def pose_vector(a2b: FloatArray) -> FloatArray:
    """Return the rotation vector (rad) and the translation (mm), (6,), of a transform (4, 4)."""
    return np.concatenate([cv2.Rodrigues(a2b[:3, :3])[0].ravel(), a2b[:3, 3]])
