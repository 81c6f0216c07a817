"""Raw numbers to millimetres: known values, there and back, and nothing past infinity."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.sensing.disparity import (
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)

FACTORY = FactoryDisparity(1200.0, 1.042, 75.0, 200.0)
BURRUS = LinearInverseDisparity(3.3309495, -0.0030711016)
TANGENT = TangentDisparity(123.6, 2842.5, 1.1863)
MODELS = [FACTORY, BURRUS, TANGENT]


@pytest.mark.parametrize(("raw", "depth_mm"), [(0, 317), (399, 500), (596, 700), (744, 1000)])
def test_factory_formula_gives_the_device_table(raw: int, depth_mm: int) -> None:
    assert int(FACTORY.depth_mm(np.array(float(raw)))) == depth_mm


@pytest.mark.parametrize("model", MODELS)
@given(raw=st.floats(300, 1000))
def test_there_and_back(model: DisparityModel, raw: float) -> None:
    depth = model.depth_mm(np.array([raw]))
    assert model.raw(depth)[0] == pytest.approx(raw, abs=1e-6)


@pytest.mark.parametrize("model", MODELS)
def test_depth_grows_with_raw_and_ends_at_infinity(model: DisparityModel) -> None:
    depth = model.depth_mm(np.arange(2048.0))
    known = np.isfinite(depth)
    last = np.flatnonzero(known).max()
    assert known[: last + 1].all()
    assert (np.diff(depth[: last + 1]) > 0).all()
    assert 1000 < last < 1200


@pytest.mark.parametrize("model", MODELS)
def test_no_reading_stays_none(model: DisparityModel) -> None:
    assert np.isnan(model.depth_mm(np.array([np.nan, 2047.0]))).all()
