from __future__ import annotations

import gc
import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QPushButton

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.scans.mesh_file import read_mesh
from insole_studio.app.bootstrap import Application, build_application, run_application
from insole_studio.app.main_window import MainWindow
from insole_studio.app.scripted import ScriptedWindow
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.journal import find_recovered
from insole_studio.jobs import Jobs
from insole_studio.services.questions import Answer
from insole_studio.settings import load_settings
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S, wait_for


@pytest.mark.slow
@pytest.mark.usefixtures("coarse")
def test_the_whole_journey_by_program(
    qapp: QApplication, paths: UserPaths, small_session: Path, tmp_path: Path
) -> None:
    with ScriptedWindow(paths, (720, 560)) as studio:
        studio.open(small_session)
        assert studio.app.case.side is Side.LEFT
        studio.place_pelott(2.0, 150.0)
        (insole,) = studio.export(tmp_path / "insole.stl")
        studio.save(tmp_path / "case.insole")
        studio.screenshot(tmp_path / "window.png")
    assert insole == tmp_path / "insole-left.stl"
    assert read_mesh(insole).mesh.is_closed
    design = read_case(tmp_path / "case.insole").design
    assert design is not None
    assert len(design.corrections) == 1
    picture = QImage(str(tmp_path / "window.png"))
    assert (picture.width(), picture.height()) == (720, 560)


def test_a_second_file_is_opened_over_unsaved_work(
    qapp: QApplication, paths: UserPaths, tmp_path: Path
) -> None:
    for name in ("first", "second"):
        write_case(CaseRecord(patient=Patient(name=name)), tmp_path / f"{name}.insole")
    with ScriptedWindow(paths, (900, 600)) as studio:
        case = studio.app.case
        studio.open(tmp_path / "first.insole")
        case.apply(Patient(name="changed"), "change")
        studio.answers.unsaved = Answer.CANCEL
        studio.open(tmp_path / "second.insole")
        assert case.record.patient.name == "changed"
        studio.answers.unsaved = Answer.SAVE
        studio.open(tmp_path / "second.insole")
        assert case.record.patient.name == "second"
    assert read_case(tmp_path / "first.insole").patient.name == "changed"


def close_soon(window_seen: list[str]) -> None:
    """Close the window as soon as it stands."""
    for widget in QApplication.topLevelWidgets():
        if isinstance(widget, MainWindow):
            window_seen.append(widget.windowTitle())
            widget.close()


def test_the_application_runs_until_its_window_closes(qapp: QApplication, paths: UserPaths) -> None:
    seen: list[str] = []
    QTimer.singleShot(300, qapp, lambda: close_soon(seen))
    hook = sys.excepthook
    assert run_application([], paths) == 0
    assert len(seen) == 1
    assert sys.excepthook is sys.__excepthook__ or sys.excepthook is hook
    assert load_settings(paths.settings_file).window_docks != ""
    sys.excepthook = hook


def test_an_unexpected_error_is_reported_without_names_and_told_at_the_next_start(
    qapp: QApplication, paths: UserPaths
) -> None:
    def fail() -> None:
        raise ValueError("Gustava Berg")

    hook = sys.excepthook
    QTimer.singleShot(200, qapp, fail)
    QTimer.singleShot(500, qapp, lambda: close_soon([]))
    assert run_application([], paths) == 0
    reports = [path.read_text(encoding="utf-8") for path in paths.crashes_folder.glob("*.txt")]
    assert len(reports) == 1
    assert "ValueError" in reports[0]
    assert "Gustava" not in reports[0]

    offered: list[str] = []

    def look() -> None:
        for window in QApplication.topLevelWidgets():
            offered.extend(button.text() for button in window.findChildren(QPushButton))
        close_soon([])

    QTimer.singleShot(300, qapp, look)
    assert run_application([], paths) == 0
    sys.excepthook = hook
    assert "Look at the report" in offered


def test_what_a_crash_left_is_open_at_the_next_start(qapp: QApplication, paths: UserPaths) -> None:
    jobs, case = Jobs(), Case()
    left = Autosave(case, jobs, paths.autosave_folder)
    case.open(CaseRecord(patient=Patient(name="Anna B.")), None, unsaved=True)
    jobs.close()
    left.close()
    seen: list[str] = []

    def look_and_save() -> None:
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, MainWindow):
                seen.append(widget.windowTitle())
                widget.close_for_good()
        qapp.quit()

    QTimer.singleShot(300, qapp, look_and_save)
    hook = sys.excepthook
    run_application([], paths)
    sys.excepthook = hook
    assert seen[0].startswith("Anna B.")


