"""Capture as the window offers it: from the emulated sensors to a foot on the bench."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from pointing import LEFT
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget
from pytestqt.qtbot import QtBot
from real_dialogs import answering

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.features.capture.capture_window import CaptureWindow
from insole_studio.features.capture.presenter import CapturePresenter
from insole_studio.features.capture.stage import CaptureStage
from insole_studio.user_paths import UserPaths


@pytest.fixture
def emulating(
    qapp: QApplication, qtbot: QtBot, paths: UserPaths, small_session: Path
) -> Iterator[Application]:
    built = build_application(qapp, paths, small_session)
    built.window.resize(960, 640)
    built.window.show()
    qtbot.waitExposed(built.window)
    yield built
    for dialog in list(built.services.messages.dialogs):
        dialog.done(0)
    built.autosave.forget()
    built.close()


@pytest.fixture
def settle_jobs(emulating: Application, qtbot: QtBot) -> Callable[[], None]:
    return lambda: qtbot.waitUntil(lambda: not emulating.jobs.is_running())


def opened_stage(application: Application) -> CaptureStage:
    application.controller.run_action("capture", False)
    stage = application.features.capture.stage
    assert stage is not None
    return stage


@pytest.mark.slow
def test_a_captured_foot_comes_onto_the_bench(
    emulating: Application, qtbot: QtBot, paths: UserPaths
) -> None:
    stage = opened_stage(emulating)
    presenter = stage.presenter

    def ready(is_ready: Callable[[], bool]) -> None:
        qtbot.waitUntil(is_ready)

    ready(lambda: len([s for s in presenter._sensors.states if s.fps > 0]) == 3)
    stage.view.capture_requested.emit()
    ready(lambda: len(presenter._finished) == 3 and not presenter.is_capturing)
    stage.view.use_requested.emit()
    ready(lambda: emulating.case.foot is not None)
    ready(lambda: not emulating.jobs.is_running())
    assert emulating.features.capture.stage is None
    assert emulating.settings.recent[0].startswith(str(paths.data_folder / "sessions"))


@pytest.mark.slow
def test_one_view_of_three_takes_the_place_of_no_foot_unasked(
    emulating: Application,
    qtbot: QtBot,
    settle_jobs: Callable[[], None],
    make_foot: Callable[[Side], Foot],
) -> None:
    case = emulating.case
    foot = FootRecord.begun(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/a.ply", "1" * 64))
    order = OrderNote("IS-261128-AB12", 1)
    case.open(replace(CaseRecord.of_foot(foot, Patient(name="Anna")), order=order), None)
    settle_jobs()
    stage = opened_stage(emulating)
    presenter, view = stage.presenter, stage.view
    qtbot.waitUntil(lambda: len([s for s in presenter._sensors.states if s.fps > 0]) == 3)
    view._edit(frames=60)
    qtbot.mouseClick(view._capture, LEFT)
    qtbot.waitUntil(lambda: len(_complete(presenter)) == 1)
    qtbot.mouseClick(view._cancel, LEFT)
    qtbot.waitUntil(view._use.isEnabled)
    assert view._sentence.text() == "The capture was stopped. 1 of 3 views are there."
    with answering("Go on capturing") as answers:
        qtbot.mouseClick(view._use, LEFT)
    assert answers.asked == ["1 of 3 views are there."]
    assert emulating.features.capture.stage is stage
    assert view._use.isEnabled()
    with answering("Use what is there", "Do not open") as answers:
        qtbot.mouseClick(view._use, LEFT)
        qtbot.waitUntil(lambda: answers.left == [])
        settle_jobs()
    assert answers.asked == ["1 of 3 views are there.", "The case has a left foot already."]
    assert case.record.of_side(Side.LEFT) is foot
    emulating.features.foot.close()


def _complete(presenter: CapturePresenter) -> list[str]:
    """The views that the capture that runs has finished."""
    status = presenter._status
    return [] if status is None else [view.view for view in status.views if view.finished]


def test_an_ordered_foot_is_replaced_by_no_scan_on_enter(
    emulating: Application, settle_jobs: Callable[[], None], make_foot: Callable[[Side], Foot]
) -> None:
    case, opener = emulating.case, emulating.features.case_files.opener
    foot = make_foot(Side.LEFT)
    case.open_foot(foot, ScanSource("mesh", "/nowhere/a.ply", "1" * 64))
    settle_jobs()
    said: list[str] = []

    def press_enter() -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        said.append(box.informativeText())
        QTest.keyClick(box, Qt.Key.Key_Return)

    for number, order in enumerate((OrderNote("IS-261128-AB12", 1), OrderNote())):
        case.note_order(order)
        QTimer.singleShot(100, press_enter)
        source = ScanSource("session", f"/nowhere/{number}.ply", f"{number + 2}" * 64)
        opener.take_scan(ScannedFoot(make_foot(Side.LEFT), source))
        settle_jobs()
        here = case.record.of_side(Side.LEFT)
        assert here is not None
        is_replaced = here.source.path == source.path
        assert is_replaced is (order.number == "")
    assert said[0].startswith("The case was exported as order IS-261128-AB12.")
    assert "exported" not in said[1]


def test_the_step_of_the_path_opens_it_once(emulating: Application) -> None:
    emulating.stage.steps.chosen.emit("capture")
    first = emulating.features.capture.stage
    assert first is not None
    assert first.isVisible()
    emulating.controller.run_action("capture", False)
    assert emulating.features.capture.stage is first


class KeptStage(QWidget):
    """Stands in for the stage, with nobody of the work list chosen."""

    kept = Signal(object)
    closed = Signal()
    view = SimpleNamespace(visit_id="")


def test_both_feet_of_a_visit_are_handed_on_one_after_the_other(
    qtbot: QtBot, emulating: Application, monkeypatch: pytest.MonkeyPatch
) -> None:
    stage = KeptStage()
    qtbot.addWidget(stage)
    window = CaptureWindow(emulating.services, SensorSource(SensorStore(Path()), None))
    monkeypatch.setattr(window, "make_stage", lambda: stage)
    opened: list[Path] = []
    window.captured.connect(opened.append)
    window.open()
    for foot in ("left", "right"):
        stage.kept.emit(Path(foot))
    assert opened == []
    stage.closed.emit()
    assert opened == [Path("left")]
    window.hand_on()
    assert opened == [Path("left"), Path("right")]
    window.hand_on()
    assert len(opened) == 2


def test_a_session_that_cannot_be_emulated_is_told(
    qapp: QApplication, paths: UserPaths, tmp_path: Path
) -> None:
    built = build_application(qapp, paths, tmp_path)
    built.controller.run_action("capture", False)
    (dialog,) = built.services.messages.dialogs
    assert "holds no manifest.json" in dialog.text()
    dialog.done(0)
    built.close()
