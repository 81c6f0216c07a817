"""A case opened after another one looks as it does in a window that has just been started."""

from __future__ import annotations

import shutil
import threading
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QPushButton,
)
from pytestqt.qtbot import QtBot
from shown_texts import differences, shown

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient, Variant
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift, Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.progress import Progress
from insole_core.resources import resource_path
from insole_core.workflows.make_order import write_order
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document.section_plane import SectionPlane
from insole_studio.features.export.stage import ExportStage
from insole_studio.scene.view_camera import Preset
from insole_studio.services.questions import SameSide
from insole_studio.user_paths import UserPaths

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


@pytest.fixture
def pair(make_foot: Callable[[Side], Foot], tmp_path: Path) -> Path:
    """A case of two feet, the left one with two variants that differ."""
    left, right = (
        FootRecord.begun(make_foot(side), NOWHERE, InsoleDesign(side, grid_mm=2.0)) for side in Side
    )
    lifted = left.design.with_added(HeelLift(height_mm=4.0))
    pad = lifted.with_added(Pelott(centre_mm=(5.0, 150.0), height_mm=12.0))
    left = left.with_design(lifted).with_variant(Variant("B", pad))
    path = tmp_path / "pair.insole"
    write_case(CaseRecord(Patient(name="Anna Berg", notes="sore"), (left, right), Side.LEFT), path)
    return path


@pytest.fixture
def one_foot(make_foot: Callable[[Side], Foot], tmp_path: Path) -> Path:
    """A case of a right foot, on which nothing is prescribed yet."""
    path = tmp_path / "one.insole"
    design = InsoleDesign(Side.RIGHT, grid_mm=2.0)
    foot = FootRecord.begun(make_foot(Side.RIGHT), NOWHERE, design)
    write_case(CaseRecord.of_foot(foot, Patient(name="Bo Ek")), path)
    return path


def open_pair_and_use_everything(app: Application, pair: Path, settle: Callable[[], None]) -> None:
    """Leave on the case as much as can hang on it."""
    app.features.case_files.opener.open_path(pair)
    settle()
    run = app.controller.run_action
    run("beside_variant", True)
    settle()
    run("map_difference", True)
    settle()
    app.stage.cut.show(SectionPlane((0.0, 120.0), 10.0))
    app.features.design.prescription.take_pad(1)
    app.stage.tool_controller.tools["brush"].template = replace(
        app.stage.tool_controller.tools["brush"].template, radius_mm=25.0
    )
    design = app.case.record.design
    app.case.apply(replace(design, thickness_mm=6.0), "Edit the insole")
    app.case.undo()
    run("tool_brush", True)
    settle()
    app.stage.look(Preset.MEDIAL)
    app.stage.patient.verticalScrollBar().setValue(50)
    app.stage.look_at_measure("ball_width")
    view = app.stage.foot.scene
    QTest.mouseMove(view.surface, view.surface.rect().center())
    app.services.notices.put("scan", "The scan of Anna Berg was in metres.")
    app.services.messages.say("Exported anna.stl", 100_000)
    app.stage.insole.show_warning("The insole of Anna Berg cannot be built.")
    run("compare", False)
    run("export", False)
    stage = app.features.export.stage
    stage.view.reason.setText("Anna Berg asked for it")
    settle()
    assert app.stage.insole.numbers.isVisible()


def session_of(small_session: Path, folder: Path) -> Path:
    path = folder / "session.zip"
    shutil.copy(small_session, path)
    return path


def scan_of(small_session: Path, folder: Path) -> Path:
    with zipfile.ZipFile(small_session) as archive:
        return Path(archive.extract("truth.ply", folder))


