"""Block matching on simulated dots, against what is known of real sensors."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.calibration.walls.captures import read_depth
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.block_matching import MatchedRecording, record_matched_depth
from insole_core.simulate.device import Device, make_device
from insole_core.simulate.dot_pattern import DotPattern
from insole_core.simulate.scene import SceneCaster

DISTANCE_MM = 750.0
CENTRE = (slice(200, 280), slice(290, 350))
SMALL = SimulationOptions(frames=1, color_size=(640, 480), foot_cell_mm=6.0)


@pytest.fixture(scope="module")
def device() -> Device:
    return make_device("T1", ("sole",), DISTANCE_MM, (640, 480), np.random.default_rng(2))


def _square(half_mm: float, tilt_deg: float = 0.0, z_mm: float = DISTANCE_MM) -> TriangleMesh:
    corners = half_mm * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    turned = corners @ rotation_about(np.array([0.0, 1.0, 0.0]), tilt_deg).T
    triangles = np.array([[0, 2, 1], [0, 3, 2]], dtype=np.int32)
    return TriangleMesh(turned + np.array([0, 0, z_mm]), triangles)


def _waves(wavelength_mm: float, height_mm: float) -> TriangleMesh:
    """A square whose depth goes up and down from row to row of the image."""
    v, u = np.mgrid[-60:60:1.0, -60:60:1.0]
    z = DISTANCE_MM + height_mm * np.cos(2 * np.pi * v / wavelength_mm)
    index = np.arange(v.size).reshape(v.shape)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    triangles = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (b, d, c))])
    return TriangleMesh(np.stack([u, v, z], -1).reshape(-1, 3), triangles.astype(np.int32))


def _recording(scene: TriangleMesh, device: Device, seed: int = 1) -> MatchedRecording:
    rng = np.random.default_rng(seed)
    return record_matched_depth(SceneCaster(scene), device, np.eye(4), rng, things=scene.vertices)


def _mean(recording: MatchedRecording, frames: int = 6) -> np.ndarray:
    drawn = np.stack([recording.frame(np.random.default_rng(i)) for i in range(frames)])
    return np.where(drawn < NO_READING, drawn, np.nan).mean(axis=0)


@pytest.mark.parametrize(("tilt_deg", "fixed"), [(0.0, 0.25), (30.0, 0.38), (50.0, 0.6)])
def test_noise_is_that_of_a_real_sensor(device: Device, tilt_deg: float, fixed: float) -> None:
    """Temporal sigma of 0.35 to 0.6 raw; what is left after averaging grows with the slant."""
    recording = _recording(_square(90, tilt_deg), device)
    frames = np.stack([recording.frame(np.random.default_rng(i))[CENTRE] for i in range(6)])
    rays = device.sensor.depth_camera.pixel_rays()
    depth_mm = DISTANCE_MM / (1 + np.tan(np.radians(tilt_deg)) * rays[..., 0])
    true = device.distort(device.sensor.disparity.raw(depth_mm))[CENTRE]

    assert (frames < NO_READING).mean() > 0.98
    assert 0.3 < np.sqrt(frames.astype(float).var(axis=0, ddof=1).mean()) < 0.65
    error = frames.mean(axis=0) - true
    assert abs(error.mean()) < 0.1
    assert error.std() == pytest.approx(fixed, abs=0.1)


def test_only_the_last_eight_columns_hold_no_reading(device: Device) -> None:
    """As in real captures, 632 of 640 columns are read."""
    rng = np.random.default_rng(1)
    strip = np.array([[-600.0, -15.0, DISTANCE_MM], [600.0, 15.0, DISTANCE_MM]])
    wall = SceneCaster(_square(600))
    recording = record_matched_depth(wall, device, np.eye(4), rng, things=strip)
    read = recording.frame(rng)[235:250] < NO_READING

    assert read[:, :8].mean() > 0.5
    assert read[:, 8:632].mean() > 0.95
    assert not read[:, 632:].any()


def test_no_part_of_the_pattern_is_without_dots() -> None:
    """Where there are none over a window's width nothing is read, be it a third of a foot."""
    for seed in range(3):
        rows = slice(200, 280)
        seen = DotPattern.draw(np.random.default_rng(seed), rows).seen(rows)
        by_pixel = seen.reshape(len(seen), -1, 8).mean(axis=(0, 2))
        by_window = np.convolve(by_pixel, np.full(7, 1 / 7), mode="valid")
        assert by_window.min() > 0.5 * by_window.mean()


