"""Statistics of values that stand for areas."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray


def weighted_quantile(values: FloatArray, weights: FloatArray, share: float) -> float:
    """Return the value that a share of the weight does not exceed.

    Parameters
    ----------
    values, weights : (n,) float64
        n > 0; the weights are positive.
    share
        0 to 1.
    """
    order = np.argsort(values)
    reached = np.cumsum(weights[order])
    middle = reached - weights[order] / 2
    return float(np.interp(share * reached[-1], middle, values[order]))


def outermost_mean(values: FloatArray, weights: FloatArray, total: float) -> float:
    """Return the mean of the greatest values, as many as have a total weight.

    Parameters
    ----------
    values, weights : (n,) float64
        n > 0; the weights are positive.
    total
        Weight of the values that count; all of them when they weigh less.
    """
    most = values.max()
    near = values > most - 1.0
    if weights[near].sum() < total:
        near = np.ones(len(values), dtype=bool)
    order = np.argsort(values[near])[::-1]
    ordered = weights[near][order]
    counted = np.clip(total - (np.cumsum(ordered) - ordered), 0.0, ordered)
    return float(counted @ values[near][order] / counted.sum())
