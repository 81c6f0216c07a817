"""The distortion of a stereo camera's depth, from walls in millimetres."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.calibration.walls.wall_plane import plane_rows
from insole_core.geometry.arrays import FloatArray, RawArray
from insole_core.recording.images import encode_png
from insole_core.recording.sensor_folder import read_sensor, write_sensor
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.active_stereo import StereoDevice, make_stereo_device
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.cli.main import run

DISTANCES_MM = (420, 480, 540, 600, 660)
NOISE_PX = 0.06


@pytest.fixture(scope="module")
def device() -> StereoDevice:
    return make_stereo_device("D1", ("sole",), np.random.default_rng(4))


@pytest.fixture(scope="module")
def walls(device: StereoDevice, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folders of walls, a little askew, as the window keeps them."""
    folder, rng = tmp_path_factory.mktemp("walls"), np.random.default_rng(5)
    sensor = replace(device.sensor, correction=None)
    rows = plane_rows(sensor.depth_camera)
    for number, distance_mm in enumerate(DISTANCES_MM):
        plane = np.array([0.1 * (-1) ** number, 0.05, 1.0]) / distance_mm
        wall = folder / f"wall_{number:03d}"
        wall.mkdir()
        write_sensor(sensor, wall)
        for frame in range(2):
            (wall / f"depth_{frame:03d}.png").write_bytes(
                encode_png(depth_of(rows @ plane, device, rng))
            )
    return folder


def depth_of(inverse: FloatArray, device: StereoDevice, rng: np.random.Generator) -> RawArray:
    """Return what the camera stores of a surface of 1/Z: neighbours share their noise."""
    sensor = device.sensor
    assert sensor.baseline_mm is not None
    assert sensor.depth_unit_mm is not None
    scale = sensor.depth_camera.fx * sensor.baseline_mm
    coarse = rng.normal(0, NOISE_PX, tuple(side // 4 for side in inverse.shape))
    px = scale * inverse + device.error_px + coarse.repeat(4, axis=0).repeat(4, axis=1)
    return np.rint(scale / px / sensor.depth_unit_mm).astype(np.uint16)


@pytest.fixture(scope="module")
def store(walls: Path, tmp_path_factory: pytest.TempPathFactory) -> SensorStore:
    folder = tmp_path_factory.mktemp("sensors")
    words = ["calibrate", "distortion", str(walls), "--serial", "D1", "--sensors", str(folder)]
    assert run(words) == 0
    return SensorStore(folder)


def test_walls_take_out_the_waves_of_a_stereo_camera(
    device: StereoDevice, store: SensorStore
) -> None:
    sensor = store.load("D1")
    assert sensor is not None
    assert (sensor.depth_unit_mm, sensor.model) == (0.1, "realsense-d415")
    assert sensor.correction is not None
    assert sensor.correction.record.unit == "px"
    assert sensor.correction.offset.shape == (720, 1280)
    with np.load(store.folder_of("D1") / "correction.npz") as stored:
        off_px = stored["offset"] - device.error_px
    rows = plane_rows(sensor.depth_camera)[40:-40:8, 40:-40:8].reshape(-1, 3)
    off = off_px[40:-40:8, 40:-40:8].ravel()
    off -= rows @ np.linalg.lstsq(rows, off)[0]  # a plane cannot be told from the wall's place
    assert np.std(device.error_px) > 0.09
    assert np.std(off) < 0.02


def test_another_wall_is_flat_afterwards(
    device: StereoDevice, store: SensorStore, walls: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sensor = store.load("D1")
    assert sensor is not None
    rows = plane_rows(sensor.depth_camera)
    frame = depth_of(rows @ (np.array([0.0, 0.1, 1.0]) / 510), device, np.random.default_rng(9))

    def uneven_px(one: Sensor) -> float:
        readings = Readings.of(one)
        raw = readings.numbers(frame) / readings.per_raw
        px = ((2047 - readings.sensor.corrected(raw)) / 8)[20:-20, 20:-20]
        rows = plane_rows(readings.sensor.depth_camera)[20:-20, 20:-20]
        px, flat = (one.reshape(40, 8, 75, 8, -1).mean((1, 3)) for one in (px, rows))
        px, flat = px.ravel(), flat.reshape(-1, 3)
        return float(np.std(px - flat @ np.linalg.lstsq(flat, px)[0]))

    before, after = uneven_px(replace(sensor, correction=None)), uneven_px(sensor)
    assert before > 0.04
    assert after < 0.02
    words = ["evaluate", "wall", str(walls), "--serial", "D1"]
    assert run([*words, "--sensors", str(store.folder_of("D1").parent)]) == 0
    assert "corrected" in capsys.readouterr().out


def test_walls_of_a_kinect_are_not_for_a_stereo_camera(
    store: SensorStore, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    (tmp_path / "wall.png").write_bytes(encode_png(np.full((480, 640), 700, np.uint16)))
    words = ["calibrate", "distortion", str(tmp_path), "--serial", "D1"]
    assert run([*words, "--sensors", str(store.folder_of("D1").parent)]) == 1
    assert "recorded by another kind of sensor than D1, a realsense-d415" in last_line()


def test_what_the_factory_calibrated_is_not_calibrated_again(
    store: SensorStore, walls: Path, last_line: Callable[[], str]
) -> None:
    words = ["calibrate", "disparity", str(walls), "--serial", "D1", "--distances"]
    distances = [str(mm) for mm in DISTANCES_MM]
    assert run([*words, *distances, "--sensors", str(store.folder_of("D1").parent)]) == 1
    assert "calibrate only the distortion of its depth, with walls" in last_line()


def test_frames_of_another_size_are_told(walls: Path, tmp_path: Path, last_line) -> None:
    wall = tmp_path / "wall"
    wall.mkdir()
    write_sensor(read_sensor(walls / "wall_000"), wall)
    (wall / "depth_000.png").write_bytes(encode_png(np.full((480, 640), 5000, np.uint16)))
    words = ["calibrate", "distortion", str(tmp_path), "--serial", "D1"]
    assert run([*words, "--sensors", str(tmp_path / "s")]) == 1
    assert "is 640×480, but a depth frame of this sensor must be 1280×720" in last_line()
