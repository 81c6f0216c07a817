from __future__ import annotations

import numpy as np
import pytest

from insole_core.calibration.walls.disparity_fit import (
    fit_linear_inverse,
    fit_tangent,
    linear_inverse_near,
)
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.disparity import (
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)

DEPTH = np.repeat(np.arange(550.0, 1500, 50), 5)


def noisy(raw: FloatArray) -> FloatArray:
    return raw + np.random.default_rng(2).normal(0, 0.1, raw.shape)


def test_linear_inverse_is_found_with_its_deviations() -> None:
    true = LinearInverseDisparity(3.31, -0.00301)
    fit = fit_linear_inverse(noisy(true.raw(DEPTH)), DEPTH)
    assert isinstance(fit.model, LinearInverseDisparity)
    assert abs(fit.model.a - true.a) < 3 * fit.deviations["a"] < 0.01
    assert abs(fit.model.b - true.b) < 3 * fit.deviations["b"] < 1e-5
    assert fit.rms_raw == pytest.approx(0.1, rel=0.2)
    assert fit.range_mm == (550, 1450)


def test_tangent_is_found() -> None:
    true = TangentDisparity(120.0, 2800.0, 1.18)
    fit = fit_tangent(noisy(true.raw(DEPTH)), DEPTH)
    raw = true.raw(np.array([600.0, 900, 1300]))
    assert np.allclose(fit.model.depth_mm(raw), true.depth_mm(raw), rtol=5e-4)
    assert fit.rms_raw == pytest.approx(0.1, rel=0.2)


def test_a_gross_error_hardly_counts() -> None:
    true = LinearInverseDisparity(3.31, -0.00301)
    raw = noisy(true.raw(DEPTH))
    raw[3] += 60
    fit = fit_linear_inverse(raw, DEPTH)
    assert np.allclose(fit.model.depth_mm(true.raw(DEPTH)), DEPTH, rtol=1e-3)


def test_the_factory_numbers_are_a_linear_inverse_model() -> None:
    factory = FactoryDisparity(1200.0, 1.042, 75.0, 200.0)
    raw = np.arange(400.0, 900)
    same = linear_inverse_near(factory, raw)
    assert np.allclose(same.depth_mm(raw), factory.depth_mm(raw), rtol=1e-9)


def test_distances_that_do_not_suffice() -> None:
    raw = np.array([600.0, 601, 602])
    with pytest.raises(CalibrationError, match="2 clearly different distances"):
        fit_linear_inverse(raw, np.array([700.0, 701, 702]))
    with pytest.raises(CalibrationError, match="3 clearly different distances"):
        fit_tangent(raw, np.array([700.0, 701, 900]))


def test_distances_in_another_unit_or_missing() -> None:
    raw = np.array([600.0, 700])
    with pytest.raises(CalibrationError, match="give them in millimetres"):
        fit_linear_inverse(raw, np.array([0.7, 0.9]))
    with pytest.raises(CalibrationError, match="measure the missing"):
        fit_linear_inverse(raw, np.array([700.0, np.nan]))
