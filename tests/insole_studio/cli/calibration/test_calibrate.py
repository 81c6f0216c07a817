"""``insole-studio calibrate`` on folders of images of a sensor that is known."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulated_board import board_poses
from simulated_device import CAMERA, DISPARITY, WALLS, SimulatedDevice, wall
from simulated_folders import (
    BOARD,
    BOARD_CALL,
    SENSOR,
    plane_of,
    write_board_picture,
    write_boards,
    write_walls,
)

from insole_core.calibration.plausibility import USUAL_DEPTH
from insole_core.calibration.stored_correction import MOST_DAYS
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.metric_depth import StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import CalibrationRecord, Sensor
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.cli.main import run

pytestmark = pytest.mark.usefixtures("undrawn_reports")


def kept(folder: Path) -> Sensor:
    sensor = SensorStore(folder).load("SIM1")
    assert sensor is not None
    return sensor


def call(step: str, folder: Path, sensors: Path, *more: str) -> list[str]:
    return ["calibrate", step, str(folder), "--serial", "SIM1", "--sensors", str(sensors), *more]


@pytest.mark.slow
def test_colour_camera_within_three_deviations(recorded) -> None:
    found, true = kept(recorded.sensors).color_camera, SENSOR.color_camera
    report = json.loads((recorded.sensors / "SIM1" / "camera.json").read_text())
    rows = {row["parameter"]: row for row in report["sections"]["camera"]["tables"]["Parameters"]}
    for name in ("fx", "fy", "cx", "cy"):
        deviation = float(rows[name]["standard deviation"])
        assert getattr(found, name) == pytest.approx(getattr(true, name), abs=3 * deviation + 0.1)


def test_distortion_is_kept_beside_the_colour_camera(recorded) -> None:
    sensor = kept(recorded.sensors)
    assert sensor.correction is not None
    assert sensor.correction.record.serial == "SIM1"
    assert sensor.color_camera.width == 640
    figures = sensor.correction.record.figures
    assert figures["rms_before_raw"] > 2.5
    assert figures["rms_after_raw"] < 0.7


@pytest.mark.slow
def test_depth_beside_colour_from_raw_depth(recorded) -> None:
    store = SensorStore(recorded.sensors)
    store.save(replace(kept(recorded.sensors), depth_camera=CAMERA))
    assert run(call("stereo", recorded.boards, recorded.sensors, *BOARD_CALL)) == 0
    found = kept(recorded.sensors)
    between = found.depth2color[:3, :3] @ SENSOR.depth2color[:3, :3].T
    assert rotation_angle_deg(between) < 0.5
    np.testing.assert_allclose(found.depth2color[:3, 3], SENSOR.depth2color[:3, 3], atol=8)
    raw = np.array([600.0, 750.0])
    np.testing.assert_allclose(found.disparity.depth_mm(raw), USUAL_DEPTH.depth_mm(raw), rtol=0.01)


@pytest.mark.slow
def test_a_square_of_another_side_is_kept_only_when_insisted(
    recorded, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = {path: path.read_bytes() for path in recorded.sensors.rglob("*") if path.is_file()}
    report = tmp_path / "stereo.json"
    words = call("stereo", recorded.boards, recorded.sensors, "--board", "9x6", "--square", "24")
    assert run([*words, "--report", str(report)]) == 1
    last = capsys.readouterr().err.strip().splitlines()[-1]
    assert "Nothing was saved: the result does not fit a Kinect v1: a of the depth is 3.9" in last
    assert likely_side(last) == pytest.approx(30, abs=0.5)
    assert last.endswith("add --insist to save it all the same.")
    assert not report.exists()
    after = {path: path.read_bytes() for path in recorded.sensors.rglob("*") if path.is_file()}
    assert after == before
    assert run([*words, "--insist", "--report", str(report)]) == 0
    assert "Warning: The result does not fit a Kinect v1" in capsys.readouterr().err
    assert "does not fit a Kinect v1" in report.read_text("utf-8")
    raw = np.array([600.0, 750.0])
    too_near = kept(recorded.sensors).disparity.depth_mm(raw) / USUAL_DEPTH.depth_mm(raw)
    np.testing.assert_allclose(too_near, 24 / 30, rtol=0.01)


def likely_side(sentence: str) -> float:
    found = re.search(r"is more likely ([\d.]+) mm than 24 mm", sentence)
    assert found is not None, sentence
    return float(found[1])


@pytest.mark.slow
def test_depth_camera_and_stereo_from_infrared(recorded) -> None:
    assert run(call("depth", recorded.infrared, recorded.sensors, *BOARD_CALL)) == 0
    assert run(call("stereo", recorded.infrared, recorded.sensors, *BOARD_CALL)) == 0
    found = kept(recorded.sensors)
    # Corners found in a rendered picture err by 0.1 px, and all to one side of a tilted board.
    assert found.depth_camera.fx == pytest.approx(CAMERA.fx, rel=0.012)
    assert found.depth_camera.cx == pytest.approx(CAMERA.cx, abs=2.5)
    between = found.depth2color[:3, :3] @ SENSOR.depth2color[:3, :3].T
    assert rotation_angle_deg(between) < 0.5
    np.testing.assert_allclose(found.depth2color[:3, 3], SENSOR.depth2color[:3, 3], atol=6)


def test_colour_on_depth_by_a_constant_shift(tmp_path: Path) -> None:
    SensorStore(tmp_path / "own").save(SENSOR)
    rays = CAMERA.normalised(np.array([[200.0, 150.0], [500.0, 300.0], [320.0, 240.0]]))
    space = np.column_stack([rays, np.ones(3)]) * 800
    seen = SENSOR.color_pixels(space) + np.array([2.0, -5.0])
    pixels = [[200, 150], [500, 300], [320, 240]]
    points = [
        {"depth_px": pixel, "depth_mm": 800, "color_px": color.tolist()}
        for pixel, color in zip(pixels, seen, strict=True)
    ]
    (tmp_path / "points.json").write_text(json.dumps({"points": points}))
    assert run(call("shift", tmp_path / "points.json", tmp_path / "own")) == 0
    found = kept(tmp_path / "own").color_camera
    assert found.cx == pytest.approx(SENSOR.color_camera.cx + 2, abs=1e-6)
    assert found.cy == pytest.approx(SENSOR.color_camera.cy - 5, abs=1e-6)
    report = json.loads((tmp_path / "own" / "SIM1" / "shift.json").read_text())
    assert abs(report["sections"]["shift"]["numbers"]["x_px"]["value"]) < 1e-6


@pytest.fixture
def walls_with_boards(tmp_path: Path) -> Path:
    """Two walls, all measured 4 raw units too far, with a board on each."""
    device = SimulatedDevice(np.full((480, 640), 4.0), decay=0)
    folder = tmp_path / "walls"
    for number, placed in enumerate(board_poses(8, 2, BOARD.points_mm.mean(0), 800, 20)):
        write_walls(tmp_path / f"{number}", device, [plane_of(placed)], 1)
        shutil.copytree(tmp_path / f"{number}" / "wall_000", folder / f"wall_{number:03d}")
        write_board_picture(folder / f"wall_{number:03d}" / "color_000.png", placed)
    return folder


@pytest.mark.slow
def test_walls_whose_planes_a_board_tells(walls_with_boards: Path, tmp_path: Path) -> None:
    SensorStore(tmp_path / "own").save(SENSOR)
    words = call("distortion", walls_with_boards, tmp_path / "own", *BOARD_CALL)
    assert run(words) == 0
    correction = kept(tmp_path / "own").correction
    assert correction is not None
    # Walls alone cannot tell a shift of all raw numbers.
    assert float(np.median(correction.offset)) == pytest.approx(4, abs=0.6)


def test_a_wall_without_its_board(walls_with_boards: Path, tmp_path: Path, last_line) -> None:
    words = call("distortion", walls_with_boards, tmp_path / "own", *BOARD_CALL)
    assert run(words) == 1
    assert "The colour camera of this sensor was not calibrated yet" in last_line()
    SensorStore(tmp_path / "own").save(SENSOR)
    (walls_with_boards / "wall_001" / "color_000.png").unlink()
    assert run(words) == 1
    assert "wall_001 holds no pictures named color" in last_line()


@pytest.mark.parametrize("model", ["linear-inverse", "tangent"])
def test_raw_number_to_mm(model: str, recorded, tmp_path: Path) -> None:
    device = SimulatedDevice(np.zeros((480, 640)))
    distances = [600.0, 750.0, 900.0, 1100.0]
    walls = write_walls(tmp_path / "walls", device, [wall(mm) for mm in distances])
    more = ["--model", model, "--distances", *map(str, distances)]
    store = SensorStore(tmp_path / "own")
    assert run(call("disparity", walls, tmp_path / "own", *more)) == 0
    sensor = store.load("SIM1")
    assert sensor is not None
    raw = DISPARITY.raw(np.array([650.0, 800.0, 1000.0]))
    np.testing.assert_allclose(sensor.disparity.depth_mm(raw), [650, 800, 1000], rtol=0.003)


def test_distances_that_contradict_the_scale_before_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    distances = np.array([600.0, 750.0, 900.0, 1100.0])
    device = SimulatedDevice(np.zeros((480, 640)), disparity=USUAL_DEPTH)
    walls = write_walls(tmp_path / "walls", device, [wall(mm) for mm in distances])
    sensors, report = tmp_path / "own", tmp_path / "report.json"
    for share, told in ((1.0, ""), (1.004, ""), (0.97, "-3.4%"), (0.97, ""), (1.0, "+3.1%")):
        given = ["--distances", *map(str, share * distances), "--report", str(report)]
        assert run(call("disparity", walls, sensors, *given)) == 0
        error = capsys.readouterr().err
        assert ("Warning: Depths at" in error) is bool(told)
        assert f"differ by {told}" in error or not told
        assert ("from the scale that was calibrated before" in report.read_text()) is bool(told)


@pytest.mark.slow
def test_a_board_that_contradicts_measured_walls_is_told(
    recorded, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store, report = SensorStore(recorded.sensors), tmp_path / "report.json"
    scale = LinearInverseDisparity(1.04 * USUAL_DEPTH.a, 1.04 * USUAL_DEPTH.b)
    measured = replace(kept(recorded.sensors), depth_camera=CAMERA, disparity=scale)
    more = [*BOARD_CALL, "--report", str(report)]
    for steps, told in (((), False), (("disparity",), True)):
        done = (CalibrationRecord(step, "2026-11-01T10:00:00+00:00", 0.5, "mm") for step in steps)
        store.save(replace(measured, calibration=(*measured.calibration, *done)))
        assert run(call("stereo", recorded.boards, recorded.sensors, *more)) == 0
        error = capsys.readouterr().err
        assert bool(re.search(r"Warning: Depths at \d+ mm differ by \+[345]\.", error)) is told
        assert ("from the scale that was calibrated before" in report.read_text()) is told


def without_board(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    cv2.imwrite(str(folder / "color_000.png"), np.full((480, 640), 90, np.uint8))
    return "color", folder, BOARD_CALL


def copy_boards(sensors: Path, folder: Path, count: int) -> None:
    for number in range(count):
        shutil.copy(sensors.parent / "boards" / f"color_{number:03d}.png", folder)


def of_another_size(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    copy_boards(sensors, folder, 1)
    return "color", folder, ["--board", "8x5", "--square", "30"]


def too_few(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    copy_boards(sensors, folder, 2)
    return "color", folder, BOARD_CALL


def all_parallel(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    write_boards(folder, SimulatedDevice(np.zeros((480, 640))), 4, ("color",), tilt_deg=0)
    return "color", folder, BOARD_CALL


def blurred(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    for path in sorted((sensors.parent / "boards").glob("color_00[0-3].png")):
        cv2.imwrite(str(folder / path.name), cv2.GaussianBlur(cv2.imread(str(path)), (0, 0), 4))
    return "color", folder, BOARD_CALL


def scaled(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    for path in sorted((sensors.parent / "boards").glob("color_00[0-3].png")):
        cv2.imwrite(str(folder / path.name), cv2.resize(cv2.imread(str(path)), (800, 600)))
    return "color", folder, BOARD_CALL


def not_flat(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    v, u = np.mgrid[:480, :640]
    rough = np.where((u // 20 + v // 20) % 2, 500, 900).astype(np.uint16)
    cv2.imwrite(str(folder / "depth_000.png"), rough)
    return "distortion", folder, []


def hardly_filled(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    raw = np.full((480, 640), 2047, np.uint16)
    raw[200:260, 300:360] = 700
    cv2.imwrite(str(folder / "depth_000.png"), raw)
    return "distortion", folder, []


def mixed_devices(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    write_walls(folder / "of_one", SimulatedDevice(np.zeros((480, 640))), WALLS[:1], 1)
    other = SimulatedDevice(np.zeros((480, 640)), serial="SIM2")
    write_walls(folder / "of_other", other, WALLS[1:2], 1)
    joined = folder / "joined"
    joined.mkdir()
    for name in ("of_one", "of_other"):
        shutil.move(folder / name / "wall_000", joined / name)
    return "distortion", joined, []


def boards_as_walls(_folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    return "distortion", sensors.parent / "boards", []


def boards_before_a_wall(folder: Path, _sensors: Path) -> tuple[str, Path, list[str]]:
    """Three walls, before each of which something is held 18 raw units nearer."""
    write_walls(folder, SimulatedDevice(np.zeros((480, 640))), WALLS[:3], 1)
    for number, path in enumerate(sorted(folder.glob("*/depth_000.png"))):
        raw = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        raw[100:180, 60 + 180 * number : 220 + 180 * number] -= 18
        cv2.imwrite(str(path), raw)
    return "distortion", folder, []


def reversed_distances(_folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    distances = sorted((1 / plane[2] for plane in WALLS), reverse=True)
    return "disparity", sensors.parent / "walls", ["--distances", *map(str, distances)]


def too_near(_folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    """All distances as if measured from behind the sensor."""
    distances = (1.12 / plane[2] for plane in WALLS)
    return "disparity", sensors.parent / "walls", ["--distances", *map(str, distances)]


def of_another_mode(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    store = SensorStore(sensors)
    sensor = kept(sensors)
    of = sensor.color_camera
    twice = {name: 2 * getattr(of, name) for name in ("fx", "fy", "cx", "cy")}
    large = replace(of, width=1280, height=1024, **twice)
    store.save(replace(sensor, color_camera=large))
    return "stereo", sensors.parent / "boards", BOARD_CALL


def metres(_folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    call = ["--distances", "0.65", "0.72", "0.79", "0.85", "0.92", "1.0"]
    return "disparity", sensors.parent / "walls", call


def near_unit(folder: Path, sensors: Path) -> tuple[str, Path, list[str]]:
    copy_boards(sensors, folder, 4)
    return "color", folder, ["--board", "9x6", "--square", "5.1"]


REFUSED: dict[str, tuple[Callable[[Path, Path], tuple[str, Path, list[str]]], str]] = {
    "no board": (without_board, "None of the 1 pictures can be used: color_000.png: no chequer"),
    "another size": (of_another_size, "but not one of 8×5 inner corners"),
    "too few": (too_few, "Only 2 pictures of the board can be used, but at least 3"),
    "all parallel": (all_parallel, "held the same way in all pictures"),
    "blurred": (blurred, "blurred|no chequerboard"),
    "scaled": (scaled, "The colour pictures are 800×600, but the sensor gives"),
    "wrong unit": (near_unit, "check the size of its square"),
    "not flat": (not_flat, "shows no flat wall"),
    "hardly filled": (hardly_filled, "shows no flat wall that fills at least 4%"),
    "mixed devices": (mixed_devices, "of_other was recorded with sensor SIM2, not with SIM1"),
    "boards as walls": (boards_as_walls, "as of a board for depth to colour"),
    "boards before a wall": (boards_before_a_wall, "as with boards held before a wall"),
    "reversed distances": (reversed_distances, "in another order than the captures"),
    "too near": (too_near, "measure again from the front"),
    "another mode": (of_another_mode, "but the colour camera was calibrated at 1280×1024"),
    "metres": (metres, "give them in millimetres"),
}


@pytest.fixture
def beside(recorded, tmp_path: Path) -> Path:
    """The kept sensors, with the recorded folders beside them."""
    for folder in (recorded.boards, recorded.walls):
        (tmp_path / folder.name).symlink_to(folder)
    return recorded.sensors


@pytest.mark.slow
@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_one_sentence(name: str, beside: Path, tmp_path: Path, capsys) -> None:
    prepare, expected = REFUSED[name]
    folder = tmp_path / "images"
    folder.mkdir()
    step, images, more = prepare(folder, beside)
    before = {path: path.stat().st_mtime_ns for path in beside.rglob("*")}
    assert run(call(step, images, beside, *more)) == 1
    sentence = capsys.readouterr().err.strip().splitlines()[-1]
    assert any(part in sentence for part in expected.split("|"))
    assert {path: path.stat().st_mtime_ns for path in beside.rglob("*")} == before


@pytest.mark.slow
def test_stereo_needs_the_colour_camera_first(recorded, tmp_path: Path, last_line) -> None:
    assert run(call("stereo", recorded.boards, tmp_path / "new", *BOARD_CALL)) == 1
    assert "was not calibrated yet" in last_line()
    assert not (tmp_path / "new").exists()


WRONG_CALLS = {
    "no size of the board": (["color", "{boards}", "--board", "9", "--square", "30"], "9x6|10x7"),
    "square in metres": (["color", "{boards}", "--board", "9x6", "--square", "0.03"], "in millim"),
    "serial that cannot be": (["color", "{boards}", "--serial", "../x", *BOARD_CALL], "no serial"),
    "report of no kind": (["color", "{boards}", *BOARD_CALL, "--report", "a.doc"], "let it end in"),
    "too few distances": (["disparity", "{walls}", "--distances", "600"], "holds 6 captures"),
}


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_wrong_calls(name: str, recorded, last_line) -> None:
    words, expected = WRONG_CALLS[name]
    filled = [word.format(boards=recorded.boards, walls=recorded.walls) for word in words]
    serial = [] if "--serial" in words else ["--serial", "SIM1"]
    assert run(["calibrate", *filled, *serial, "--sensors", str(recorded.sensors)]) == 2
    sentence = last_line()
    assert any(part in sentence for part in expected.split("|"))


def test_session_takes_the_kept_calibration(
    recorded, tmp_path: Path, small_session: Path, last_line
) -> None:
    session = read_session(small_session)
    store = SensorStore(recorded.sensors)
    words = ["calibrate", "session", str(small_session), "--out", str(tmp_path / "out.zip")]
    words += ["--sensors", str(recorded.sensors)]
    assert run(words) == 1
    assert "was never calibrated here" in last_line()
    for view in session.views:
        camera = replace(view.sensor.depth_camera, cx=view.sensor.depth_camera.cx + 1)
        store.save(replace(view.sensor, depth_camera=camera, correction=None))
    assert run(words) == 0
    for before, after in zip(session.views, read_session(tmp_path / "out.zip").views, strict=True):
        assert after.sensor.depth_camera.cx == before.sensor.depth_camera.cx + 1
        assert after.sensor.faces == before.sensor.faces
        np.testing.assert_array_equal(after.read_depth(0), before.read_depth(0))


def test_views_of_stereo_cameras_stay_as_they_were_recorded(
    tmp_path: Path, small_session: Path, capsys
) -> None:
    session = read_session(small_session)
    left, *others = session.views
    depth = np.full((48, 64), 5000, np.uint16)
    record = CorrectionRecord("D1", datetime.now(UTC).isoformat(), unit="px")
    of_stereo = DisparityCorrection(np.ones((48, 64), np.float32), record=record)
    camera = replace(
        left.sensor, model="realsense-d415", serial="D1",
        depth_camera=PinholeCamera(64, 48, 50.0, 50.0, 32.0, 24.0),
        disparity=StereoDisparity(50.0, 55.0), depth_unit_mm=0.1, baseline_mm=55.0,
        correction=of_stereo,
    )  # fmt: skip
    stereo = replace(left, sensor=camera, read_depth=lambda _: depth)
    given, out = tmp_path / "given", tmp_path / "out"
    write_session(replace(session, views=(stereo, *others)), given)
    of_kinects = DisparityCorrection(np.ones((480, 640), np.float32))
    of_kinects.save(tmp_path / "k.npz")
    of_stereo.save(tmp_path / "d.npz")
    words = ["calibrate", "session", str(given), "--out", str(out), "--correction"]
    assert run([*words, str(tmp_path / "d.npz")]) == 1
    assert "d.npz corrects another kind of sensor" in capsys.readouterr().err
    assert run([*words, str(tmp_path / "k.npz")]) == 0
    told = "Warning: View left stays as it was recorded, because its sensor D1, a realsense-d415,"
    assert told in capsys.readouterr().err
    kept, *corrected = read_session(out).views
    assert kept.sensor.correction is not None
    assert kept.sensor.correction.record == record
    assert all(view.sensor.correction.offset[0, 0] == 1 for view in corrected)

    alone = replace(session.manifest, views=("left",))
    write_session(replace(session, manifest=alone, views=(stereo,)), tmp_path / "alone")
    words = ["calibrate", "session", str(tmp_path / "alone"), "--out", str(tmp_path / "copy")]
    assert run([*words, "--sensors", str(tmp_path / "sensors")]) == 0
    assert told in capsys.readouterr().err
    assert read_session(tmp_path / "copy").views[0].sensor.serial == "D1"


@pytest.mark.slow
def test_correction_of_another_sensor(
    recorded, tmp_path: Path, small_session: Path, capsys
) -> None:
    correction = recorded.sensors / "SIM1" / "correction.npz"
    words = ["calibrate", "session", str(small_session), "--out", str(tmp_path / "out.zip")]
    words += ["--correction", str(correction)]
    assert run(words) == 1
    expected = "The correction was measured on sensor SIM1, not on"
    assert expected in capsys.readouterr().err.strip().splitlines()[-1]
    assert not (tmp_path / "out.zip").exists()
    assert run([*words, "--insist"]) == 0
    assert f"Warning: View left: {expected}" in capsys.readouterr().err


@pytest.mark.parametrize(("days", "warned"), [(MOST_DAYS - 1, False), (MOST_DAYS + 20, True)])
def test_a_correction_past_its_age(
    days: float, warned: bool, tmp_path: Path, small_session: Path, capsys
) -> None:
    store = SensorStore(tmp_path / "own")
    made_at = (datetime.now(UTC) - timedelta(days=days)).isoformat()
    for view in read_session(small_session).views:
        record = CorrectionRecord(serial=view.sensor.serial, made_at=made_at)
        flat = DisparityCorrection(np.zeros((480, 640), np.float32), record=record)
        store.save(replace(view.sensor, correction=flat))
    words = ["calibrate", "session", str(small_session), "--out", str(tmp_path / "out.zip")]
    assert run([*words, "--sensors", str(tmp_path / "own")]) == 0
    sentence = "Warning: View left: The correction is 200 days old; calibrate the sensor again soon"
    assert (sentence in capsys.readouterr().err) is warned
    assert (tmp_path / "out.zip").exists()
