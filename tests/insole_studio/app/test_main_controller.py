from __future__ import annotations

import threading
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import OutputError
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.progress import Progress
from insole_studio.app.bootstrap import Application
from insole_studio.app.scripted import grab_window
from insole_studio.services.questions import Answer
from insole_studio.widgets.message_label import ErrorDialog
from tests.patience import PATIENCE_S

Settle = Callable[[], None]
Export = Callable[[Path], Path]


def add_pelott(app: Application) -> Pelott:
    design = app.case.record.design
    assert design is not None
    pad = Pelott(centre_mm=(0.0, 150.0))
    app.case.apply(design.with_added(pad), "Place a pelott")
    return pad


@pytest.mark.slow
def test_save_and_open_give_the_same_case(
    opened: Application, settle: Settle, tmp_path: Path
) -> None:
    add_pelott(opened)
    opened.case.apply(Patient(name="Anna B."), "Edit")
    opened.features.case_files.saver.save_to(tmp_path / "anna.insole")
    settle()
    assert not opened.case.has_unsaved_changes
    record = opened.case.record
    opened.features.case_files.opener.new_case()
    assert opened.case.foot is None
    opened.features.case_files.opener.open_path(tmp_path / "anna.insole")
    settle()
    assert opened.case.record.design == record.design
    assert opened.case.record.patient == record.patient
    assert opened.stage.preview.mesh is not None


def test_the_title_says_what_is_open_and_unsaved(
    opened: Application, settle: Settle, tmp_path: Path
) -> None:
    assert opened.window.isWindowModified()
    opened.features.case_files.saver.save_to(tmp_path / "anna.insole")
    settle()
    assert not opened.window.isWindowModified()
    assert opened.window.windowTitle().startswith("anna")


def test_export_writes_a_closed_insole(opened: Application, export: Export, tmp_path: Path) -> None:
    add_pelott(opened)
    written = export(tmp_path / "insole.stl")
    assert written == tmp_path / "insole-left.stl"
    size = written.stat().st_size
    assert size > 84
    assert (size - 84) % 50 == 0


def test_export_to_nowhere_is_one_sentence(
    opened: Application, export: Export, tmp_path: Path
) -> None:
    with pytest.raises(OutputError, match="its folder does not exist"):
        export(tmp_path / "missing" / "insole.stl")
    assert opened.features.export.exported is None


def test_what_is_neither_case_nor_scan_is_refused(app: Application, tmp_path: Path) -> None:
    app.features.case_files.opener.open_path(tmp_path / "letter.docx")
    (dialog,) = app.services.messages.dialogs
    assert "neither a case, a session nor a mesh" in dialog.text()


def test_a_broken_case_leaves_the_open_one(
    opened: Application, settle: Settle, tmp_path: Path
) -> None:
    (tmp_path / "bad.insole").write_bytes(b"no zip")
    record = opened.case.record
    opened.features.case_files.opener.open_path(tmp_path / "bad.insole")
    settle()
    assert opened.case.record is record
    assert len(opened.services.messages.dialogs) == 1


def test_an_unexpected_error_keeps_its_details_for_a_report(app: Application, qapp: object) -> None:
    try:
        raise KeyError("lost")
    except KeyError as error:
        app.services.messages.show_error(error)
    (dialog,) = app.services.messages.dialogs
    assert "KeyError" in dialog.detailedText()
    dialog.copy_report()
    assert "KeyError" in dialog.report
    assert isinstance(dialog, ErrorDialog)


def test_closing_asks_with_unsaved_work(opened: Application, questions: Any, qtbot: QtBot) -> None:
    questions.unsaved = Answer.CANCEL
    opened.window.close()
    assert opened.window.isVisible()
    questions.unsaved = Answer.DISCARD
    with qtbot.waitSignal(opened.controller.closed):
        opened.window.close()
    assert not opened.window.isVisible()
    assert questions.asked == ["unsaved", "unsaved"]


def test_closing_can_save_first(
    opened: Application, questions: Any, qtbot: QtBot, tmp_path: Path
) -> None:
    questions.unsaved, questions.path = Answer.SAVE, tmp_path / "kept.insole"
    with qtbot.waitSignal(opened.controller.closed):
        opened.window.close()
    assert read_case(tmp_path / "kept.insole").foot is not None


def test_an_empty_case_closes_without_a_question(app: Application, questions: Any) -> None:
    app.window.close()
    assert not app.window.isVisible()
    assert questions.asked == []


def test_cancelling_an_opening_leaves_the_case(app: Application, qtbot: QtBot) -> None:
    begun, go_on = threading.Event(), threading.Event()

    def slow(progress: Progress) -> None:
        begun.set()
        go_on.wait(PATIENCE_S)
        progress.step(0.5, "Going on")

    app.jobs.start("open", slow, lambda _: pytest.fail("cancelled work answered"), pytest.fail)
    assert begun.wait(PATIENCE_S)
    app.jobs.cancel("open")
    go_on.set()
    qtbot.wait(50)
    assert not app.jobs.is_running()
    assert app.case.is_empty


def test_undo_menu_names_the_step(opened: Application) -> None:
    add_pelott(opened)
    action = opened.window.actions_by_key["undo"]
    assert action.isEnabled()
    assert "Place a pelott" in action.text()
    action.trigger()
    assert "Place a pelott" in opened.window.actions_by_key["redo"].text()
    assert not action.isEnabled()


def test_the_window_can_be_pictured_with_its_views(opened: Application) -> None:
    image = grab_window(opened)
    assert (image.width(), image.height()) == opened.window.size().toTuple()


def test_a_design_that_cannot_be_built_warns_beside_the_insole(
    opened: Application, settle: Settle
) -> None:
    design = opened.case.record.design
    assert design is not None
    opened.case.apply(replace(design, thickness_mm=1000.0), "Edit")
    assert "thickness_mm" in opened.stage.preview.problem
    opened.case.undo()
    settle()
    assert opened.stage.preview.problem == ""


@pytest.mark.slow
def test_a_session_opens_and_shows_its_foot(
    app: Application, settle: Settle, small_session: Path
) -> None:
    app.features.case_files.opener.open_path(small_session)
    settle()
    assert app.services.messages.dialogs == []
    assert app.case.side is Side.LEFT
    source = app.case.record.source
    assert isinstance(source, ScanSource)
    assert source.kind == "session"
    assert app.stage.preview.mesh is not None


def test_a_damaged_session_is_refused(app: Application, settle: Settle, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "session.zip", "w") as archive:
        archive.writestr("manifest.json", "{}")
    app.features.case_files.opener.open_path(tmp_path / "session.zip")
    settle()
    assert len(app.services.messages.dialogs) == 1
    assert app.case.is_empty
