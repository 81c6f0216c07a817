"""``insole-studio evaluate``: measure, report, and judge by limits."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulated_device import CAMERA, DISPARITY, WALLS, SimulatedDevice, wall
from simulated_folders import BOARD_CALL, SENSOR, write_boards, write_walls

from insole_core.calibration.plausibility import USUAL_DEPTH
from insole_core.calibration.walls.wall_plane import plane_rows
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.recording.reader import read_session
from insole_core.recording.sensor_folder import write_sensor
from insole_core.sensing.sensor import nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.cli.main import run


@pytest.fixture
def perfect(tmp_path: Path) -> list[str]:
    """Arguments that name a sensor without any error."""
    store = SensorStore(tmp_path / "perfect")
    store.save(SENSOR)
    return ["--serial", "SIM1", "--sensors", str(tmp_path / "perfect")]


def numbers(report: Path, name: str = "") -> dict[str, dict[str, float]]:
    """The numbers of a section, by default of the only one."""
    sections = json.loads(report.read_text())["sections"]
    if not name:
        (name,) = sections
    return sections[name]["numbers"]


@pytest.mark.slow
def test_wall_before_and_after(recorded, tmp_path: Path) -> None:
    report = tmp_path / "wall.json"
    words = ["evaluate", "wall", str(recorded.walls), "--serial", "SIM1"]
    words += ["--sensors", str(recorded.sensors), "--limits", "--report", str(report)]
    assert run(words) == 0
    found = numbers(report)
    assert found["mean_abs_mm_raw"]["value"] > 3
    assert found["mean_abs_mm_corrected"]["value"] < 1
    assert found["mean_abs_mm_corrected"]["passed"]


@pytest.fixture
def one_wall(recorded, tmp_path: Path) -> Path:
    shutil.copytree(recorded.walls / "wall_000", tmp_path / "walls" / "wall_000")
    return tmp_path / "walls"


def test_a_sensor_without_a_correction_is_told(one_wall, perfect: list[str], capsys) -> None:
    assert run(["evaluate", "wall", str(one_wall), *perfect]) == 0
    assert "was not calibrated yet; only the raw error is measured" in capsys.readouterr().err


def test_failed_limit_is_an_error_with_its_report(one_wall, tmp_path: Path, last_line) -> None:
    report = tmp_path / "wall.json"
    words = ["evaluate", "wall", str(one_wall), "--report", str(report)]
    assert run([*words, "--limit", "mean_abs_mm_raw=0.5"]) == 1
    assert "The acceptance failed: Mean absolute error, raw" in last_line()
    assert numbers(report)["mean_abs_mm_raw"]["passed"] is False


def test_limits_of_a_clinic(one_wall, tmp_path: Path, last_line) -> None:
    limits = tmp_path / "limits.json"
    words = ["evaluate", "wall", str(one_wall), "--limits", str(limits)]
    limits.write_text(json.dumps({"limits": {"wall": {"mean_abs_mm_raw": 50}}}))
    assert run(words) == 0
    limits.write_text(json.dumps({"limits": {"wall": {"mean_abs_mm_raww": 50}}}))
    assert run(words) == 1
    assert 'The limit "mean_abs_mm_raww" has no number to judge' in last_line()
    limits.write_text(json.dumps({"limits": {"wall": {"mean_abs_mm_raw": "50"}}}))
    assert run(words) == 1
    assert "limits.json" in last_line()


def test_too_few_walls_to_leave_one_out(tmp_path: Path, last_line) -> None:
    device = SimulatedDevice(np.zeros((480, 640)))
    walls = write_walls(tmp_path / "walls", device, WALLS[:3], 1)
    assert run(["evaluate", "wall", str(walls), "--leave-one-out"]) == 1
    assert "needs captures at 5 distances or more, but there are 3" in last_line()


@pytest.mark.parametrize("what", ["wall", "resolution"])
def test_captures_of_two_sensors(what: str, tmp_path: Path, last_line) -> None:
    (tmp_path / "walls").mkdir()
    for serial in ("SIM1", "SIM2"):
        device = SimulatedDevice(np.zeros((480, 640)), serial=serial)
        written = write_walls(tmp_path / serial, device, WALLS[:1], 1)
        (written / "wall_000").rename(tmp_path / "walls" / serial)
    assert run(["evaluate", what, str(tmp_path / "walls")]) == 1
    assert "The captures come from different sensors: SIM1 (SIM1), SIM2 (SIM2)" in last_line()


def test_correction_of_another_sensor(recorded, tmp_path: Path, perfect, capsys) -> None:
    other = SensorStore(tmp_path / "perfect").folder_of("SIM1")
    text = (other / "sensor.json").read_text().replace("SIM1", "SIM2")
    (tmp_path / "two").mkdir()
    (tmp_path / "two" / "sensor.json").write_text(text)
    device = SimulatedDevice(np.zeros((480, 640)), serial="SIM2")
    walls = write_walls(tmp_path / "walls", device, WALLS[:1], 1)
    correction = str(recorded.sensors / "SIM1" / "correction.npz")
    words = ["evaluate", "wall", str(walls), "--sensor", str(tmp_path / "two")]
    assert run([*words, "--correction", correction]) == 1
    assert "was measured on sensor SIM1, not on SIM2" in capsys.readouterr().err
    assert run([*words, "--correction", correction, "--insist"]) == 0
    assert "Warning: The correction was measured on sensor SIM1" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["evaluate", "wall"], ["calibrate", "distortion"]])
def test_walls_are_not_for_a_camera_of_millimetres(
    recorded, tmp_path: Path, last_line, words: list[str]
) -> None:
    kept = shutil.copytree(recorded.sensors / "SIM1", tmp_path / "SIM1")
    values = json.loads((kept / "sensor.json").read_text())
    del values["disparity"]
    values.pop("disparity_correction", None)
    values |= {"model": "realsense-d415", "depth_unit_mm": 0.1}
    (kept / "sensor.json").write_text(json.dumps(values))
    walls = write_walls(tmp_path / "walls", SimulatedDevice(np.zeros((480, 640))), WALLS[:1], 1)
    assert run([*words, str(walls), "--serial", "SIM1", "--sensors", str(tmp_path)]) == 1
    assert "SIM1 is a realsense-d415, which measures no disparity" in last_line()


def test_resolution(perfect: list[str], tmp_path: Path) -> None:
    device = SimulatedDevice(np.zeros((480, 640)))
    walls = write_walls(tmp_path / "walls", device, [wall(700), wall(950)], 1)
    report = tmp_path / "r.json"
    words = ["evaluate", "resolution", str(walls), *perfect, "--limits", "--report", str(report)]
    assert run(words) == 0
    assert numbers(report)["x_mm"]["value"] == pytest.approx(950 / CAMERA.fx, rel=0.01)


@pytest.mark.slow
def test_alignment_of_infrared_and_colour(recorded, perfect, tmp_path: Path) -> None:
    report = tmp_path / "a.json"
    words = ["evaluate", "alignment", str(recorded.infrared), *perfect, *BOARD_CALL]
    assert run([*words, "--report", str(report)]) == 0
    assert abs(numbers(report)["x_px"]["value"]) < 0.6
    assert abs(numbers(report)["y_px"]["value"]) < 0.6


def test_alignment_of_marked_points(perfect, tmp_path: Path) -> None:
    rays = CAMERA.normalised(np.array([[200.0, 150.0], [500.0, 300.0]]))
    space = np.column_stack([rays, np.ones(2)]) * 800
    shifted = SENSOR.color_pixels(space) + np.array([2.0, -5.0])
    points = [
        {"depth_px": pixel, "depth_mm": 800, "color_px": color.tolist()}
        for pixel, color in zip([[200, 150], [500, 300]], shifted, strict=True)
    ]
    marked, report = tmp_path / "points.json", tmp_path / "a.json"
    marked.write_text(json.dumps({"points": points}))
    words = ["evaluate", "alignment", str(marked), *perfect, "--limits", "--report", str(report)]
    assert run(words) == 1
    assert numbers(report)["x_px"]["value"] == pytest.approx(2, abs=1e-6)
    assert numbers(report)["y_px"]["value"] == pytest.approx(-5, abs=1e-6)


@pytest.mark.slow
def test_board_as_known_object(recorded, perfect, tmp_path: Path) -> None:
    device = SimulatedDevice(np.zeros((480, 640)))
    boards = write_boards(tmp_path / "boards", device, 4)
    report = tmp_path / "o.json"
    words = ["evaluate", "object", str(boards), *perfect, *BOARD_CALL, "--limits"]
    assert run([*words, "--report", str(report)]) == 0
    assert 0.05 < numbers(report)["mean_abs_mm"]["value"] < 0.6


def test_marked_points_of_an_object(perfect, tmp_path: Path) -> None:
    (frame,) = SimulatedDevice(np.zeros((480, 640)), noise_raw=0).frames(wall(800), 1)
    folder = tmp_path / "object"
    folder.mkdir()
    cv2.imwrite(str(folder / "depth_000.png"), frame)
    depth = DISPARITY.depth_mm(frame.astype(float))[240, 300]
    points = [
        {"name": "a", "true_mm": [0, 0, 0], "depth_px": [300, 240]},
        {"name": "b", "true_mm": [100 * depth / CAMERA.fx, 0, 0], "depth_px": [400, 240]},
    ]
    marked, report = tmp_path / "points.json", tmp_path / "o.json"
    marked.write_text(json.dumps({"points": points}))
    words = ["evaluate", "object", str(folder), *perfect, "--points", str(marked)]
    assert run([*words, "--report", str(report)]) == 0
    assert numbers(report)["mean_abs_mm"]["value"] == pytest.approx(0, abs=1e-3)
    points[1]["depth_px"] = [900, 240]
    marked.write_text(json.dumps({"points": points}))
    assert run(words) == 1


@pytest.fixture(scope="session")
def spotted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The blue markers round a foot as the known object, seen by a sensor from two sides."""
    folder = tmp_path_factory.mktemp("spotted")
    small = Path(__file__).parents[3] / "data" / "sessions" / "left_small.zip"
    session = read_session(small)
    for number, view in enumerate(session.views[:2]):
        color = np.ascontiguousarray(view.read_color(0)[..., ::-1])
        cv2.imwrite(str(folder / f"color_{number:03d}.png"), color)
        cv2.imwrite(str(folder / f"depth_{number:03d}.png"), view.read_depth(0))
    write_sensor(session.views[0].sensor, folder)
    sole = session.manifest.reference_system.facing(session.views[0].sensor.faces)
    points = [{"name": m.id, "true_mm": list(m.position_mm)} for m in sole]
    (folder / "points.json").write_text(json.dumps({"points": points}))
    return folder