CASES = {
    # A copy, as a test in another process may have the example itself open.
    "example": lambda _session, _one, folder: Path(
        shutil.copy(resource_path("example/example.insole"), folder)
    ),
    "one foot": lambda _session, one, _folder: one,
    "scan": lambda session, _one, folder: scan_of(session, folder),
    "session": lambda session, _one, folder: session_of(session, folder),
    "empty": lambda _session, _one, _folder: None,
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", CASES)
def test_a_case_opened_after_another_looks_as_at_a_fresh_start(
    kind: str,
    app: Application,
    settle: Callable[[], None],
    qapp: QApplication,
    qtbot: QtBot,
    questions,
    pair: Path,
    one_foot: Path,
    small_session: Path,
    tmp_path: Path,
) -> None:
    path = CASES[kind](small_session, one_foot, tmp_path)
    questions.same_side = SameSide.NEW_CASE

    def show_case(application: Application) -> list[str]:
        opener = application.features.case_files.opener
        if path is None:
            opener.new_case()
        else:
            opener.open_path(path, Side.LEFT)
        qtbot.waitUntil(lambda: not application.jobs.is_running())
        QTest.qWait(50)
        return shown(application)

    app.window.resize(1366, 768)
    open_pair_and_use_everything(app, pair, settle)
    after_another = show_case(app)
    app.services.save_settings()
    recent = list(app.settings.recent)
    app.features.case_files.opener.new_case()  # else its file is in use
    settle()
    app.features.close_windows()
    app.window.hide()
    fresh_paths = UserPaths(tmp_path / "fresh" / "settings.json", tmp_path / "fresh" / "autosave")
    fresh = build_application(qapp, fresh_paths)
    try:
        fresh.services.messages.questions = questions
        fresh.settings.recent = recent
        fresh.services.recent.changed.emit()
        fresh.window.resize(app.window.size())
        fresh.window.show()
        qtbot.waitExposed(fresh.window)
        show_case(fresh)

        def looks_the_same() -> None:
            assert differences(after_another, shown(fresh)) == ([], [])

        qtbot.waitUntil(looks_the_same)  # what is shown later than its job ends is no difference
    finally:
        fresh.autosave.forget()
        fresh.close()


@pytest.mark.slow
def test_all_cases_in_turn_and_back_again(
    app: Application,
    settle: Callable[[], None],
    questions,
    pair: Path,
    one_foot: Path,
    small_session: Path,
    tmp_path: Path,
) -> None:
    """The second round shows what the first one showed, and nothing of the case in between.

    The first one begins with the example in a fresh window.
    """
    opener = app.features.case_files.opener
    paths = [resource_path("example/example.insole"), pair, one_foot]
    rounds: list[list[list[str]]] = []
    for _ in range(2):
        rounds.append([])
        for path in paths:
            opener.open_path(path)
            settle()
            QTest.qWait(20)
            rounds[-1].append(shown(app))
            app.controller.run_action("tool_section", True)
            app.stage.look(Preset.POSTERIOR)
        if len(rounds) == 1:
            open_pair_and_use_everything(app, pair, settle)
            opener.new_case()
            settle()
    for first, second in zip(*rounds, strict=True):
        assert differences(first, second) == ([], [])


def test_two_variants_beside_each_other_keep_their_names_after_undo(
    app: Application, settle: Callable[[], None], pair: Path, questions, monkeypatch
) -> None:
    app.features.case_files.opener.open_path(pair)
    settle()
    app.controller.run_action("beside_variant", True)
    settle()
    app.controller.run_action("map_difference", True)
    questions.typed = "sport"
    app.controller.run_action("variant_name", False)

    def heads() -> str:
        return app.stage.insole.numbers.text().partition(":")[0]

    assert heads() == "sport − A"
    names: list[list[str]] = []
    drawn = app.stage.insole.scene.companion
    monkeypatch.setattr(drawn, "show_names", lambda n: names.append([name.text for name in n]))
    app.case.undo()
    settle()
    assert heads() == "B − A"
    assert names[-1] == ["Variant B", "Variant A"]
    app.case.redo()
    settle()
    assert heads() == "sport − A"
    assert names[-1] == ["sport", "Variant A"]


def test_the_section_says_what_to_do_with_its_tool(
    app: Application, settle: Callable[[], None], one_foot: Path
) -> None:
    app.features.case_files.opener.open_path(one_foot)
    settle()
    assert app.stage.section._sentence == "Choose the section tool and click on the sole."
    app.controller.run_action("tool_section", True)
    assert app.stage.section._sentence == "Click on the sole to cut the insole there"


def test_a_foot_still_being_made_does_not_come_into_the_next_case(
    app: Application,
    settle: Callable[[], None],
    small_session: Path,
    tmp_path: Path,
    one_foot: Path,
) -> None:
    app.features.case_files.opener.open_path(session_of(small_session, tmp_path))
    stage = app.features.foot.stage
    assert stage is not None
    app.features.case_files.opener.open_path(one_foot)
    settle()
    assert app.features.foot.stage is None
    assert [foot.side for foot in app.case.record.feet] == [Side.RIGHT]


def test_the_second_foot_of_a_visit_does_not_come_into_the_next_case(
    app: Application,
    settle: Callable[[], None],
    small_session: Path,
    tmp_path: Path,
    one_foot: Path,
) -> None:
    """Both feet are captured; another case is opened while the first one is being made."""
    app.features.capture._waiting.append(tmp_path / "the other foot")
    app.features.case_files.opener.open_path(session_of(small_session, tmp_path))
    app.features.case_files.opener.open_path(one_foot)
    settle()
    QTest.qWait(20)
    assert app.features.capture._waiting == []
    assert app.features.foot.stage is None
    assert app.services.messages.dialogs == []
    assert [foot.side for foot in app.case.record.feet] == [Side.RIGHT]


@pytest.fixture
def leave_while_writing(
    app: Application,
    settle: Callable[[], None],
    qtbot: QtBot,
    questions,
    pair: Path,
    one_foot: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[threading.Event]:
    """Open another case while an order is written; it goes on when the event is set."""
    go_on = threading.Event()

    def write_slowly(*arguments, progress: Progress, **values) -> tuple[Path, ...]:
        while not go_on.wait(0.01):
            progress.step(0.0, "Writing")
        return write_order(*arguments, progress=progress, **values)

    monkeypatch.setattr("insole_studio.features.export.presenter.write_order", write_slowly)
    app.features.case_files.opener.open_path(one_foot)
    settle()
    app.controller.run_action("export", False)
    stage = app.features.export.stage
    qtbot.waitUntil(lambda: not stage.jobs.is_running())
    questions.path = tmp_path / "one.stl"
    stage.view.export.click()
    app.features.case_files.opener.open_path(pair)
    settle()
    yield go_on
    go_on.set()


def written(folder: Path) -> bool:
    return (folder / "one-right.stl").exists() or (folder / "one.stl").exists()


def notice_button(app: Application, text: str) -> QPushButton:
    QTest.qWait(20)
    buttons = app.stage.notices.findChildren(QPushButton)
    return next(b for b in buttons if b.text() == text and b.isVisible())


def notices(app: Application) -> list[str]:
    return [notice.text for notice in app.services.notices.notices]


STILL_WRITING = "The order of the case before is still being written."


def test_what_is_being_exported_is_written_out_of_sight_of_the_next_case(
    app: Application,
    leave_while_writing: threading.Event,
    qtbot: QtBot,
    pair: Path,
    tmp_path: Path,
) -> None:
    assert app.case.path == pair
    assert [w for w in QApplication.topLevelWidgets() if isinstance(w, ExportStage)] != []
    assert not any(
        w.isVisible() for w in QApplication.topLevelWidgets() if isinstance(w, ExportStage)
    )
    assert STILL_WRITING in notices(app)
    app.controller.run_action("export", False)
    assert "Anna Berg" in "".join(shown(app))
    assert "Bo Ek" not in "".join(shown(app))
    record = app.case.record
    leave_while_writing.set()
    qtbot.waitUntil(lambda: STILL_WRITING not in notices(app))
    assert written(tmp_path)
    said = app.window.statusBar().currentMessage()
    assert said == "The order of the case before has been written."
    assert app.features.export.stage is not None
    assert app.case.record is record
    assert app.features.export.exported is not record


def test_what_is_being_exported_of_the_case_before_can_be_cancelled(
    app: Application, leave_while_writing: threading.Event, qtbot: QtBot, tmp_path: Path
) -> None:
    QTest.mouseClick(notice_button(app, "Cancel"), Qt.MouseButton.LeftButton)
    qtbot.waitUntil(
        lambda: not any(isinstance(w, ExportStage) for w in QApplication.topLevelWidgets())
    )
    assert STILL_WRITING not in notices(app)
    assert not written(tmp_path)
    assert "was stopped" in app.window.statusBar().currentMessage()


def test_whatever_fails_with_the_next_case_the_foot_before_is_not_shown(
    app: Application, settle: Callable[[], None], pair: Path, one_foot: Path, monkeypatch, qtbot
) -> None:
    app.features.case_files.opener.open_path(pair)
    settle()

    def fail(*_arguments: object, **_values: object) -> None:
        raise RuntimeError("the foot cannot be drawn")

    for view in (app.stage.foot, app.stage.insole):
        monkeypatch.setattr(view, "show_mesh", fail)
    with qtbot.captureExceptions() as exceptions:
        app.features.case_files.opener.open_path(one_foot)
        settle()
    assert exceptions
    for view in (app.stage.foot, app.stage.insole):
        assert view.scene._mesh is None
        assert not view.scene.isVisible()
