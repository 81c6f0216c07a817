"""Names of files to write are complete before it is asked whether a file may be replaced."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot
from real_dialogs import answering

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.features.compare.stage import CompareStage
from insole_studio.services.files import (
    Kept,
    LastFolders,
    case_kinds,
    complete_name,
    template_kinds,
)
from insole_studio.services.questions import Namesake, Questions
from insole_studio.settings import Settings, load_settings, save_settings
from insole_studio.user_paths import UserPaths

REPORTS = "PDF (*.pdf);;JSON (*.json)"


@pytest.mark.parametrize(
    ("typed", "kinds", "completed"),
    [
        ("anna", "Case (*.insole)", "anna.insole"),
        ("B. Name", "Case (*.insole)", "B. Name.insole"),
        ("B. Name.insole", "Case (*.insole)", "B. Name.insole"),
        ("B. Name.INSOLE", "Case (*.insole)", "B. Name.INSOLE"),
        ("B.", "Case (*.insole)", "B..insole"),
        (".insole", "Case (*.insole)", ".insole.insole"),
        ("size 4.5", "STL (*.stl)", "size 4.5.stl"),
        ("pad", template_kinds(), "pad.insole-template"),
        ("case.insole", template_kinds(), "case.insole.insole-template"),
        ("v1.2", REPORTS, "v1.2.pdf"),
        ("v1.json", REPORTS, "v1.json"),
        ("scan", "Session or mesh (*.zip *.ply *.stl)", "scan.zip"),
    ],
)
def test_names_are_completed(typed: str, kinds: str, completed: str) -> None:
    assert complete_name(Path("/d.d") / typed, kinds) == Path("/d.d") / completed


def test_the_chosen_kind_completes_the_name() -> None:
    assert complete_name(Path("/a/v1.2"), REPORTS, "JSON (*.json)") == Path("/a/v1.2.json")


@pytest.fixture
def asking(app: Application) -> Application:
    """The application with its real dialogs."""
    app.services.messages.questions = Questions(app.window)
    app.window.activateWindow()
    return app


def test_the_case_of_another_patient_is_not_overwritten_unasked(
    asking: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    other = tmp_path / "B. Name.insole"
    namesake = tmp_path / "B.insole"
    for path in (other, namesake):
        write_case(CaseRecord(Patient(name="another")), path)
    asking.case.open(CaseRecord(Patient(name="B. Name")), None, unsaved=True)
    with answering(tmp_path / "B. Name", "Keep them", tmp_path / "B. Name 2") as given:
        asking.window.actions_by_key["save_as"].trigger()
    settle()
    assert given.asked == ["These files are there already: B. Name.insole"]
    assert read_case(other).patient.name == read_case(namesake).patient.name == "another"
    assert read_case(tmp_path / "B. Name 2.insole").patient.name == "B. Name"
    assert asking.case.path == tmp_path / "B. Name 2.insole"


ASKING = {
    "save_as": ".insole",
    "save_template": ".insole-template",
    "save_measures": ".csv",
    "print_measures": ".pdf",
    "print_outline": ".pdf",
}
"""Actions that ask for the name of a file, and its ending."""


def test_every_dialog_asks_about_the_completed_name(
    asking: Application, opened: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    for action, suffix in ASKING.items():
        folder = tmp_path / action
        folder.mkdir()
        there, namesake = folder / f"B. Name{suffix}", folder / f"B{suffix}"
        there.write_text("old")
        namesake.write_text("old")
        with answering(folder / "B. Name", "Replace them") as given:
            asking.window.actions_by_key[action].trigger()
        settle()
        assert given.asked == [f"These files are there already: {there.name}"]
        assert namesake.read_text() == "old"
        assert there.read_bytes() != b"old"
        assert {path.name for path in folder.glob("B*")} == {there.name, namesake.name}


def test_the_report_of_a_comparison_is_asked_about_by_its_completed_name(
    qapp: QApplication, app: Application, tmp_path: Path
) -> None:
    (tmp_path / "B. Name.pdf").touch()
    stage = CompareStage(app.case, dark=False)
    stage.show()
    with answering(tmp_path / "B. Name", "Replace them") as given:
        path = stage._ask_report()
    stage.close()
    stage.deleteLater()
    assert path == tmp_path / "B. Name.pdf"
    assert given.asked == ["These files are there already: B. Name.pdf"]


@pytest.mark.parametrize(
    ("asked", "goes"),
    [(Questions.may_replace_own, "Replace it"), (Questions.may_discard, "Discard it")],
)
def test_what_is_there_is_kept_or_goes(
    qapp: QApplication, asked: Callable[[Questions, str], bool], goes: str
) -> None:
    parent = QWidget()
    with answering("Keep it", goes):
        assert not asked(Questions(parent), "Wedge")
        assert asked(Questions(parent), "Wedge")


def test_a_namesake_is_named_and_is_the_same_another_or_nobody(qapp: QApplication) -> None:
    parent = QWidget()
    verbs = ("Open this patient", "Add another patient")
    with answering(*verbs, "Add nobody") as given:
        answers = [
            Questions(parent).about_namesake("Anna Berg, 1970-02-28 (P-KQ4M)", *verbs)
            for _ in Namesake
        ]
    assert answers == list(Namesake)
    sentence = "The record has this name and birth date already: Anna Berg, 1970-02-28 (P-KQ4M)."
    (asked,) = set(given.asked)
    assert asked.replace("\N{NON-BREAKING HYPHEN}", "-") == sentence
    assert "P-" not in asked, "the pseudonym is not broken over two lines"
    assert len(given.asked) == 3


@pytest.mark.slow
def test_an_export_asks_about_the_files_that_it_writes(
    asking: Application, opened: Application, settle: Callable[[], None], tmp_path: Path
) -> None:
    for name in ("B.stl", "B. Name.stl", "B. Name-left.stl"):
        (tmp_path / name).write_text("old")
    asking.features.export.open()
    stage = asking.features.export.stage
    assert stage is not None
    while stage.jobs.is_running():
        QApplication.processEvents()
    with answering(tmp_path / "B. Name", "Replace them") as given:
        stage.view.export.click()
    while stage.jobs.is_running():
        QApplication.processEvents()
    stage.close()
    assert given.asked == ["These files are there already: B. Name-left.stl"]
    assert (tmp_path / "B.stl").read_text() == (tmp_path / "B. Name.stl").read_text() == "old"
    assert (tmp_path / "B. Name-left.stl").read_bytes() != b"old"


def test_kinds_of_cases_name_their_suffix() -> None:
    assert complete_name(Path("a"), case_kinds()) == Path("a.insole")


@pytest.fixture
def documents(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the documents; the working directory is another one."""
    for name in ("documents", "working"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path / "working")
    monkeypatch.setattr(
        QStandardPaths, "writableLocation", lambda _place: str(tmp_path / "documents")
    )
    return tmp_path / "documents"


