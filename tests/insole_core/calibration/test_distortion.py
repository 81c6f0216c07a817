from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from simulated_device import (
    CAMERA,
    DISPARITY,
    WALLS,
    SimulatedDevice,
    smooth_distortion,
    true_raw,
    wall,
)

from insole_core.calibration.walls.captures import WallCapture, capture_from_frames, read_captures
from insole_core.calibration.walls.distortion import DistortionCalibration, calibrate_distortion
from insole_core.calibration.walls.thesis_maps import cubic_map, mean_map
from insole_core.calibration.walls.wall_plane import fit_wall, plane_rows
from insole_core.errors import CalibrationError, InputError
from insole_core.evaluation.wall import leave_one_out
from insole_core.geometry.arrays import FloatArray
from insole_core.progress import Cancelled, Progress
from insole_core.sensing.sensor import BURRUS, DEPTH_CAMERA

ROWS = plane_rows(CAMERA)


@pytest.fixture(scope="module")
def device() -> SimulatedDevice:
    # 7 mm at 800 mm, where one raw unit is 1.97 mm.
    return SimulatedDevice(smooth_distortion(3, 3.56))


@pytest.fixture(scope="module")
def captures(device: SimulatedDevice) -> list[WallCapture]:
    return [device.capture(plane) for plane in WALLS]


@pytest.fixture(scope="module")
def calibration(captures: list[WallCapture]) -> DistortionCalibration:
    return calibrate_distortion(captures, CAMERA, DISPARITY)


def systematic_mm(corrected_raw: FloatArray, plane: FloatArray) -> FloatArray:
    """Depth error after the plane that walls of unknown position cannot tell is taken away."""
    error = corrected_raw - true_raw(plane)
    known = np.isfinite(error)
    unseen = np.linalg.lstsq(ROWS[known], error[known], rcond=None)[0]
    true = DISPARITY.depth_mm(true_raw(plane))
    return DISPARITY.depth_mm(true_raw(plane) + error - ROWS @ unseen) - true


def rms(values: FloatArray) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


@pytest.mark.slow
@pytest.mark.parametrize("distance_mm", [700, 800, 900])
def test_distortion_of_7_mm_falls_below_a_quarter_mm(
    device: SimulatedDevice, calibration: DistortionCalibration, distance_mm: float
) -> None:
    plane = wall(distance_mm, -1, 4)
    raw = device.distorted(plane)
    assert rms(systematic_mm(raw, plane)) > 4.5
    assert rms(systematic_mm(calibration.correction.corrected(raw), plane)) < 0.25


def test_raw_error_at_800_mm_is_that_of_the_thesis(device: SimulatedDevice) -> None:
    plane = wall(800)
    assert rms(systematic_mm(device.distorted(plane), plane)) == pytest.approx(7, abs=0.7)


def test_stated_deviation_is_that_of_the_map(
    device: SimulatedDevice, calibration: DistortionCalibration
) -> None:
    plane = wall(1 / (DISPARITY.a + DISPARITY.b * calibration.correction.reference_raw) * 1000)
    left = calibration.correction.corrected(device.distorted(plane)) - true_raw(plane)
    left -= (ROWS @ np.linalg.lstsq(ROWS.reshape(-1, 3), left.ravel(), rcond=None)[0]).reshape(
        left.shape
    )
    assert calibration.correction.deviation is not None
    ratio = rms(left) / float(np.mean(calibration.correction.deviation))
    assert 0.3 < ratio < 3


@pytest.mark.slow
def test_walls_of_known_position_give_the_absolute_distortion() -> None:
    shifted = SimulatedDevice(smooth_distortion(5, 2.0) + 4 + 6 * ROWS[..., 0])
    known = [
        WallCapture(c.name, c.raw, plane=plane)
        for plane in WALLS
        for c in [shifted.capture(plane, 4)]
    ]
    correction = calibrate_distortion(known, CAMERA, DISPARITY).correction
    plane = wall(800, 2, 2)
    left = correction.corrected(shifted.distorted(plane)) - true_raw(plane)
    assert rms(left) < 0.15


def test_the_default_beats_both_algorithms_of_the_thesis(
    device: SimulatedDevice, captures: list[WallCapture], calibration: DistortionCalibration
) -> None:
    walls = [fit_wall(capture, ROWS, DISPARITY) for capture in captures]
    plane = wall(880, 1, 1)
    raw = device.distorted(plane)
    left = {
        "one": mean_map(walls).depth_mm(raw, DISPARITY),
        "two": cubic_map(walls, DISPARITY).depth_mm(raw, DISPARITY),
        "default": calibration.correction.depth_mm(raw, DISPARITY),
    }
    error = {name: rms(systematic_mm(DISPARITY.raw(z), plane)) for name, z in left.items()}
    assert error["default"] < error["one"] < 2
    assert error["default"] < error["two"] < 2


@pytest.mark.slow
def test_holes_and_boards_that_do_not_fill_the_view(device: SimulatedDevice) -> None:
    v, u = np.mgrid[:480, :640]
    left, right = u > 400, u < 240
    holes = np.random.default_rng(0).random((480, 640)) < 0.1
    hidden = [left | holes, right | holes, left, right, (v > 300) | holes, v < 180]
    partial = [device.capture(plane, 6, hide) for plane, hide in zip(WALLS, hidden, strict=True)]
    result = calibrate_distortion(partial, CAMERA, DISPARITY)
    plane = wall(800, 1, -2)
    assert result.covered_share > 0.95
    corrected = result.correction.corrected(device.distorted(plane))
    assert rms(systematic_mm(corrected, plane)) < 0.6


