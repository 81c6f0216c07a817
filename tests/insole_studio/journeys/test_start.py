"""The start of the window: what was recovered is told and decided on; recent files are offered."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.resources import resource_path
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document.autosave import Autosave
from insole_studio.document.case import Case
from insole_studio.document.journal import find_recovered
from insole_studio.jobs import Jobs
from insole_studio.services.questions import Answer
from tests.patience import PATIENCE_S

KILLED = """
    import os, signal, sys
    from pathlib import Path
    from dataclasses import replace
    from insole_core.cases.case_file import read_case
    from insole_core.cases.case_record import CaseRecord, Patient
    from insole_studio.app.bootstrap import build_application, qt_application
    from insole_studio.user_paths import UserPaths

    settings, autosave, name, case = sys.argv[1:]
    app = build_application(qt_application(), UserPaths(Path(settings), Path(autosave)))
    app.window.show()
    app.case.open(read_case(Path(case)), Path(case))
    app.case.apply(Patient(name=name), "Edit")
    app.autosave.kept_changed.connect(
        lambda: os.kill(os.getpid(), signal.SIGKILL) if app.autosave.is_kept else None
    )
    qt_application().exec()
"""


@pytest.fixture
def kill_with(app: Application) -> Callable[..., None]:
    """Start the program, edit a case in it, and kill it while it runs."""

    def run(name: str, case: Path) -> None:
        paths = app.services.paths
        arguments = [str(paths.settings_file), str(paths.autosave_folder), name, str(case)]
        call = [sys.executable, "-c", textwrap.dedent(KILLED), *arguments]
        died = subprocess.run(call, timeout=PATIENCE_S, check=False, capture_output=True)
        assert died.returncode == -signal.SIGKILL, died.stderr.decode()

    return run


@pytest.fixture
def leave_with(app: Application) -> Callable[..., None]:
    """Leave what a window that ends unasked leaves of a case that was edited in it."""

    def leave(name: str, path: Path | None = None) -> None:
        jobs, case = Jobs(), Case()
        left = Autosave(case, jobs, app.services.paths.autosave_folder)
        if path is not None:
            case.open(read_case(path), path)
        case.apply(Patient(name=name), "Edit")
        jobs.close()
        left.close()

    return leave


@pytest.fixture
def saved(make_foot: Callable[[Side], Foot], tmp_path: Path) -> Path:
    design = InsoleDesign(Side.LEFT, grid_mm=2.0)
    foot = FootRecord.begun(
        make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64), design
    )
    path = tmp_path / "anna.insole"
    write_case(CaseRecord.of_foot(foot, Patient(name="Anna Berg")), path)
    return path


def start(app: Application) -> None:
    """Do what the program does first."""
    app.features.case_files.recovery.offer(find_recovered(app.services.paths.autosave_folder))


def told(app: Application) -> list[str]:
    """What the notices say of recovered work."""
    sentences = [notice.text for notice in app.services.notices.notices]
    return [sentence for sentence in sentences if "was not saved" in sentence]


def offered(app: Application) -> list[str]:
    """The files that the window offers."""
    QTest.qWait(20)
    rows = app.window.findChildren(QPushButton, "row")
    return [row.text() for row in rows if row.isVisible() and row.property("path")]


def press(app: Application, text: str) -> None:
    QTest.qWait(20)  # until the buttons have their places
    buttons = app.window.findChildren(QPushButton)
    button = next(b for b in buttons if b.text() == text and b.isVisible())
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)


@pytest.mark.slow
def test_what_a_killed_program_left_is_told_and_can_be_saved(
    app: Application, kill_with: Callable[..., None], saved: Path, settle: Callable[[], None]
) -> None:
    kill_with("Anna Ek", saved)
    start(app)
    settle()
    (sentence,) = told(app)
    assert sentence.startswith("anna was not saved when Insole Studio ended last time.")
    assert app.stage.notices.isVisible()
    assert app.case.record.patient.name == "Anna Ek"
    assert app.window.isWindowModified()
    press(app, "Save")
    settle()
    assert told(app) == []
    assert not app.window.isWindowModified()
    assert read_case(saved).patient.name == "Anna Ek"
    assert find_recovered(app.services.paths.autosave_folder) == []


def test_what_a_program_that_ended_left_can_be_discarded(
    app: Application,
    leave_with: Callable[..., None],
    saved: Path,
    settle: Callable[[], None],
    questions,
) -> None:
    leave_with("Anna Ek", saved)
    start(app)
    settle()
    questions.unsaved = Answer.CANCEL
    press(app, "Discard it…")
    assert questions.asked == ["discard anna"]
    assert app.case.record.patient.name == "Anna Ek"
    assert len(told(app)) == 1
    questions.unsaved = Answer.DISCARD
    press(app, "Discard it…")
    settle()
    assert told(app) == []
    assert app.case.record.patient.name == "Anna Berg"  # as it was saved
    assert not app.window.isWindowModified()
    assert read_case(saved).patient.name == "Anna Berg"
    assert find_recovered(app.services.paths.autosave_folder) == []


def test_what_several_programs_left_is_offered_one_by_one(
    app: Application, leave_with: Callable[..., None], settle: Callable[[], None], questions
) -> None:
    leave_with("Bo Ek")
    leave_with("Cia Alm")
    start(app)
    settle()
    last, other = sorted(told(app), key=lambda sentence: "either" in sentence)
    assert last.startswith("Cia Alm was not saved when")
    assert other.startswith("Bo Ek was not saved either")
    press(app, "Keep it open")
    assert app.case.record.patient.name == "Cia Alm"
    app.controller.run_action("new_case", False)
    assert told(app) == [other]  # it does not concern the case that was left
    press(app, "Open it")
    settle()
    assert app.case.record.patient.name == "Bo Ek"
    assert app.case.has_unsaved_changes
    (sentence,) = told(app)
    assert sentence.startswith("Bo Ek was not saved when")
    app.controller.run_action("new_case", False)
    assert told(app) == []


@pytest.fixture
def left_behind(app: Application) -> list[str]:
    """The names in two copies that lie where those of windows that are gone do, newest first."""
    folder, names = app.services.paths.autosave_folder, ["Cia Alm", "Bo Ek"]
    for age_s, name in enumerate(names):
        copy = folder / f"{name}.insole"
        write_case(CaseRecord(Patient(name=name)), copy)
        moment_s = copy.stat().st_mtime - age_s
        os.utime(copy, (moment_s, moment_s))
    return names


def test_what_one_window_offers_a_second_one_does_not(
    app: Application, left_behind: list[str], qapp: QApplication, settle: Callable[[], None]
) -> None:
    start(app)
    settle()
    second = build_application(qapp, app.services.paths)
    start(second)
    assert second.case.is_empty
    assert told(second) == []
    second.close()
    press(app, "Open it")
    settle()
    assert app.case.record.patient.name == left_behind[1]


def test_what_a_window_offered_is_offered_again_once_it_is_closed(
    app: Application, left_behind: list[str], qapp: QApplication
) -> None:
    second = build_application(qapp, app.services.paths)
    start(second)
    second.autosave.forget()
    second.close()
    start(app)
    assert app.case.record.patient.name == left_behind[1]
    assert list(app.services.paths.autosave_folder.glob("Bo Ek.*")) == []


def test_copies_that_another_program_removed_meanwhile_open_all_the_same(
    app: Application, left_behind: list[str], settle: Callable[[], None]
) -> None:
    start(app)
    settle()
    for copy in app.services.paths.autosave_folder.glob("Bo Ek.insole"):
        copy.unlink()
    press(app, "Open it")
    settle()
    assert app.case.record.patient.name == left_behind[1]
    assert app.services.messages.dialogs == []


def test_the_first_page_offers_recent_files_and_a_new_case_none(
    app: Application, saved: Path, settle: Callable[[], None], qtbot: QtBot
) -> None:
    other = saved.with_name("M & S.insole")
    other.write_bytes(saved.read_bytes())
    for path in (other, saved):
        app.services.recent.remember(path)
    app.controller.run_action("patients", False)
    assert offered(app) == ["anna.insole", "M && S.insole"]
    visible = {b.text() for b in app.window.findChildren(QPushButton) if b.isVisible()}
    assert {"Open case…", "Capture…", "Open session…", "Open the example"} <= visible
    press(app, "M && S.insole")
    settle()
    assert app.case.path == other
    assert offered(app) == []
    app.controller.run_action("new_case", False)
    settle()
    assert app.case.is_empty
    assert offered(app) == []


def test_the_example_is_opened_in_any_number_of_windows_and_never_saved_over(
    app: Application, settle: Callable[[], None], questions, tmp_path: Path
) -> None:
    example = resource_path("example/example.insole")
    before = example.read_bytes()
    press(app, "Open the example")
    settle()
    assert questions.asked == []
    assert app.case.foot is not None
    assert app.case.path is None
    assert app.services.recent.names == []
    questions.path = tmp_path / "mine.insole"
    app.controller.run_action("save", False)
    settle()
    assert questions.path.exists()
    assert example.read_bytes() == before


def test_a_recent_file_is_chosen_from_the_menu_whatever_its_name(
    app: Application, saved: Path, settle: Callable[[], None]
) -> None:
    other = saved.with_name("M & S.insole")
    saved.rename(other)
    app.services.recent.remember(other)
    (action,) = app.window._recent.actions()
    action.trigger()
    settle()
    assert app.case.path == other
