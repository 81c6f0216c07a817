from __future__ import annotations

import numpy as np
import pytest
from simulated_device import CAMERA, DISPARITY, WALLS, SimulatedDevice, smooth_distortion, wall

from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.calibration.walls.wall_plane import expected_raw, plane_rows
from insole_core.errors import CalibrationError, InputError
from insole_core.evaluation.alignment import Correspondence, evaluate_alignment, shift_color
from insole_core.evaluation.artefact import evaluate_artefact, fit_plane, fit_sphere
from insole_core.evaluation.distances import evaluate_object
from insole_core.evaluation.noise import measure_noise, measure_warm_up
from insole_core.evaluation.resolution import evaluate_resolution
from insole_core.evaluation.wall import NoCorrection, wall_error
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

ROWS = plane_rows(CAMERA)


def test_a_perfect_wall_has_no_error() -> None:
    raw = expected_raw(wall(800, 5, -8), ROWS, DISPARITY)
    error = wall_error(WallCapture("w", raw), NoCorrection(), CAMERA, DISPARITY)
    assert error.mean_abs_mm < 1e-6
    assert error.pixels == 480 * 640
    assert error.perpendicular_mean_abs_mm > 10


def test_a_known_error_is_measured() -> None:
    raw = expected_raw(wall(800), ROWS, DISPARITY)
    checks = np.where(np.indices(raw.shape).sum(0) % 2, 1.0, -1.0)
    depth = DISPARITY.depth_mm(raw) + 3 * checks
    error = wall_error(WallCapture("w", DISPARITY.raw(depth)), NoCorrection(), CAMERA, DISPARITY)
    assert error.mean_abs_mm == pytest.approx(3, abs=0.01)
    assert error.rms_mm == pytest.approx(3, abs=0.01)
    assert error.distance_mm == pytest.approx(800, abs=0.01)


def test_a_wall_that_is_not_there() -> None:
    with pytest.raises(CalibrationError, match="nothing has no flat surface"):
        wall_error(
            WallCapture("nothing", np.full((480, 640), np.nan)), NoCorrection(), CAMERA, DISPARITY
        )


LEGO = np.array(
    [
        [64.0 * tower, 32.0 * (tower % 2), 28.8 * level + 9.6 * tower]
        for tower in range(5)
        for level in range(3)
    ]
)
NAMES = [f"T{tower}{level}" for tower in range(5) for level in range(3)]


def test_distances_by_axis_with_a_known_error() -> None:
    true = np.array([[0.0, 0, 0], [100, 0, 0], [0, 50, 0], [0, 0, 30]])
    result = evaluate_object(list("abcd"), true, true * [1.01, 1.0, 1.0])
    assert len(result.distances) == 6
    assert result.mean_abs_by_axis_mm["x"] == pytest.approx(1.0)
    assert result.mean_abs_by_axis_mm["y"] == pytest.approx(0, abs=1e-9)
    assert result.max_abs_mm == pytest.approx(1.0)
    assert result.distances[0].relative == pytest.approx(0.01)


@pytest.fixture(scope="module")
def calibrated() -> tuple[SimulatedDevice, DisparityCorrection]:
    device = SimulatedDevice(smooth_distortion(3, 3.56))
    captures = [device.capture(plane, 10) for plane in WALLS]
    return device, calibrate_distortion(captures, CAMERA, DISPARITY).correction


@pytest.mark.slow
@pytest.mark.parametrize("distance_mm", [850.0, 950.0])
def test_known_object_measured_with_a_calibrated_device(
    calibrated: tuple[SimulatedDevice, DisparityCorrection], distance_mm: float
) -> None:
    device, correction = calibrated
    object2camera = rigid(
        rotation_about(np.array([1.0, 0.4, 0.2]), 25), np.array([-128.0, -20, distance_mm])
    )
    true = transform(object2camera, LEGO)
    pixels = CAMERA.project(true)
    u, v = np.round(pixels).astype(int).T
    exact = DISPARITY.raw(true[:, 2])
    bent = exact + device.distortion_raw[v, u] * np.exp(-device.decay * (exact - 650))
    # Ten frames, and the mean over 5 x 5 pixels round the mark.
    noise = np.random.default_rng(3).normal(0, device.noise_raw, (250, len(LEGO)))
    measured = np.round(bent + noise).mean(0)
    image = np.full((480, 640), np.nan)
    image[v, u] = measured
    depth = correction.depth_mm(image, DISPARITY)[v, u]
    marked = pixels + np.random.default_rng(4).normal(0, 0.2, pixels.shape)
    rays = np.column_stack([CAMERA.normalised(marked), np.ones(len(marked))])
    result = evaluate_object(NAMES, LEGO, rays * depth[:, None])
    assert len(result.distances) == 105
    assert result.mean_abs_mm <= 0.6


def test_unseen_points_and_bad_lists() -> None:
    seen = LEGO.copy()
    seen[3] = np.nan
    assert len(evaluate_object(NAMES, LEGO, seen).distances) == 14 * 13 // 2
    with pytest.raises(InputError, match="both positions"):
        evaluate_object(NAMES, LEGO, LEGO[:4])
    with pytest.raises(InputError, match="Fewer than two"):
        evaluate_object(NAMES, LEGO, np.full_like(LEGO, np.nan))
    with pytest.raises(InputError, match="same true position"):
        evaluate_object(["a", "b"], np.zeros((2, 3)), np.ones((2, 3)))


