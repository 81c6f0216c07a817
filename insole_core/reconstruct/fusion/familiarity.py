"""How like the learnt surroundings those of a reading are, by their principal components."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import Float32Array

_AXES = 48
_LEARNT, _FOREIGN = 4.0, 9.0
"""Distances, in units of the mean square of the learnt ones, up to which surroundings count as
learnt, and beyond which nothing is said of them: among feet that were held back 3 % exceed the
one, and 0.1 % the other."""


@dataclass(frozen=True, eq=False)
class Familiarity:
    """The distribution of learnt features: its mean and its main directions.

    Parameters
    ----------
    middle : (FEATURES,) float32
    axes : (FEATURES, k) float32
        Orthonormal principal directions.
    variances : (k,) float32
        Along them.
    rest : float
        Mean square of what the directions leave.
    """

    middle: Float32Array
    axes: Float32Array
    variances: Float32Array
    rest: float

    @staticmethod
    def of(blocks: Iterable[Float32Array]) -> Familiarity:
        """Learn the distribution of features, given in blocks (n, FEATURES)."""
        count, total, products = 0, 0.0, 0.0
        for block in blocks:
            values = block.astype(float)
            count += len(values)
            total = total + values.sum(axis=0)
            products = products + values.T @ values
        middle = np.asarray(total) / count
        spread, axes = np.linalg.eigh(np.asarray(products) / count - np.outer(middle, middle))
        rest = float(spread[:-_AXES].sum())
        spread, axes = spread[: -_AXES - 1 : -1], axes[:, : -_AXES - 1 : -1]
        return Familiarity(
            np.asarray(middle, np.float32),
            np.asarray(axes, np.float32),
            np.asarray(spread, np.float32),
            rest,
        )

    def share(self, features: Float32Array) -> Float32Array:
        """Compute how much of a prediction counts.

        Parameters
        ----------
        features : (n, FEATURES) float32

        Returns
        -------
        (n,) float32
            1 in learnt surroundings, 0 in surroundings that are unlike any of them.
        """
        off = features - self.middle
        along = off @ self.axes
        within = (along**2 / self.variances).mean(axis=1)
        beside = ((off**2).sum(axis=1) - (along**2).sum(axis=1)) / np.float32(self.rest)
        distance = np.maximum(within, beside)
        return np.asarray(np.clip((_FOREIGN - distance) / (_FOREIGN - _LEARNT), 0, 1))