def test_coloured_spots_of_an_object(spotted: Path, tmp_path: Path, capsys) -> None:
    report = tmp_path / "o.json"
    words = ["evaluate", "object", str(spotted), "--sensor", str(spotted)]
    words += ["--points", str(spotted / "points.json")]
    assert run([*words, "--report", str(report)]) == 0
    found = numbers(report)
    assert 0.1 < found["mean_abs_mm"]["value"] < 1.5
    assert "mean_relative" in found
    assert run([*words, "--paint", "red"]) == 1
    assert "No picture of" in capsys.readouterr().err.strip().splitlines()[-1]


def test_spots_of_another_paint(spotted: Path, tmp_path: Path) -> None:
    for path in spotted.iterdir():
        shutil.copy(path, tmp_path)
    for path in tmp_path.glob("color_*.png"):
        cv2.imwrite(str(path), np.ascontiguousarray(cv2.imread(str(path))[..., ::-1]))
    words = ["evaluate", "object", str(tmp_path), "--sensor", str(tmp_path), "--paint", "red"]
    assert run([*words, "--points", str(tmp_path / "points.json")]) == 0


def spheres(centers: list[list[float]], radius_mm: float, depth_error_mm: float = 0) -> FloatArray:
    """(480, 640) mm: spheres before a wall at 1400 mm."""
    rows = plane_rows(CAMERA)
    depth = np.full((480, 640), 1400.0)
    for center in np.array(centers):
        along, square = rows @ center, (rows**2).sum(-1)
        inside = along**2 - square * (center @ center - radius_mm**2)
        hit = inside > 0
        depth[hit] = (along[hit] - np.sqrt(inside[hit])) / square[hit] + depth_error_mm
    return depth


