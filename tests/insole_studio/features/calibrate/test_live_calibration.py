"""A technician calibrates a sensor with live pictures; recorded ones play as the sensor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot
from simulated_board import board_poses, chequer_print, photograph
from simulated_device import SimulatedDevice, wall
from simulated_folders import BOARD, SENSOR

from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.geometry.side import Side
from insole_core.recording.sensor_folder import read_sensor
from insole_core.recording.session import Manifest, Session, View
from insole_core.recording.writer import write_session
from insole_core.resources import resource_path
from insole_core.sensing.metric_depth import StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.features.calibrate.rows import BoardSize
from insole_studio.features.calibrate.stage import CalibrateStage

WALL_MM = 700.0


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One sensor that sees a board in colour and a wall in depth."""
    texture = chequer_print(BOARD.columns, BOARD.rows, 30)
    (placed,) = board_poses(2, 1, BOARD.points_mm.mean(0), 600)
    placed[:3, 3] -= placed[:3, :2] @ np.full(2, 1.5 * BOARD.square_mm)
    grey = photograph(texture, 1.0, placed, SENSOR.color_camera)
    color = np.repeat(grey[..., None], 3, axis=-1)
    depth = list(SimulatedDevice(np.zeros((480, 640))).frames(wall(WALL_MM, 3, -2), 4))
    view = View("left", SENSOR, len(depth), 1, lambda index: depth[index], lambda _index: color)
    manifest = Manifest(
        "2026-01-01T00:00:00+00:00",
        Side.LEFT,
        load_reference_system(resource_path(DEFAULT_SYSTEM)),
        ("left",),
    )
    path = tmp_path_factory.mktemp("recording") / "session"
    write_session(Session(manifest, (view,), "simulated"), path)
    return path


@pytest.fixture
def stage(qtbot: QtBot, tmp_path: Path, recording: Path) -> Iterator[CalibrateStage]:
    store = SensorStore(tmp_path / "sensors")
    built = CalibrateStage(store, SensorSource(store, recording), tmp_path / "pictures")
    built.show()
    built.view.show_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    built.presenter.edit_board(built.view.board())
    yield built
    built.close()
    built.deleteLater()


def said(stage: CalibrateStage) -> str:
    """What is said of the live picture."""
    return stage.view.live_sentence.text()


@pytest.mark.slow
def test_a_board_that_stands_still_is_taken_once(
    stage: CalibrateStage, qtbot: QtBot, tmp_path: Path
) -> None:
    stage.view.live.click()
    qtbot.waitUntil(lambda: stage.view.looks.count() == 1)
    assert stage.view.serial_line.text() == "SIM1"
    assert stage.view.looks.item(0).text().startswith("✓  color_000.png: 54 corners, ")
    assert "Take 9 more pictures" in stage.view.next_steps.text()
    qtbot.waitUntil(lambda: said(stage).startswith("54 corners, "))
    (day,) = (tmp_path / "pictures" / "SIM1").iterdir()
    assert {path.name for path in (day / "camera").iterdir()} == {
        "color_000.png", "depth_000.png", "depth_000",
    }  # fmt: skip
    assert len(list((day / "camera" / "depth_000").glob("*.png"))) == 10
    stage.view.take.click()  # by hand as often as one likes
    qtbot.waitUntil(lambda: stage.view.looks.count() == 2)
    stage.view.live.click()
    assert said(stage) == ""
    assert not stage.view.take.isVisible()


@pytest.fixture
def stereo(qtbot: QtBot, tmp_path: Path) -> Iterator[CalibrateStage]:
    """A RealSense that nobody has calibrated, before a wall at 520 mm."""
    pytest.importorskip("pyrealsense2", reason="pyrealsense2 plays the cameras, and is missing")
    camera = PinholeCamera(160, 96, 115.0, 115.0, 80.0, 48.0)
    sensor = replace(
        SENSOR, model="realsense-d415", serial="D1", depth_camera=camera, color_camera=camera,
        disparity=StereoDisparity(115.0, 55.0), depth_unit_mm=0.1, baseline_mm=55.0,
    )  # fmt: skip
    depth, color = np.full((96, 160), 5200, np.uint16), np.full((96, 160, 3), 90, np.uint8)
    view = View("left", sensor, 1, 1, lambda _index: depth, lambda _index: color)
    system = load_reference_system(resource_path(DEFAULT_SYSTEM))
    manifest = Manifest("2026-01-01T00:00:00+00:00", Side.LEFT, system, ("left",), metric=True)
    write_session(Session(manifest, (view,), "simulated"), tmp_path / "session")
    store = SensorStore(tmp_path / "sensors")
    source = SensorSource(store, tmp_path / "session")
    built = CalibrateStage(store, source, tmp_path / "pictures")
    built.show()
    yield built
    built.close()
    built.deleteLater()