def test_no_garbage_is_collected_while_the_window_is_made(
    qapp: QApplication, paths: UserPaths
) -> None:
    # It may be widgets that Qt is just handing over in a list: one start in three ended there.
    phases: list[str] = []

    def note(phase: str, _counts: dict[str, int]) -> None:
        phases.append(phase)

    gc.collect()  # so that the next one is not due at once
    gc.callbacks.append(note)
    gc.enable()
    try:
        app = build_application(qapp, paths)
    finally:
        gc.callbacks.remove(note)
    app.close()
    assert phases == []


def copies(app: Application) -> list[str]:
    """The patients of which there are copies of unsaved work."""
    folder = app.services.paths.autosave_folder
    return [read_case(path).patient.name for path in folder.glob("[!.]*.insole")]


def test_unsaved_work_is_kept_before_anything_that_takes_its_time(
    qapp: QApplication, paths: UserPaths
) -> None:
    app = build_application(qapp, paths)
    app.case.apply(Patient(name="Anna B."), "Edit")
    seen: list[str] = []

    def compute_deaf_to_cancelling(_progress: Progress) -> None:
        wait_for(lambda: seen.extend(copies(app)) or seen)

    app.jobs.start("slow", compute_deaf_to_cancelling, lambda _none: None, str)
    app.close()
    assert seen == ["Anna B."]


def test_unsaved_work_is_kept_when_the_session_ends(app: Application, qapp: QApplication) -> None:
    app.case.apply(Patient(name="Anna B."), "Edit")
    assert copies(app) == []
    qapp.commitDataRequest.emit(None)
    assert copies(app) == ["Anna B."]


STOPPED = """
    import os, signal, sys
    from pathlib import Path
    from PySide6.QtCore import QTimer
    from insole_core.cases.case_record import Patient
    from insole_studio.app import bootstrap
    from insole_studio.user_paths import UserPaths

    settings, autosave, state = sys.argv[1:]
    build = bootstrap.build_application

    def build_and_use(*arguments):
        app = build(*arguments)
        app.settings.tour_seen = True

        def use():
            QTimer.singleShot(500, lambda: os.kill(os.getpid(), signal.SIGTERM))
            app.case.apply(Patient(name="Anna B."), "Edit")
            if state == "asking":
                app.window.close()

        QTimer.singleShot(0, use)
        return app

    bootstrap.build_application = build_and_use
    sys.exit(bootstrap.run_application([], UserPaths(Path(settings), Path(autosave))))
"""


@pytest.mark.slow
@pytest.mark.parametrize("state", ["idle", "asking"])
def test_a_stopped_window_asks_nothing_and_keeps_unsaved_work(tmp_path: Path, state: str) -> None:
    paths = [str(tmp_path / "settings.json"), str(tmp_path / "autosave")]
    call = [sys.executable, "-c", textwrap.dedent(STOPPED), *paths, state]
    ended = subprocess.run(call, timeout=PATIENCE_S, check=False, capture_output=True)
    assert ended.returncode == 128 + signal.SIGTERM, ended.stderr.decode()
    (recovered,) = find_recovered(tmp_path / "autosave")
    assert recovered.record.patient.name == "Anna B."


@pytest.mark.parametrize("dark", [False, True])
def test_both_themes_are_drawn(
    qapp: QApplication, paths: UserPaths, tmp_path: Path, dark: bool
) -> None:
    with ScriptedWindow(paths, (900, 600), dark) as studio:
        studio.screenshot(tmp_path / "window.png")
    color = QImage(str(tmp_path / "window.png")).pixelColor(5, 300)
    assert (color.lightness() < 80) is dark


def test_a_case_without_a_foot_opens_without_waiting_for_the_renderer(
    app: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    write_case(CaseRecord(Patient(name="Anna")), tmp_path / "anna.insole")
    app.features.case_files.opener.open_path(tmp_path / "anna.insole")
    settle()
    app.case.apply(Patient(name="Anna Berg"), "Edit")
    assert not any(view.scene.is_open for view in (app.stage.foot, app.stage.insole))