def write_depth(path: Path, depth_mm: FloatArray) -> None:
    cv2.imwrite(str(path), np.round(DISPARITY.raw(depth_mm)).astype(np.uint16))


@pytest.fixture
def artefact(tmp_path: Path) -> Path:
    folder = tmp_path / "artefact"
    folder.mkdir()
    write_depth(folder / "bar_000.png", spheres([[-100, 0, 800], [100, 0, 800]], 40))
    write_depth(folder / "bar_001.png", spheres([[0, -80, 700], [20, 80, 795]], 40))
    write_depth(folder / "plate_000.png", 1 / (plane_rows(CAMERA) @ wall(800, 5, -10)))
    return folder


def test_artefact_is_judged_without_being_asked(artefact, perfect, tmp_path: Path) -> None:
    report = tmp_path / "a.json"
    words = ["evaluate", "artefact", str(artefact), *perfect, "--diameter", "80"]
    spaced = [*words, "--spacing", "200", "--report", str(report)]
    assert run(spaced) == 1  # The second bar is 187 mm long.
    assert numbers(report)["spacing_mm"]["value"] == pytest.approx(-12.7, abs=0.5)
    (artefact / "bar_001.png").unlink()
    assert run(spaced) == 0
    found = {key: number["value"] for key, number in numbers(report).items()}
    assert abs(found["spacing_mm"]) < 0.3
    assert abs(found["probing_size_mm"]) < 0.5
    assert 0.5 < found["flatness_mm"] < 3


