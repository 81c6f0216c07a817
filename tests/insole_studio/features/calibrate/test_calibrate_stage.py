"""A technician calibrates a sensor in the window, from folders of pictures."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from real_dialogs import answering
from simulated_device import WALLS, SimulatedDevice, smooth_distortion, wall
from simulated_folders import BOARD, write_boards, write_walls
from simulated_infrared import dots, write_infrared, write_infrared_walls

from insole_core.calibration.plausibility import USUAL_DEPTH
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.infrared_reference import InfraredReference, ReferenceRecord
from insole_core.sensing.sensor import BURRUS, nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.bootstrap import Application
from insole_studio.features.calibrate.rows import BoardSize
from insole_studio.features.calibrate.stage import CalibrateStage
from insole_studio.services.questions import Answer

pytestmark = pytest.mark.usefixtures("undrawn_reports")


class Chosen:
    """Answers the question for a folder."""

    def __init__(self) -> None:
        self.folder: Path | None = None

    def __call__(self) -> Path | None:
        return self.folder


class Asked:
    """Answers whether to save all the same, and keeps what was asked."""

    def __init__(self) -> None:
        self.sentences: list[str] = []
        self.answer = False

    def __call__(self, sentence: str) -> bool:
        self.sentences.append(sentence)
        return self.answer


@pytest.fixture(scope="session")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    device = SimulatedDevice(smooth_distortion(3, 3.0), disparity=USUAL_DEPTH)
    write_boards(folder / "boards", device, 5)
    write_walls(folder / "walls", device, WALLS[:3], 1)
    return folder


@pytest.fixture(scope="session")
def dots_of_walls(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Infrared pictures of four walls, and one that is dark."""
    device = SimulatedDevice(smooth_distortion(3, 0.5), disparity=USUAL_DEPTH)
    planes = [wall(620, 3, -2), wall(690, -4, 1), wall(790, 0, 4), wall(900, 2, -3)]
    folder = tmp_path_factory.mktemp("dots") / "walls"
    write_infrared_walls(folder, device, dots(1), planes)
    write_infrared(folder / "infrared_04.png", np.full((480, 640), 64.0))
    shutil.copy(folder / "depth_03.png", folder / "depth_04.png")
    return folder


@pytest.fixture
def chosen() -> Chosen:
    return Chosen()


@pytest.fixture
def asked() -> Asked:
    return Asked()


@pytest.fixture
def stage(
    qapp: QApplication, qtbot: QtBot, tmp_path: Path, chosen: Chosen, asked: Asked
) -> Iterator[CalibrateStage]:
    store = SensorStore(tmp_path / "sensors")
    built = CalibrateStage(store, SensorSource(store), tmp_path / "pictures", chosen, asked)
    built.show()
    yield built
    built.presenter.drop_result()
    built.close()
    built.deleteLater()


@pytest.fixture
def settle(qtbot: QtBot, stage: CalibrateStage) -> Callable[[], None]:
    return lambda: qtbot.waitUntil(lambda: not stage.jobs.is_running())


def give_serial(stage: CalibrateStage, serial: str = "SIM1") -> None:
    stage.view.serial_line.setText(serial)
    stage.view.serial_line.editingFinished.emit()


def step_lines(stage: CalibrateStage) -> list[str]:
    return [stage.view.steps.item(i).text() for i in range(stage.view.steps.count())]


def test_begins_with_the_serial_number(stage: CalibrateStage) -> None:
    assert "serial number" in stage.view.next_steps.text()
    view = stage.view
    assert not view.choose.isEnabled()
    assert "serial number" in view.choose.toolTip()
    give_serial(stage)
    assert view.choose.isEnabled()
    assert view.choose.toolTip() == ""
    told = {
        view.calibrate: "Take pictures, or choose the folder with these images.",
        view.save: "There is no result to save yet.",
        view.undo: "Nothing was saved that can be undone.",
    }
    for button, why_not in told.items():
        assert not button.isEnabled()
        assert button.toolTip() == button.accessibleDescription() == why_not
    assert all("to do" in line for line in step_lines(stage))


def test_a_pattern_kept_by_the_command_is_done(stage: CalibrateStage, tmp_path: Path) -> None:
    store = SensorStore(tmp_path / "sensors")
    store.save(nominal_kinect("SIM1"))
    give_serial(stage)
    assert "to do" in step_lines(stage)[4]

    flat = DisparityCorrection(np.zeros((480, 640), np.float32))
    record = ReferenceRecord("SIM1", "2026-03-04T10:00:00+00:00")
    store.keep_reference(InfraredReference(np.ones((480, 640), np.float32), 0, 1, flat, record))
    stage.view.steps.setCurrentRow(4)
    assert "done on 2026-03-04" in step_lines(stage)[4]