def cap(center: FloatArray, radius: float, noise: float, seed: int) -> FloatArray:
    """Points on the half of a sphere that faces the sensor."""
    generator = np.random.default_rng(seed)
    direction = generator.normal(size=(4000, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    direction = direction[direction[:, 2] < -0.3]
    return center + direction * (radius + generator.normal(0, noise, (len(direction), 1)))


def test_artefact_with_known_values() -> None:
    first, second = np.array([0.0, 0, 800]), np.array([180.0, 60, 840])
    spacing = float(np.linalg.norm(second - first))
    plate = np.random.default_rng(0).uniform([-90, -90, 0], [90, 90, 0], (5000, 3))
    plate[:, 2] = 800 + 0.3 * plate[:, 0] + np.random.default_rng(1).normal(0, 0.2, 5000)
    result = evaluate_artefact(
        [(cap(first, 25.5, 0.1, 1), cap(second, 25.5, 0.1, 2))], [plate], 50, spacing - 0.7
    )
    assert result.probing_size_mm == pytest.approx(1.0, abs=0.05)
    assert result.spacing_mm == pytest.approx(0.7, abs=0.05)
    assert result.probing_form_95_mm == pytest.approx(2 * 1.96 * 0.1, rel=0.1)
    assert result.flatness_95_mm == pytest.approx(2 * 1.96 * 0.2 / np.hypot(1, 0.3), rel=0.1)
    assert result.probing_form_mm > result.probing_form_95_mm


def test_artefact_without_enough_points() -> None:
    with pytest.raises(InputError, match="sphere has only 10"):
        fit_sphere(np.ones((10, 3)))
    with pytest.raises(InputError, match="plane has only 0"):
        fit_plane(np.empty((0, 3)))
    with pytest.raises(InputError, match="bar and the plate"):
        evaluate_artefact([], [], 50, 200)


def test_resolution_against_theory() -> None:
    raw = np.round(expected_raw(wall(800, 20, 10), ROWS, DISPARITY))
    result = evaluate_resolution(WallCapture("book", raw), CAMERA, DISPARITY)
    assert result.distance_mm == pytest.approx(800, rel=0.01)
    assert result.x_mm == pytest.approx(800 / 585, rel=0.2)
    assert result.theory_x_mm == pytest.approx(
        2 * result.distance_mm * np.tan(np.radians(29)) / 640
    )
    assert result.depth_mm == pytest.approx(result.theory_depth_mm, rel=0.05)
    assert result.theory_depth_mm == pytest.approx(0.0030711 * 0.8**2 * 1000, rel=0.02)
    with pytest.raises(CalibrationError, match="no reading in the middle"):
        evaluate_resolution(WallCapture("blind", np.full((480, 640), np.nan)), CAMERA, DISPARITY)


def sensor() -> Sensor:
    color = PinholeCamera(1280, 1024, 1034, 1034, 640, 512)
    return Sensor("m", "s", CAMERA, color, rigid(np.eye(3), np.array([-25.0, 0, 0])), DISPARITY)


def marked(shift: tuple[float, float]) -> list[Correspondence]:
    points = []
    for depth in (800.0, 900.0, 1000.0):
        for u, v in ((150.0, 100.0), (320.0, 300.0), (500.0, 200.0)):
            ray = CAMERA.normalised(np.array([u, v]))
            x, y = sensor().color_pixels(np.array([*(ray * depth), depth])).tolist()
            points.append(Correspondence((u, v), depth, (x + shift[0], y + shift[1])))
    return points


def test_alignment_over_distance_and_the_constant_shift() -> None:
    points = marked((0.5, 5.0))
    table = evaluate_alignment(sensor(), points)
    assert [row.distance_mm for row in table] == [800, 900, 1000]
    assert all((round(r.x_px, 6), round(r.y_px, 6), r.points) == (0.5, 5, 3) for r in table)
    put_right = evaluate_alignment(shift_color(sensor(), points), points)
    assert all(abs(row.x_px) < 1e-6 and abs(row.y_px) < 1e-6 for row in put_right)
    with pytest.raises(InputError, match="No point is marked"):
        evaluate_alignment(sensor(), [])


def test_noise_of_a_known_device() -> None:
    device = SimulatedDevice(np.zeros((480, 640)), noise_raw=1.5)
    hidden = np.zeros((480, 640), dtype=bool)
    hidden[:48] = True
    noise = measure_noise(device.frames(wall(800), 20, hidden), DISPARITY)
    assert noise.sd_raw == pytest.approx(np.hypot(1.5, np.sqrt(1 / 12)), rel=0.03)
    assert noise.sd_mm == pytest.approx(noise.sd_raw * 1.966, rel=0.03)
    assert noise.missing_share == pytest.approx(0.1)
    with pytest.raises(InputError, match="two frames"):
        measure_noise([], DISPARITY)
    scenes = [next(device.frames(wall(mm), 1)) for mm in (700, 800)]
    with pytest.raises(InputError, match="different scenes"):
        measure_noise(scenes, DISPARITY)


def test_warm_up_settles() -> None:
    moments = []
    for minute in range(12):
        depth = 800 + 4 * np.exp(-minute / 2)
        frame = np.full((480, 640), round(float(DISPARITY.raw(np.array(depth)))), np.uint16)
        moments.append((60.0 * minute, frame))
    result = measure_warm_up(moments, DISPARITY)
    assert result.drift_mm == pytest.approx(-4, abs=2)
    assert 0 < result.settled_after_s < 600
    with pytest.raises(InputError, match="three moments"):
        measure_warm_up(moments[:2], DISPARITY)
    assert result.seconds[0] == 0