def test_of_a_realsense_only_the_walls_are_left(
    stereo: CalibrateStage, qtbot: QtBot, tmp_path: Path
) -> None:
    stereo.view.automatic.setChecked(False)
    stereo.view.live.click()
    qtbot.waitUntil(lambda: "a wall at 52" in said(stereo))
    assert stereo.view.steps.currentRow() == 1
    stereo.view.take.click()
    qtbot.waitUntil(lambda: stereo.view.looks.count() == 1)
    wanted = "Capture the wall at about these distances: 400, 600, 700 mm."
    assert wanted in stereo.view.next_steps.text()
    (kept,) = (tmp_path / "pictures" / "D1").glob("*/distortion/wall_000/sensor.json")
    assert read_sensor(kept.parent).depth_unit_mm == 0.1
    stereo.view.steps.setCurrentRow(0)
    assert "calibrate only the distortion of its depth" in stereo.view.error.text()


@pytest.mark.slow
def test_each_step_takes_its_own_pictures_of_one_sensor(
    stage: CalibrateStage, qtbot: QtBot, tmp_path: Path
) -> None:
    """Colour, the wall with its distance, infrared in place of colour, a wall of dots."""

    def waits_for(beginning: str) -> None:
        qtbot.waitUntil(lambda: said(stage).startswith(beginning))

    def taken(beginning: str) -> None:
        qtbot.waitUntil(lambda: stage.view.looks.count() == 1)
        assert stage.view.looks.item(0).text().startswith(beginning)

    stage.view.automatic.setChecked(False)
    stage.view.live.click()
    waits_for("54 corners, ")
    stage.view.take.click()
    assert said(stage).startswith("Taking the picture")
    stage.view.steps.setCurrentRow(1)  # what is being taken stays with its step
    qtbot.waitUntil(lambda: "a wall at 700 mm" in said(stage))
    (day,) = (tmp_path / "pictures" / "SIM1").iterdir()
    assert [path.name for path in day.iterdir()] == ["camera"]
    assert (day / "camera" / "color_000.png").is_file()
    assert stage.view.looks.count() == 0
    stage.view.take.click()
    qtbot.waitUntil(lambda: stage.view.looks.count() == 1)
    text = stage.view.next_steps.text()
    assert "Capture the wall at about these distances: 500, 600, 800, 900, 1000 mm." in text

    stage.view.steps.setCurrentRow(2)
    waits_for("54 corners, ")
    assert stage.view.looks.count() == 0
    stage.view.automatic.setChecked(True)
    taken("✓  ir_000.png: 54 corners, ")
    stage.view.automatic.setChecked(False)
    (kept,) = (day / "depth_camera").iterdir()
    infrared = cv2.imread(str(kept), cv2.IMREAD_UNCHANGED)
    assert (infrared.shape, infrared.dtype) == ((480, 640), np.uint8)
    stage.view.steps.setCurrentRow(0)
    waits_for("54 corners, ")
    taken("✓  color_000.png: 54 corners, ")

    stage.view.steps.setCurrentRow(4)
    qtbot.waitUntil(lambda: "a wall at 700 mm" in said(stage))
    assert stage.view.looks.count() == 0
    stage.view.take.click()
    taken("✓  infrared_00.png: a wall at 700 mm")
    text = stage.view.next_steps.text()
    assert "Take 7 more walls at other distances." in text
    assert "Capture the wall at about these distances: 600, 800, 900 mm." in text
    folder = day / "infrared_pattern"
    names = {"infrared_00.png", "depth_00.png", "sensor.json"}
    assert {path.name for path in folder.iterdir()} == names
    (wall,) = read_infrared_walls(folder, "SIM1")
    assert wall.shift_px == (4.8, 3.9)
    assert not stage.view.check.isEnabled()