def test_what_is_no_serial_number(stage: CalibrateStage) -> None:
    give_serial(stage, "../x")
    assert "is no serial number" in stage.view.error.text()
    assert not stage.view.choose.isEnabled()


@pytest.mark.slow
def test_colour_camera_from_folder_to_device(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle, tmp_path: Path
) -> None:
    give_serial(stage)
    stage.view.show_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    stage.presenter.edit_board(stage.view.board())
    chosen.folder = pictures / "boards"
    stage.view.choose.click()
    settle()
    assert "5 of 5 can be used." in stage.view.next_steps.text()
    assert "Take 5 more pictures" in stage.view.next_steps.text()
    assert "Hold the board in these parts" in stage.view.next_steps.text()
    assert stage.view.looks.item(0).text().startswith("✓  color_000.png: 54 corners, ")
    stage.view.calibrate.click()
    settle()
    assert "5 of 5 colour pictures were used" in stage.view.next_steps.text()
    assert not (tmp_path / "sensors").exists()
    stage.view.save.click()
    settle()
    sensor = SensorStore(tmp_path / "sensors").load("SIM1")
    assert sensor is not None
    assert sensor.color_camera.width == 640
    assert "Colour camera is saved for sensor SIM1." in stage.view.next_steps.text()
    assert "Next: Distortion of the depth." in stage.view.next_steps.text()
    assert "done on 20" in step_lines(stage)[0]
    assert stage.view.steps.currentRow() == 1


def test_a_button_has_the_focus_again_when_it_has_worked(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle, qtbot: QtBot
) -> None:
    view = stage.view
    chosen.folder = pictures / "boards"
    give_serial(stage)
    view.show_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    stage.presenter.edit_board(view.board())
    for button in (view.choose, view.calibrate):
        button.setFocus()
        qtbot.keyClick(button, Qt.Key.Key_Space)
        assert not button.isEnabled()
        assert stage.focusWidget() is view.steps
        settle()
        assert stage.focusWidget() is button
    view.save.setFocus()
    qtbot.keyClick(view.save, Qt.Key.Key_Space)
    settle()
    assert not view.save.isEnabled()  # there is nothing to save any more
    assert stage.focusWidget() is view.steps
    assert view.serial_line.text() == "SIM1"


@pytest.mark.slow
def test_a_result_is_left_only_once_it_was_saved_or_dropped(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle, tmp_path: Path, qtbot: QtBot
) -> None:
    view, store = stage.view, SensorStore(tmp_path / "sensors")
    store.save(nominal_kinect("SIM2"))
    chosen.folder = pictures / "boards"

    def calibrate() -> None:
        view.steps.setCurrentRow(0)
        for button in (view.choose, view.calibrate):
            button.click()
            settle()
        assert view.save.isEnabled()

    def is_kept() -> bool:
        return view.save.isEnabled() and "Save it, if this" in view.next_steps.text()

    give_serial(stage)
    view.show_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    stage.presenter.edit_board(view.board())
    calibrate()
    asked = "The result of the step Colour camera is not saved."
    for leave in (
        lambda: view.steps.setCurrentRow(1),
        lambda: _click_step(stage, 1),
        lambda: _type_serial(stage, qtbot, "SIM2"),
        lambda: view._columns.setValue(7),
        view.choose.click,
        stage.live.take,
        stage.close,
    ):
        with answering("Go on working") as answers:
            leave()
        assert answers.asked == [asked]
        assert is_kept()
        assert stage.isVisible()
        assert (view.steps.currentRow(), view.serial_line.text()) == (0, "SIM1")
        assert [index.row() for index in view.steps.selectedIndexes()] == [0]
        assert view.board().columns == BOARD.columns
    with answering("Drop the result"):
        _click_step(stage, 1)
    assert view.steps.currentRow() == 1
    assert [index.row() for index in view.steps.selectedIndexes()] == [1]
    assert not view.save.isEnabled()
    assert store.load("SIM1") is None

    calibrate()
    chosen.folder = None  # no folder is chosen: then nothing is asked, and nothing left
    view.choose.click()
    assert is_kept()
    chosen.folder = pictures / "boards"
    with answering("Drop the result"):
        stage.live.take()  # of which nothing comes: no sensor is there
    assert not view.save.isEnabled()
    assert "Save it, if this" not in view.next_steps.text()
    calibrate()
    with answering("Save to the device"):
        view.steps.setCurrentRow(3)
    settle()
    assert store.load("SIM1") is not None
    assert view.steps.currentRow() == 3
    assert "done on 20" in step_lines(stage)[0]

    calibrate()
    with answering("Drop the result"), qtbot.waitSignal(stage.closed):
        stage.close()