@pytest.mark.shared
@pytest.mark.parametrize("folder", ["walls_1", "walls_2", "board_1"])
def test_real_captures_end_at_the_same_column(folder: str, shared_data: Path) -> None:
    frames = [
        read_depth(path) for path in sorted((shared_data / "kinect_v1" / folder).glob("*.png"))
    ]
    seen = (np.stack(frames) < NO_READING).any(axis=(0, 1))

    np.testing.assert_array_equal(np.flatnonzero(seen), np.arange(632))


@pytest.mark.parametrize(("wavelength_mm", "share"), [(15.0, 0.5), (40.0, 0.85)])
def test_narrow_relief_is_lost(device: Device, wavelength_mm: float, share: float) -> None:
    """A window is 11.6 mm wide here; half of a relief of a toe's width is lost in it."""
    mean = _mean(_recording(_waves(wavelength_mm, 3.0), device))
    camera = device.sensor.depth_camera
    y_mm = camera.pixel_rays()[..., 1] * DISTANCE_MM
    true = device.distort(
        device.sensor.disparity.raw(DISTANCE_MM + 3 * np.cos(2 * np.pi * y_mm / wavelength_mm))
    )
    seen, there = mean[CENTRE].mean(axis=1), true[CENTRE].mean(axis=1)

    assert np.ptp(seen) / np.ptp(there) == pytest.approx(share, abs=0.12)


def test_the_near_side_of_an_edge_is_fattened(device: Device) -> None:
    """Windows that see two depths decide for one: the border of a near square moves outwards."""
    near, wall = _square(50, 0, 700.0), _square(110, 0, 780.0)
    scene = TriangleMesh(
        np.concatenate([near.vertices, wall.vertices]),
        np.concatenate([near.triangles, wall.triangles + 4]),
    )
    depth_mm = device.sensor.depth_mm(_mean(_recording(scene, device)))
    right = device.sensor.depth_camera.project(np.array([50.0, 0.0, 700.0]))[0]
    is_near = np.abs(depth_mm[200:280, int(right) - 20 : int(right) + 20] - 700) < 10
    border = is_near.sum(axis=1) + int(right) - 20

    assert -1 < border.mean() - right < 4.5, "never more than half a window"


def test_a_raw_number_shifts_the_pattern_by_an_eighth_of_a_pixel() -> None:
    pattern = DotPattern.draw(np.random.default_rng(0))
    u, v = np.random.default_rng(1).uniform(20, 300, (2, 500))

    here = pattern.brightness(u, v, np.full(500, 640.0))

    np.testing.assert_allclose(here, pattern.brightness(u + 1, v, np.full(500, 632.0)), atol=1e-4)
    assert not np.allclose(here, pattern.brightness(u, v, np.full(500, 632.0)), atol=0.1)
    assert pattern.texture.mean() == pytest.approx(1, abs=0.1)


def test_rows_of_a_pattern_are_those_of_the_whole() -> None:
    rows = slice(200, 230)
    whole, part = (DotPattern.draw(np.random.default_rng(3), *some) for some in ((), (rows,)))
    places = np.random.default_rng(1).uniform([20, 200], [300, 229], (300, 2)).T

    np.testing.assert_array_equal(part.seen(rows), whole.seen()[rows])
    np.testing.assert_array_equal(
        *(pattern.brightness(*places, np.full(300, 700.0)) for pattern in (whole, part))
    )


@pytest.mark.slow
def test_an_ideal_session_shows_the_same_foot() -> None:
    """Same seed, same foot and poses; only the depth is made otherwise."""
    usual = replace(SMALL, seed=4, distance_mm=900.0)
    matched, ideal = simulate_session(usual), simulate_session(replace(usual, ideal=True))

    np.testing.assert_array_equal(ideal.truth.vertices, matched.truth.vertices)
    for one, other in zip(ideal.session.views, matched.session.views, strict=True):
        np.testing.assert_array_equal(
            ideal.sensor2reference[one.name], matched.sensor2reference[one.name]
        )
        a, b = one.read_depth(0).astype(float), other.read_depth(0).astype(float)
        both = (a < NO_READING) & (b < NO_READING)
        assert both.sum() > 5000
        assert np.median(np.abs(a - b)[both]) <= 1
        np.testing.assert_array_equal(other.read_depth(0), other.read_depth(0))
