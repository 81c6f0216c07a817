from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.weighted import outermost_mean, weighted_quantile


def test_a_weight_counts_like_repetitions() -> None:
    values, times = np.array([3.0, 1.0, 7.0]), np.array([100.0, 200.0, 100.0])
    for share in (0.1, 0.3, 0.62, 0.9):
        repeated = np.repeat(values, times.astype(int))
        expected = float(np.quantile(repeated, share))
        assert weighted_quantile(values, times, share) == pytest.approx(expected, abs=2.0)
    assert weighted_quantile(values, np.ones(3), 0.5) == pytest.approx(3.0)


def test_the_outermost_weight_is_averaged() -> None:
    values, weights = np.array([0.0, 9.6, 10.0, 9.8]), np.array([5.0, 1.0, 1.0, 2.0])
    assert outermost_mean(values, weights, 1.0) == pytest.approx(10.0)
    assert outermost_mean(values, weights, 2.0) == pytest.approx(9.9)
    assert outermost_mean(values, weights, 3.5) == pytest.approx((10.0 + 19.6 + 4.8) / 3.5)
    assert outermost_mean(values, weights, 100.0) == pytest.approx(values @ weights / 9)
