"""Capture as the window offers it: from the emulated sensors to a foot on the bench."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.features.capture.capture_window import CaptureWindow
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
