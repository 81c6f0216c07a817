"""What is foretold of the matching's error, on things whose truth is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.matching_error import (
    MatchingModel,
    matching_error,
    without_matching_error,
)
from insole_core.reconstruct.fusion.neighbourhood import FEATURES, mirrored, neighbourhoods
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.block_matching import record_matched_depth
from insole_core.simulate.device import make_device
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.poses import look_at
from insole_core.simulate.scene import SceneCaster

SENSOR = Sensor(
    "kinect-v1",
    "0",
    PinholeCamera(640, 480, 580.0, 580.0, 320.0, 240.0),
    PinholeCamera(640, 480, 520.0, 520.0, 320.0, 240.0),
    np.eye(4),
    LinearInverseDisparity(a=1090 / 348, b=-1 / 348),
)
BLACK = np.zeros((480, 640, 3), np.uint8)
PIXEL_MM = 1.35


@pytest.fixture(scope="module")
def model() -> MatchingModel:
    return MatchingModel.load()


def _bumps(seed: int, shape: tuple[int, int] = (61, 71)) -> FloatArray:
    """Something like toes with gaps: waves, a ragged border, single unknown pixels."""
    rng = np.random.default_rng(seed)
    v, u = np.mgrid[: shape[0], : shape[1]].astype(float)
    raw = 650 + 0.1 * v + 3 * np.sin(u / 2.5 + rng.uniform(0, 6)) * np.sin(v / 9)
    unknown = np.hypot(u - 35, (v - 30) / 0.8) > 28 + 3 * np.sin(np.arctan2(v - 30, u - 35) * 5)
    return np.where(unknown | (rng.random(shape) < 0.01), np.nan, raw)


def _error(raw: FloatArray, model: MatchingModel, pixel_mm: float = PIXEL_MM) -> FloatArray:
    return matching_error(raw, _even(raw), np.full(raw.shape, pixel_mm), model)


def _even(raw: FloatArray) -> Float32Array:
    """A picture in which nothing is darker than anything else."""
    return np.zeros(raw.shape, np.float32)


def _grooves(raw: FloatArray) -> Float32Array:
    """A picture with dark lines from top to bottom."""
    u = np.arange(raw.shape[1])
    return np.broadcast_to(-0.4 * (u % 12 < 3), raw.shape).astype(np.float32)


@pytest.mark.parametrize("slope", [(0.0, 0.0), (0.3, 0.0), (-0.2, 0.4)])
def test_nothing_is_foretold_of_a_plane(model: MatchingModel, slope: tuple[float, float]) -> None:
    v, u = np.mgrid[:101, :121].astype(float)
    error = _error(640 + slope[0] * u + slope[1] * v, model)

    assert np.abs(error[25:-25, 25:-25]).max() < (0.2 if any(slope) else 0.01)


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.1, 1000))
def test_the_foretold_error_is_bounded(seed: int, spread: float) -> None:
    rng = np.random.default_rng(seed)
    raw = np.where(rng.random((41, 47)) < 0.3, np.nan, 700 + spread * rng.standard_normal((41, 47)))

    dark = rng.uniform(-1, 1, raw.shape).astype(np.float32)
    error = matching_error(raw, dark, np.full(raw.shape, PIXEL_MM), MatchingModel.load())

    assert np.isfinite(error).all()
    assert np.abs(error).max() <= 2.5
    assert (error[np.isnan(raw)] == 0).all()


def test_a_mirrored_foot_has_mirrored_errors(model: MatchingModel) -> None:
    raw = _bumps(1)
    error = _error(raw, model)

    np.testing.assert_allclose(_error(raw[:, ::-1], model), error[:, ::-1], atol=2e-3)
    assert np.abs(error - error[:, ::-1]).max() > 0.2, "the shape itself is not symmetric"


def test_mirrored_features_are_those_of_the_mirrored_picture() -> None:
    raw = _bumps(2)
    rows, columns = np.nonzero(np.isfinite(raw))
    pixel_mm = np.full(len(rows), PIXEL_MM)
    dark = _grooves(raw)
    features = neighbourhoods(raw, dark, pixel_mm, rows, columns)
    other = neighbourhoods(raw[:, ::-1], dark[:, ::-1], pixel_mm, rows, raw.shape[1] - 1 - columns)

    assert features.shape == (len(rows), FEATURES)
    np.testing.assert_allclose(mirrored(features), other, atol=2e-4)


@pytest.mark.parametrize("pixel_mm", [0.9, 1.8])
def test_nothing_is_said_of_distances_that_were_not_learnt(
    model: MatchingModel, pixel_mm: float
) -> None:
    assert not _error(_bumps(3), model, pixel_mm).any()
    assert _error(_bumps(3), model).any()


def test_nothing_known_nothing_said(model: MatchingModel) -> None:
    assert not _error(np.full((31, 31), np.nan), model).any()


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_a_sensor_turned_about_its_axis_is_corrected_alike(turns: int) -> None:
    """The picture is brought upright by the pose, whichever way the sensor lies."""
    pose = rigid(np.eye(3), np.array([0.0, 0.0, -780.0]))
    upright = DepthView("view", SENSOR, pose, (280, 200), _bumps(4), BLACK)
    # np.rot90 turns the picture counter-clockwise, as a sensor does that is turned clockwise.
    turn = rotation_about(np.array([0.0, 0.0, 1.0]), 90.0 * turns)
    rolled = replace(
        upright, sensor2reference=pose @ rigid(turn, np.zeros(3)), raw=np.rot90(upright.raw, turns)
    )

    corrected = np.rot90(without_matching_error(rolled).raw, -turns)
    expected = without_matching_error(upright).raw

    np.testing.assert_allclose(corrected, expected, atol=2e-3)
    assert np.nanmax(np.abs(expected - upright.raw)) > 0.2


@pytest.mark.slow
def test_the_toes_of_a_simulated_foot_come_nearer_to_the_truth() -> None:
    rng = np.random.default_rng(20)
    foot = build_foot(FootShape(250, 99, 67), rng, 2.2).mesh
    device = make_device("T", (), 800.0, (640, 480), rng)
    pose = look_at(np.array([-330.0, 60, -720]), np.array([0.0, 60, 5]), np.array([0.0, 1, 0]))
    front = foot.vertices[foot.vertices[:, 1] > 40]
    caster = SceneCaster(foot)
    recording = record_matched_depth(caster, device, pose, rng, things=front)
    frames = np.stack([recording.frame(rng) for _ in range(5)]).astype(float)
    raw = device.sensor.corrected(np.where(frames < 2047, frames, np.nan).mean(axis=0))
    reading = DepthView("view", device.sensor, pose, (0, 0), raw, BLACK)
    rays = reading.directions(reading.pixels).reshape(-1, 3)
    hits = caster.cast(reading.origin_mm, rays)
    true = np.full(raw.shape, np.nan)
    true.flat[hits.ray] = device.sensor.disparity.raw(hits.distance)
    before = raw - true

    after = without_matching_error(reading).raw - true

    seen = np.abs(before) < 6
    assert seen.sum() > 2500
    assert np.sqrt((after[seen] ** 2).mean()) < 0.8 * np.sqrt((before[seen] ** 2).mean())