@pytest.mark.slow
def test_with_a_live_picture_its_sensor_is_offered_and_nothing_asks_to_start_it(
    stage: CalibrateStage, qtbot: QtBot, tmp_path: Path
) -> None:
    view = stage.view
    SensorStore(tmp_path / "sensors").save(nominal_kinect("OLD1"))
    give = "Give the serial number of the sensor, as it stands on its label."
    assert give in view.next_steps.text()
    view.automatic.setChecked(False)
    view.live.click()
    qtbot.waitUntil(lambda: said(stage).startswith("54 corners, "))
    assert "Take pictures, or choose the folder" in view.next_steps.text()
    view.steps.setCurrentRow(1)
    assert view._picture.accessibleName() == "Waiting for the first picture."
    assert "Start the live picture" not in view.next_steps.text()
    assert [view.serial.itemText(i) for i in range(view.serial.count())] == ["SIM1", "OLD1"]
    view.serial.setFocus()
    qtbot.keyClick(view.serial, Qt.Key.Key_Down)
    assert stage.presenter.serial == "OLD1"
    qtbot.keyClick(view.serial, Qt.Key.Key_Up)
    assert stage.presenter.serial == "SIM1"
    view.live.click()
    assert "Start the live picture" in view.next_steps.text()


@pytest.mark.slow
@pytest.mark.parametrize("step", [0, 2])
@pytest.mark.parametrize("by_itself", [False, True])
def test_a_picture_of_one_sensor_is_never_kept_as_that_of_another(
    stage: CalibrateStage, qtbot: QtBot, tmp_path: Path, step: int, by_itself: bool
) -> None:
    view = stage.view
    view.automatic.setChecked(False)
    view.live.click()
    qtbot.waitUntil(lambda: view.serial_line.text() == "SIM1")
    view.steps.setCurrentRow(step)
    qtbot.waitUntil(lambda: said(stage).startswith("54 corners, "))
    assert view.take.isEnabled()
    assert view.take.toolTip() == ""

    view.serial_line.setFocus()
    view.serial_line.selectAll()
    qtbot.keyClicks(view.serial_line, "SIM2")
    view.automatic.setChecked(by_itself)
    qtbot.keyClick(view.serial_line, Qt.Key.Key_Return)
    view.steps.setCurrentRow(step)
    assert view._picture._image.isNull()
    qtbot.waitUntil(lambda: said(stage) == "Sensor SIM2 is not connected.")
    assert not view.take.isEnabled()
    assert view.take.toolTip() == "The sensor is not plugged in."
    assert view._picture.accessibleName() == "Sensor SIM2 is not connected."
    stage.live.take()  # as the key of the button, or a picture that was looked at before
    qtbot.wait(1200)  # three times as long as until the next look
    assert not list((tmp_path / "pictures").rglob("*.png"))
    assert said(stage) == "Sensor SIM2 is not connected."

    view.serial_line.selectAll()
    qtbot.keyClicks(view.serial_line, "SIM1")
    qtbot.keyClick(view.serial_line, Qt.Key.Key_Return)
    view.steps.setCurrentRow(step)
    qtbot.waitUntil(lambda: said(stage).startswith("54 corners, "))
    if not by_itself:
        view.take.click()
    qtbot.waitUntil(lambda: view.looks.count() == 1)
    kept = [path.relative_to(tmp_path / "pictures") for path in tmp_path.rglob("*_000.png")]
    assert {path.parts[0] for path in kept} == {"SIM1"}


@pytest.mark.slow
def test_a_service_that_died_is_told_and_the_live_picture_starts_another(
    stage: CalibrateStage, qtbot: QtBot
) -> None:
    stage.view.live.click()
    qtbot.waitUntil(lambda: stage.live._live.taking)
    assert stage.live._live._service is not None
    stage.live._live._service._process.kill()
    qtbot.waitUntil(lambda: "has ended" in said(stage))
    assert not stage.live._live.taking
    stage.view.live.click()
    stage.view.live.click()
    qtbot.waitUntil(lambda: stage.view.looks.count() == 1)