def _click_step(stage: CalibrateStage, row: int) -> None:
    steps = stage.view.steps
    place = steps.visualItemRect(steps.item(row)).center()
    QTest.mouseClick(steps.viewport(), Qt.MouseButton.LeftButton, pos=place)


def _type_serial(stage: CalibrateStage, qtbot: QtBot, serial: str) -> None:
    line = stage.view.serial_line
    line.setFocus()
    line.selectAll()
    qtbot.keyClicks(line, serial)
    qtbot.keyClick(line, Qt.Key.Key_Return)


@pytest.mark.slow
def test_walls_say_which_distances_are_missing_and_need_a_place_that_can_be_written(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle, tmp_path: Path
) -> None:
    give_serial(stage)
    stage.view.steps.setCurrentRow(1)
    chosen.folder = pictures / "walls"
    stage.view.choose.click()
    settle()
    text = stage.view.next_steps.text()
    assert "Capture the wall at about these distances: 500, 900, 1000 mm." in text
    assert "Fill these parts" not in text
    stage.view.calibrate.click()
    settle()
    assert "3 of 3 walls were used" in stage.view.next_steps.text()
    assert "six distances or more are better" in stage.view.next_steps.text()
    (tmp_path / "sensors").write_text("in the way")
    stage.view.save.click()
    settle()
    assert "cannot be written" in stage.view.error.text()
    assert stage.view.save.isEnabled()


def test_a_folder_without_the_board(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle, tmp_path: Path
) -> None:
    give_serial(stage)
    shutil.copy(pictures / "boards" / "color_000.png", tmp_path)
    chosen.folder = tmp_path
    stage.view.choose.click()  # The usual board has other corners.
    settle()
    assert "0 of 1 can be used." in stage.view.next_steps.text()
    assert (
        stage.view.looks.item(0).text().startswith("✗  color_000.png: a chequerboard is seen, but")
    )
    assert not stage.view.calibrate.isEnabled()


def test_a_step_before_its_time(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, settle
) -> None:
    give_serial(stage)
    stage.presenter.edit_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    stage.presenter.choose_step("stereo")
    chosen.folder = pictures / "boards"
    stage.view.choose.click()
    settle()
    stage.view.calibrate.click()
    settle()
    assert "was not calibrated yet" in stage.view.error.text()
    assert not stage.view.save.isEnabled()


@pytest.mark.slow
def test_what_does_not_fit_a_kinect_is_saved_only_when_confirmed(
    stage: CalibrateStage, chosen: Chosen, asked: Asked, pictures: Path, settle, tmp_path: Path
) -> None:
    give_serial(stage)
    stage.presenter.edit_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm * 0.8))
    chosen.folder = pictures / "boards"
    for key in ("camera", "stereo"):
        stage.presenter.choose_step(key)
        for button in (stage.view.choose, stage.view.calibrate, stage.view.save):
            button.click()
            settle()
        assert bool(asked.sentences) is (key == "stereo")
    (sentence,) = asked.sentences
    assert "does not fit a Kinect v1" in sentence
    likely = re.search(r"the square of the board is more likely ([\d.]+) mm than 24 mm", sentence)
    assert likely is not None, sentence
    assert float(likely[1]) == pytest.approx(BOARD.square_mm, abs=0.6)
    assert stage.view.error.text() == sentence
    store = SensorStore(tmp_path / "sensors")
    before = store.load("SIM1")
    assert before is not None
    assert before.disparity == BURRUS
    asked.answer = True
    stage.view.save.click()
    settle()
    after = store.load("SIM1")
    assert after is not None
    assert after.disparity != BURRUS
    assert "Depth to colour is saved for sensor SIM1." in stage.view.next_steps.text()
    assert stage.view.error.text() == ""
    stage.presenter.edit_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    stage.presenter.choose_step("stereo")
    for button in (stage.view.choose, stage.view.calibrate):
        button.click()
        settle()
    said = stage.view.next_steps.text()
    assert re.search(r"differ by \+2\d\.\d% from the scale that was calibrated", said), said


def test_a_calibration_that_cannot_be_read_is_undone_in_the_window(
    stage: CalibrateStage, settle, tmp_path: Path
) -> None:
    store = SensorStore(tmp_path / "sensors")
    store.save(nominal_kinect("SIM1"))
    file = store.save(nominal_kinect("SIM1")) / "sensor.json"
    file.write_text(file.read_text().replace(f"{BURRUS.b}", f"{-BURRUS.b}"))
    assert not stage.view.undo.isEnabled()
    give_serial(stage)
    assert "undo its last step under Calibrate sensors" in stage.view.error.text()
    assert not stage.view.choose.isEnabled()
    stage.view.undo.click()
    settle()
    assert stage.view.error.text() == ""
    assert "Sensor SIM1 is as it was before the last change." in stage.view.next_steps.text()
    assert stage.view.choose.isEnabled()
    assert store.load("SIM1") is not None