def test_bar_with_one_sphere(artefact, perfect, last_line) -> None:
    write_depth(artefact / "bar_000.png", spheres([[0, 0, 800]], 40))
    words = ["evaluate", "artefact", str(artefact), *perfect]
    assert run([*words, "--diameter", "80", "--spacing", "200"]) == 1
    assert "bar_000.png shows 1 spheres of about 80 mm, but the bar has 2" in last_line()
    (artefact / "bar_000.png").rename(artefact / "something.png")
    assert run([*words, "--diameter", "80", "--spacing", "200"]) == 1
    assert "is neither a bar nor a plate" in last_line()


def test_noise_and_warm_up(perfect, tmp_path: Path) -> None:
    device = SimulatedDevice(np.zeros((480, 640)), noise_raw=0.6)
    walls = write_walls(tmp_path / "still", device, [wall(800)], 8)
    report = tmp_path / "n.json"
    words = ["evaluate", "noise", str(walls / "wall_000"), *perfect, "--limits"]
    assert run([*words, "--every", "60", "--report", str(report)]) == 0
    found = numbers(report)
    assert found["sd_raw"]["value"] == pytest.approx(np.hypot(0.6, 1 / np.sqrt(12)), abs=0.08)
    assert abs(found["drift_mm"]["value"]) < 0.2


def test_noise_of_what_no_distance_has(perfect, tmp_path: Path, last_line) -> None:
    for number in range(3):
        beyond = np.full((480, 640), 2046, np.uint16)
        cv2.imwrite(str(tmp_path / f"depth_{number:03d}.png"), beyond)
    assert run(["evaluate", "noise", str(tmp_path), *perfect]) == 1
    assert "show nothing at a distance that the sensor measures" in last_line()


@pytest.mark.parametrize("key", ["depth_px", "depth_mm", "color_px"])
def test_numbers_that_overflow_are_refused_by_name(
    key: str, perfect, tmp_path: Path, last_line
) -> None:
    point = {"depth_px": [200, 150], "depth_mm": 800, "color_px": [300, 200]}
    point |= {key: 1e308 if key == "depth_mm" else [1e308, 1e308]}
    marked = tmp_path / "points.json"
    marked.write_text(json.dumps({"points": [point]}))
    assert run(["evaluate", "alignment", str(marked), *perfect]) == 1
    assert f"points[0].{key}" in last_line()