@pytest.fixture
def remembering(app: Application) -> Application:
    """The application with its real dialogs, which start where its settings say."""
    app.services.messages.questions = Questions(app.window, LastFolders(app.settings))
    app.window.activateWindow()
    return app


def test_the_window_remembers_the_folder_of_its_cases(
    qapp: QApplication, qtbot: QtBot, paths: UserPaths, documents: Path, tmp_path: Path
) -> None:
    built = build_application(qapp, paths)
    built.window.show()
    qtbot.waitExposed(built.window)
    built.case.open(CaseRecord(Patient(name="B")), None, unsaved=True)
    with answering(tmp_path / "B", Path("B2")) as given:
        for _ in range(2):
            built.window.actions_by_key["save_as"].trigger()
            qtbot.waitUntil(lambda: not built.jobs.is_running())
    built.autosave.forget()
    built.close()
    assert given.folders == [documents, tmp_path]
    assert (tmp_path / "B2.insole").exists()
    assert load_settings(paths.settings_file).cases_folder == str(tmp_path)


def test_dialogs_start_where_the_same_kind_of_thing_was_last(
    remembering: Application,
    opened: Application,
    settle: Callable[[], None],
    tmp_path: Path,
    documents: Path,
) -> None:
    for name in ("patients", "reports"):
        (tmp_path / name).mkdir()
    names = (tmp_path / "patients" / "B", tmp_path / "reports" / "B", Path("B2"), Path("B3"))
    with answering(*names) as given:
        for key in ("save_as", "save_measures", "save_template", "print_outline"):
            remembering.window.actions_by_key[key].trigger()
            settle()
    assert given.folders == [documents, documents, tmp_path / "patients", tmp_path / "reports"]
    assert (tmp_path / "patients" / "B2.insole-template").exists()
    assert (tmp_path / "reports" / "B3.pdf").exists()
    save_settings(remembering.settings, tmp_path / "settings.json")
    kept = load_settings(tmp_path / "settings.json")
    assert (kept.cases_folder, kept.papers_folder) == (
        str(tmp_path / "patients"), str(tmp_path / "reports"),
    )  # fmt: skip


def test_a_folder_that_is_gone_is_not_asked_for(documents: Path, tmp_path: Path) -> None:
    folders = LastFolders(Settings(scans_folder=str(tmp_path / "unplugged")))
    assert folders.of(Kept.SCANS) == documents