def test_a_folder_that_is_not_there(stage: CalibrateStage, chosen: Chosen, settle) -> None:
    give_serial(stage)
    chosen.folder = Path("/nowhere/at/all")
    stage.view.choose.click()
    settle()
    assert "There is no folder" in stage.view.error.text()


def test_closing_stops_the_work(
    stage: CalibrateStage, chosen: Chosen, pictures: Path, qtbot: QtBot
) -> None:
    give_serial(stage)
    chosen.folder = pictures / "boards"
    stage.view.choose.click()
    with qtbot.waitSignal(stage.closed):
        stage.close()
    assert not stage.jobs.is_running()


def test_opened_from_the_menu_and_closed_with_the_program(app: Application) -> None:
    app.controller.run_action("calibrate", False)
    opened = app.features.calibrate.stage
    assert opened is not None
    assert opened.isVisible()
    app.controller.run_action("calibrate", False)
    assert app.features.calibrate.stage is opened
    app.features.calibrate.close()
    assert app.features.calibrate.stage is None


def test_the_program_asks_about_a_result_before_it_ends(
    app: Application, questions: CannedQuestions, pictures: Path, qtbot: QtBot
) -> None:
    app.controller.run_action("calibrate", False)
    stage = app.features.calibrate.stage
    assert stage is not None
    give_serial(stage)
    stage.presenter.edit_board(BoardSize(BOARD.columns, BOARD.rows, BOARD.square_mm))
    for work in (lambda: stage.presenter.look_at(pictures / "boards"), stage.view.calibrate.click):
        work()
        qtbot.waitUntil(lambda: not stage.jobs.is_running())
    ended: list[bool] = []
    app.controller.closed.connect(lambda: ended.append(True))
    questions.unsaved = Answer.CANCEL
    app.controller.quit()
    assert questions.asked == ["result Colour camera"]
    assert ended == []
    assert stage.presenter.has_result
    questions.unsaved = Answer.DISCARD
    app.controller.quit()
    assert ended == [True]


@pytest.mark.slow
def test_the_pattern_of_dots_is_learnt_kept_and_checked(
    stage: CalibrateStage, chosen: Chosen, dots_of_walls: Path, settle, tmp_path: Path
) -> None:
    store = SensorStore(tmp_path / "sensors")
    store.save(replace(nominal_kinect("SIM1"), disparity=USUAL_DEPTH))
    give_serial(stage)
    stage.view.steps.setCurrentRow(4)
    assert not stage.view.check.isHidden()
    chosen.folder = dots_of_walls
    stage.view.choose.click()
    settle()
    looks = [stage.view.looks.item(i).text() for i in range(stage.view.looks.count())]
    assert looks[0].startswith("✓  infrared_00.png: a wall at 6")
    assert looks[4].startswith("✗  infrared_04.png")
    assert "is almost dark; uncover the emitter" in looks[4]
    assert "Take 4 more walls at other distances." in stage.view.next_steps.text()
    assert not stage.view.check.isEnabled()

    stage.view.calibrate.click()
    settle()
    said = stage.view.next_steps.text()
    assert "4 of 5 walls were used, 6" in said
    assert "of the pattern was seen often enough" in said
    assert "infrared_04.png was left out" in said
    assert store.reference("SIM1") is None
    stage.view.save.click()
    settle()
    kept = store.reference("SIM1")
    assert kept is not None
    assert kept.record.serial == "SIM1"
    assert "done on 20" in step_lines(stage)[4]

    stage.view.steps.setCurrentRow(4)
    one = tmp_path / "one"
    shutil.copytree(dots_of_walls, one, ignore=shutil.ignore_patterns("*_04.png", "*_03.png"))
    chosen.folder = one
    stage.view.choose.click()
    settle()
    stage.view.check.click()
    settle()
    assert "By infrared_02.png the pattern of 20" in stage.view.next_steps.text()
    assert stage.view.error.text() == ""

    (one / "sensor.json").write_text('{"serial": "OTHER"}')
    stage.view.check.click()
    settle()
    assert "were recorded with sensor OTHER" in stage.view.error.text()


def test_too_few_walls_of_dots_are_told(
    stage: CalibrateStage, chosen: Chosen, dots_of_walls: Path, settle, tmp_path: Path
) -> None:
    give_serial(stage)
    stage.view.steps.setCurrentRow(4)
    chosen.folder = tmp_path / "few"
    shutil.copytree(
        dots_of_walls, chosen.folder, ignore=shutil.ignore_patterns("*_02.png", "*_03.png")
    )
    stage.view.choose.click()
    settle()
    stage.view.calibrate.click()
    settle()
    assert "Only 2 walls can be used, but the pattern needs 4 or more" in stage.view.error.text()
    assert not stage.view.save.isEnabled()