WRONG_CALLS = {
    "two sensors": (["wall", "{walls}", "--serial", "A", "--sensor", "x"], "give one of them"),
    "never calibrated": (["wall", "{walls}", "--serial", "A9"], "was never calibrated here"),
    "no object": (["object", "{walls}"], "Name the known object"),
    "no board": (["alignment", "{walls}"], "needs --board and --square"),
    "limit without number": (["wall", "{walls}", "--limit", "mean"], "give the key of a number"),
    "limit below 0": (["wall", "{walls}", "--limit", "mean_abs_mm_raw=-1"], "from 0 on"),
    "no limit": (["wall", "{walls}", "--limit", "mean_abs_mm_raw=nan"], "from 0 on"),
    "report of no kind": (["wall", "{walls}", "--report", "a.txt"], "let it end in"),
}


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_wrong_calls(name: str, recorded, last_line) -> None:
    words, expected = WRONG_CALLS[name]
    filled = [word.format(walls=recorded.walls) for word in words]
    assert run(["evaluate", *filled, "--sensors", str(recorded.sensors)]) == 2
    assert expected in last_line()


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.usefixtures("undrawn_reports")
def test_real_sensor(shared_data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kinect, kept = shared_data / "kinect_v1", ["--serial", "XW1120", "--sensors", str(tmp_path)]
    board = ["--board", "10x7", "--square", "30"]
    assert run(["calibrate", "color", str(kinect / "board_1"), *board, *kept]) == 0
    assert run(["calibrate", "distortion", str(kinect / "walls_1"), *kept]) == 0
    assert run(["calibrate", "stereo", str(kinect / "board_1"), *board, *kept]) == 0
    assert "differ by" not in capsys.readouterr().err
    sensor = SensorStore(tmp_path).load("XW1120")
    assert sensor is not None
    for focal in (sensor.color_camera.fx, sensor.color_camera.fy):
        assert 525 < focal < 526
    assert np.linalg.norm(sensor.depth2color[:3, 3]) == pytest.approx(25, abs=2.5)
    assert rotation_angle_deg(sensor.depth2color[:3, :3]) < 2
    camera = json.loads((tmp_path / "XW1120" / "camera.json").read_text())
    found = camera["sections"]["camera"]["numbers"]
    assert found["pictures"]["value"] == 15
    assert found["rms_px"]["value"] <= 0.24
    parameters = {
        row["parameter"]: row for row in camera["sections"]["camera"]["tables"]["Parameters"]
    }
    assert float(parameters["fx"]["standard deviation"]) < 2
    report = tmp_path / "object.json"
    words = ["evaluate", "object", str(kinect / "board_1"), *board, *kept]
    assert run([*words, "--report", str(report)]) == 0
    assert numbers(report)["mean_abs_mm"]["value"] < 1.24
    walls = ["--distances", "465", "491", "599", "676", "761", "838"]
    assert run(["calibrate", "disparity", str(kinect / "walls_1"), *walls, *kept]) == 0
    told = re.search(r"Warning: Depths at \d+ mm differ by -([\d.]+)%", capsys.readouterr().err)
    assert told is not None
    assert 4 < float(told[1]) < 6, "a tape and a board of 30 mm contradict each other"


@pytest.mark.slow
@pytest.mark.shared
def test_real_walls_left_out(shared_data: Path, tmp_path: Path) -> None:
    report = tmp_path / "wall.json"
    folder = shared_data / "kinect_v1" / "walls_1"
    words = ["evaluate", "wall", str(folder), "--leave-one-out", "--limits"]
    assert run([*words, "--report", str(report)]) == 0
    assert numbers(report, "wall")["mean_abs_mm_corrected"]["limit"] == 1.0
    rows = json.loads(report.read_text())["sections"]["wall"]["tables"]["Walls"]
    raw = [float(row["mean abs"]) for row in rows if row["correction"] == "raw"]
    assert all(1.8 < one < 2.6 for one in raw[2:])
    default = [float(row["mean abs"]) for row in rows if row["correction"] == "default"]
    for error_mm, limit_mm in zip(default[2:], [0.80, 0.80, 0.80, 1.05], strict=True):
        assert error_mm <= limit_mm


def test_whose_numbers_are_used_without_a_sensor_is_told(
    one_wall, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["evaluate", "wall", str(one_wall)]) == 0
    said = "that Burrus published for a Kinect v1 are used, whose depths are about 5 % less"
    assert said in capsys.readouterr().err
    usual_mm = np.array([500.0, 700.0, 1000.0])
    share = nominal_kinect("").disparity.depth_mm(USUAL_DEPTH.raw(usual_mm)) / usual_mm
    assert share == pytest.approx(0.95, abs=0.01)
