"""The error model on a plane, against the figures it is built from."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate.depth_image import record_depth
from insole_core.simulate.device import BASELINE_MM, Device, make_device
from insole_core.simulate.scene import SceneCaster

DISTANCE_MM = 750.0
CENTRE = (slice(170, 310), slice(250, 390))


@pytest.fixture(scope="module")
def device() -> Device:
    return make_device("T1", ("sole",), DISTANCE_MM, (640, 480), np.random.default_rng(2))


def _plate(tilt_deg: float, half_mm: float = 600.0, z_mm: float = DISTANCE_MM) -> TriangleMesh:
    """A square plate across the optical axis, turned about the image's y axis."""
    corners = half_mm * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    turned = corners @ rotation_about(np.array([0.0, 1.0, 0.0]), tilt_deg).T
    triangles = np.array([[0, 2, 1], [0, 3, 2]], dtype=np.int32)
    return TriangleMesh(turned + np.array([0, 0, z_mm]), triangles)


def _true_raw(device: Device, tilt_deg: float) -> np.ndarray:
    """Raw numbers of an ideal sensor: the plane z = distance - tan(tilt) x."""
    rays = device.sensor.depth_camera.pixel_rays()
    depth_mm = DISTANCE_MM / (1 + np.tan(np.radians(tilt_deg)) * rays[..., 0])
    return device.distort(device.sensor.disparity.raw(depth_mm))


def _frames(device: Device, tilt_deg: float, count: int = 20) -> np.ndarray:
    rng = np.random.default_rng(11)
    recording = record_depth(SceneCaster(_plate(tilt_deg)), device, np.eye(4), rng)
    return np.stack([recording.frame(rng)[CENTRE] for _ in range(count)]).astype(float)


@pytest.mark.parametrize("tilt_deg", [0.0, 30.0, 50.0])
def test_the_noise_grows_with_slant_as_published(device: Device, tilt_deg: float) -> None:
    frames = _frames(device, tilt_deg)
    tangent = np.tan(np.radians(tilt_deg))
    temporal = np.hypot(0.36, 0.45 * tangent)
    fixed = np.hypot(0.25, 0.69 * 8 * BASELINE_MM * tangent / DISTANCE_MM)

    error = frames - _true_raw(device, tilt_deg)[CENTRE]

    assert (frames < NO_READING).all()
    assert np.sqrt(frames.var(axis=0, ddof=1).mean()) == pytest.approx(temporal, rel=0.06)
    assert error.mean(axis=0).std() == pytest.approx(fixed, rel=0.12)
    assert error.std() == pytest.approx(np.hypot(temporal, fixed), rel=0.08)
    assert abs(error.mean()) < 0.1


def test_the_fixed_error_is_correlated_over_a_few_pixels(device: Device) -> None:
    error = (_frames(device, 40.0) - _true_raw(device, 40.0)[CENTRE]).mean(axis=0)
    error -= error.mean()

    def correlation(lag: int) -> float:
        return float((error[:, lag:] * error[:, :-lag]).mean() / error.var())

    assert correlation(1) == pytest.approx(0.66, abs=0.08)
    assert correlation(3) == pytest.approx(0.38, abs=0.08)
    assert abs(correlation(10)) < 0.1


def test_a_grazing_surface_gives_no_reading(device: Device) -> None:
    middle = _frames(device, 78.0, count=1)[..., 50:90]

    assert (middle == NO_READING).mean() > 0.95


def test_the_shadow_falls_on_the_side_away_from_the_projector(device: Device) -> None:
    """The projector stands at +x: a plate hides the wall behind its left border, not its right."""
    near, wall = _plate(0.0, 60.0, 700.0), _plate(0.0, 600.0, 900.0)
    scene = TriangleMesh(
        np.concatenate([near.vertices, wall.vertices]),
        np.concatenate([near.triangles, wall.triangles + 4]),
    )
    rng = np.random.default_rng(1)
    frame = record_depth(SceneCaster(scene), device, np.eye(4), rng).frame(rng)
    camera = device.sensor.depth_camera
    left, right = (camera.project(np.array([x, 0.0, 700.0]))[0] for x in (-60.0, 60.0))
    # By similar triangles the shadow on the wall is baseline x (900 - 700) / 700 wide.
    width = BASELINE_MM * 200 / 700 / 900 * camera.fx

    row = frame[220:260] == NO_READING
    dark = row[:, int(left - width / 2) - 3 : int(left - width / 2) + 3]
    assert dark.all()
    assert not row[:, int(left - width) - 12 : int(left - width) - 6].any()
    assert not row[:, int(right) + 4 : int(right) + 20].any()
    assert row[:, 632:].all(), "the window reaches beyond the picture"
    assert not row[:, 20:40].any()


def test_the_correction_is_nearly_the_true_distortion(device: Device) -> None:
    assert device.sensor.correction is not None
    residual = device.distortion_raw - device.sensor.correction.offset

    assert np.sqrt((device.distortion_raw**2).mean()) == pytest.approx(3.0, abs=1e-6)
    assert np.sqrt((residual**2).mean()) == pytest.approx(0.2, abs=0.02)


def test_corrected_depth_of_a_wall_is_right(device: Device) -> None:
    rng = np.random.default_rng(4)
    recording = record_depth(SceneCaster(_plate(0.0, 900.0)), device, np.eye(4), rng)
    raw = np.stack([recording.frame(rng) for _ in range(10)]).mean(axis=0)
    depth_mm = device.sensor.depth_mm(raw)[:, :632]

    assert np.abs(depth_mm - DISTANCE_MM).mean() < 0.7


def test_both_disparity_models_occur_and_agree_on_the_physics() -> None:
    kinds = set()
    for seed in range(8):
        drawn = make_device("T", (), 800.0, (640, 480), np.random.default_rng(seed))
        disparity = drawn.sensor.disparity
        raw = disparity.raw(np.array(800.0)) + np.arange(2)
        step_mm = np.diff(disparity.depth_mm(raw))
        focal = drawn.sensor.depth_camera.fx
        assert step_mm == pytest.approx(800.0**2 / (8 * focal * BASELINE_MM), rel=0.01)
        kinds.add(type(disparity).__name__)
    assert kinds == {"LinearInverseDisparity", "FactoryDisparity"}