def test_uncovered_pixels_are_named_and_less_trusted(device: SimulatedDevice) -> None:
    corner = np.zeros((480, 640), dtype=bool)
    corner[:160, :200] = True
    result = calibrate_distortion(
        [device.capture(plane, 3, corner) for plane in WALLS[::2]], CAMERA, DISPARITY
    )
    covered, deviation = result.correction.covered, result.correction.deviation
    assert not covered[50, 60]
    assert covered[300, 400]
    assert deviation is not None
    assert deviation[50, 60] > 3 * deviation[300, 400]
    assert any("never filled" in sentence for sentence in result.advice)


@pytest.mark.slow
def test_column_bands_that_move_do_not_shift_the_map(device: SimulatedDevice) -> None:
    generator = np.random.default_rng(4)
    banded = []
    for plane in WALLS:
        edges = np.zeros(640)
        edges[generator.integers(0, 640, 8)] = generator.choice([-0.7, 0.7], 8)
        band = edges.cumsum() - edges.cumsum().mean()
        capture = device.capture(plane, 4)
        banded.append(WallCapture(capture.name, capture.raw + band))
    correction = calibrate_distortion(banded, CAMERA, DISPARITY).correction
    plane = wall(800)
    left = systematic_mm(correction.corrected(device.distorted(plane)), plane)
    assert rms(left) < 1.2


def test_a_single_wall_gives_a_constant_map_and_advice(device: SimulatedDevice) -> None:
    result = calibrate_distortion([device.capture(wall(800))], CAMERA, DISPARITY)
    plane = wall(800, 2, 3)
    left = systematic_mm(result.correction.corrected(device.distorted(plane)), plane)
    assert rms(left) < 1.0
    assert len(result.advice) == 2


@pytest.mark.slow
def test_a_wall_that_is_not_flat_is_left_out_by_name(
    device: SimulatedDevice, captures: list[WallCapture]
) -> None:
    v, u = np.mgrid[:480, :640]
    bump = 12 * np.exp(-(((u - 250) / 90) ** 2) - ((v - 200) / 90) ** 2)
    bent = device.capture(WALLS[2], 4)
    bent = WallCapture("bent wall", bent.raw - bump)
    result = calibrate_distortion([*captures, bent], CAMERA, DISPARITY)
    assert list(result.left_out) == ["bent wall"]
    assert "not flat" in result.left_out["bent wall"]


def test_no_wall_in_view() -> None:
    generator = np.random.default_rng(0)
    clutter = WallCapture("clutter", generator.uniform(400, 900, (480, 640)))
    with pytest.raises(CalibrationError, match="clutter: it shows no flat wall"):
        calibrate_distortion([clutter], CAMERA, DISPARITY)


def test_no_captures() -> None:
    with pytest.raises(CalibrationError, match="no captures"):
        calibrate_distortion([], CAMERA, DISPARITY)


def test_mixed_devices_are_refused(captures: list[WallCapture]) -> None:
    other = WallCapture("other", captures[0].raw, serial="SIM2")
    with pytest.raises(CalibrationError, match=r"different sensors: .*SIM1.*SIM2"):
        calibrate_distortion([*captures, other], CAMERA, DISPARITY)


def test_algorithm_2_needs_four_distances(captures: list[WallCapture]) -> None:
    walls = [fit_wall(capture, ROWS, DISPARITY) for capture in captures[:3]]
    with pytest.raises(CalibrationError, match="4 distances"):
        cubic_map(walls, DISPARITY)


def test_algorithm_1_is_the_mean_of_measured_minus_expected() -> None:
    offset = smooth_distortion(2, 1.0)
    device = SimulatedDevice(offset, decay=0.0, noise_raw=0.0)
    captures = [WallCapture("w", device.distorted(plane)) for plane in WALLS[:2]]
    walls = [fit_wall(capture, ROWS, DISPARITY) for capture in captures]
    assert np.allclose(mean_map(walls).offset, offset, atol=0.15)


def test_frames_of_the_wrong_size_are_refused() -> None:
    with pytest.raises(InputError, match="320×240"):
        capture_from_frames("small", [np.zeros((240, 320), np.uint16)])


def test_frames_without_readings_are_refused() -> None:
    with pytest.raises(CalibrationError, match="no reading at all"):
        capture_from_frames("blind", [np.full((480, 640), 2047, np.uint16)] * 3)
    with pytest.raises(CalibrationError, match="no depth frames"):
        capture_from_frames("empty", [])


def test_cancelling_stops_the_work(captures: list[WallCapture]) -> None:
    with pytest.raises(Cancelled):
        calibrate_distortion(
            captures, CAMERA, DISPARITY, progress=Progress(is_cancelled=lambda: True)
        )


@pytest.mark.slow
@pytest.mark.shared
def test_real_walls_far_apart(shared_data: Path) -> None:
    captures = read_captures(shared_data / "kinect_v1" / "walls_2")
    found = leave_one_out(captures, DEPTH_CAMERA, BURRUS)
    left = {name: np.mean([e.mean_abs_mm for e in errors]) for name, errors in found.items()}
    assert left["default"] < min(left["algorithm 1"], left["algorithm 2"])
    assert left["default"] < 0.75 * left["raw"]
