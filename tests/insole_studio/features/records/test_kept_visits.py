"""A visit keeps itself in the record, also while the database is away and where two change it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.order_note import OrderNote
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import RecordsError, Unreachable
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.records.person import Person
from insole_core.records.prescription import Base
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.record_field import FieldChoice
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.visit import Visit
from insole_core.workflows.order_package import Ordered
from insole_core.workflows.records import keep_case
from insole_studio.app.bootstrap import Application
from insole_studio.document import clinic_record, record_keeper
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.journal import find_recovered
from insole_studio.document.record_keeper import SAVE_AFTER_MS, KeepState
from insole_studio.features.clinic.merge_dialog import MergeDialog
from insole_studio.features.records.photos_dialog import PhotosDialog
from insole_studio.features.records.version_dialogs import (
    Choice,
    ConflictDialog,
    FieldConflictDialog,
)
from insole_studio.user_paths import UserPaths


def thicken(app: Application, thickness_mm: float) -> None:
    design = app.case.record.design
    assert design is not None
    app.case.apply(replace(design, thickness_mm=thickness_mm), "Thickness")


def newest_mm(records: Records, visit: Visit) -> float:
    newest = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    return records.prescriptions.read(newest.id).design.thickness_mm


def wait_until_saved(app: Application, qtbot: QtBot) -> None:
    keeper = app.services.keeper
    qtbot.waitUntil(lambda: keeper.state is KeepState.SAVED)


def conflict_dialog(app: Application, qtbot: QtBot) -> ConflictDialog:
    qtbot.waitUntil(lambda: bool(app.window.findChildren(ConflictDialog)))
    (dialog,) = app.window.findChildren(ConflictDialog)
    return dialog


def change_elsewhere(
    station: Records, visit: Visit, thickness_mm: float, base: Base | None = None
) -> Base:
    """Store the left foot; as more of an editing with the base that it returned before."""
    found = station.visits.open_case(visit.id)
    foot = found.record.of_side(Side.LEFT)
    assert foot is not None
    foot = foot.with_design(replace(foot.design, thickness_mm=thickness_mm))
    return station.prescriptions.save(visit.id, foot, base or found.bases[Side.LEFT])


@pytest.fixture
def away(monkeypatch: pytest.MonkeyPatch) -> Callable[[bool], None]:
    """Let the database not answer what is to be stored, or answer again."""
    save = Prescriptions.save

    def fail(*_given: object) -> None:
        raise Unreachable("The database does not answer.")

    def switch(is_away: bool) -> None:
        monkeypatch.setattr(Prescriptions, "save", fail if is_away else save)

    return switch


def test_a_change_is_in_the_record_soon(
    opened: Application,
    records: Records,
    visit: Visit,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert SAVE_AFTER_MS <= 1000  # which leaves as much to save it within two seconds
    monkeypatch.setattr(record_keeper, "SAVE_AFTER_MS", SAVE_AFTER_MS)
    thicken(opened, 4.5)
    assert opened.window.status._kept.text() == "Saving…"
    qtbot.waitUntil(lambda: newest_mm(records, visit) == 4.5)
    wait_until_saved(opened, qtbot)
    assert opened.window.status._kept.text() == "Saved in the record"
    assert not opened.case.has_unsaved_changes


def test_a_visit_keeps_what_is_worked_on_it(
    opened: Application, records: Records, visit: Visit, questions, tmp_path: Path, qtbot: QtBot
) -> None:
    """It opens on the panels; one editing is one version, and saving keeps one for a reason."""
    assert opened.window.page is None
    assert opened.case.record.patient.name == "Anna Berg"
    assert opened.case.side is Side.LEFT
    assert not opened.case.has_unsaved_changes

    questions.path = tmp_path / "copy.insole"
    opened.controller.run_action("save_as", False)  # writes a copy to send
    qtbot.waitUntil(lambda: not opened.jobs.is_running())
    assert read_case(tmp_path / "copy.insole").patient.name == "Anna Berg"
    assert opened.case.path is None
    assert opened.case.kept is not None

    for thickness_mm in (4.0, 5.0):
        thicken(opened, thickness_mm)
        wait_until_saved(opened, qtbot)
    versions = records.prescriptions.versions(visit.id, Side.LEFT)
    assert [version.number for version in versions] == [2, 1]
    assert newest_mm(records, visit) == 5.0

    patient = replace(opened.case.record.patient, name="Anna Dal", notes="Pain at night")
    opened.case.apply(patient, "Edit")
    wait_until_saved(opened, qtbot)
    assert records.persons.get(visit.person_id).name == "Anna Dal"
    assert records.visits.get(visit.id).findings == "Pain at night"

    def reasons() -> list[str]:
        return [v.reason for v in records.prescriptions.versions(visit.id, Side.LEFT)]

    questions.typed = "Before the new shoe"
    opened.controller.run_action("save", False)
    qtbot.waitUntil(lambda: "Before the new shoe" in reasons())

    thicken(opened, 6.0)
    opened.controller.run_action("new_case", False)  # it is left once the change is saved
    qtbot.waitUntil(lambda: opened.case.kept is None)
    assert newest_mm(records, visit) == 6.0
    assert opened.window.status._kept.text() == ""


@pytest.mark.parametrize(
    ("choice", "shown_mm", "variants"),
    [(Choice.THEIRS, 7.0, ["A"]), (Choice.BOTH, 5.0, ["A", "Dr. Dal"])],
)
def test_who_saves_second_sees_both_versions_and_loses_none(
    opened: Application,
    records: Records,
    other_station: Records,
    visit: Visit,
    qtbot: QtBot,
    choice: Choice,
    shown_mm: float,
    variants: list[str],
) -> None:
    change_elsewhere(other_station, visit, 7.0)
    thicken(opened, 5.0)
    dialog = conflict_dialog(opened, qtbot)
    assert_told(dialog)
    QTest.mouseClick(dialog.buttons[choice], Qt.MouseButton.LeftButton)
    wait_until_saved(opened, qtbot)
    assert_kept(opened, records, visit, shown_mm, variants)


def test_what_was_stored_elsewhere_is_offered_and_nothing_older_is_exported(
    opened: Application, other_station: Records, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    """Whoever works on is asked which of both it is to be; whoever only looks has to know, too."""
    texts = lambda: [n.text for n in opened.services.notices.notices if "newer" in n.text]  # noqa: E731
    thicken(opened, 6.0)
    wait_until_saved(opened, qtbot)
    opened.controller.run_action("export", False)
    stage = opened.features.export.stage
    assert stage is not None
    qtbot.waitUntil(lambda: bool(stage.presenter.parts))
    keeper, questions = opened.services.keeper, opened.services.messages.questions
    assert isinstance(questions, CannedQuestions)
    went_on: list[bool] = []
    keeper.when_newest(lambda: went_on.append(True), lambda: went_on.append(False))
    qtbot.waitUntil(lambda: went_on == [True])
    change_elsewhere(other_station, visit, 9.0)
    stage.presenter.ask_export()
    qtbot.waitUntil(lambda: questions.asked == ["newer"])
    opened.services.clinic._look_for_changes()  # as it does every few seconds
    qtbot.waitUntil(lambda: bool(texts()))
    assert opened.case.record.design.thickness_mm == 6.0
    questions.anyway = True
    stage.presenter.ask_export()
    qtbot.waitUntil(lambda: opened.case.record.design.thickness_mm == 9.0)
    assert texts() == []
    keeper.when_newest(lambda: went_on.append(True), lambda: went_on.append(False))
    qtbot.waitUntil(lambda: went_on == [True, True])
    thicken(opened, 7.0)
    wait_until_saved(opened, qtbot)
    assert newest_mm(records, visit) == 7.0
    assert texts() == []


def test_what_is_changed_while_the_newer_version_is_read_is_decided_on(
    opened: Application, other_station: Records, visit: Visit, qtbot: QtBot
) -> None:
    change_elsewhere(other_station, visit, 7.0)
    opened.services.keeper.open_newer(opened.services.messages.show_error)
    thicken(opened, 5.0)
    assert_told(conflict_dialog(opened, qtbot))
    design = opened.case.record.design
    assert design is not None
    assert design.thickness_mm == 5.0


def test_an_export_waits_for_the_saving_and_for_a_decision_on_a_conflict(
    opened: Application,
    other_station: Records,
    records: Records,
    visit: Visit,
    away: Callable[[bool], None],
    qtbot: QtBot,
) -> None:
    keeper, went_on = opened.services.keeper, list[float]()

    def ask() -> None:
        keeper.when_newest(lambda: went_on.append(newest_mm(records, visit)), pytest.fail)

    thicken(opened, 4.0)
    ask()
    keeper._save()
    thicken(opened, 4.5)
    ask()
    qtbot.waitUntil(lambda: went_on == [4.5])
    away(True)
    thicken(opened, 5.0)
    ask()
    qtbot.waitUntil(lambda: went_on == [4.5, 4.5])  # nothing waits for a silent record
    away(False)
    wait_until_saved(opened, qtbot)
    change_elsewhere(other_station, visit, 7.0)
    thicken(opened, 6.0)
    ask()
    conflict_dialog(opened, qtbot).reject()
    assert keeper.state is KeepState.CONFLICT
    with qtbot.waitSignal(keeper.conflicted):
        ask()
    assert went_on == [4.5, 4.5]


def newer_notices(app: Application) -> list[str]:
    return [n.text for n in app.services.notices.notices if n.key == "record-outdated"]


def look_for_newer(app: Application, qtbot: QtBot) -> None:
    """Look for what was stored elsewhere, as the window does every few seconds."""
    app.services.clinic._look_for_changes()
    qtbot.waitUntil(lambda: bool(newer_notices(app)))


def test_a_newer_version_is_offered_no_longer_once_it_is_decided_on(
    opened: Application, other_station: Records, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    change_elsewhere(other_station, visit, 7.0)
    look_for_newer(opened, qtbot)
    thicken(opened, 5.0)
    dialog = conflict_dialog(opened, qtbot)
    QTest.mouseClick(dialog.buttons[Choice.MINE], Qt.MouseButton.LeftButton)
    wait_until_saved(opened, qtbot)
    assert_kept(opened, records, visit, 5.0, ["A"])
    assert newer_notices(opened) == []
    change_elsewhere(other_station, visit, 8.0)
    look_for_newer(opened, qtbot)


def test_a_newer_version_is_offered_once_whatever_is_stored_after_it(
    opened: Application,
    other_station: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> None:
    base = change_elsewhere(other_station, visit, 7.0)
    look_for_newer(opened, qtbot)
    told: list[bool] = []
    opened.services.keeper.outdated.connect(lambda: told.append(True))
    opened.services.notices.drop("record-outdated")  # as its cross does
    change_elsewhere(other_station, visit, 7.5, base)
    other_station.persons.add(Person("Bo Ek"))
    opened.services.clinic._look_for_changes()
    qtbot.waitUntil(lambda: not opened.services.clinic.jobs.is_running())
    QTest.qWait(50)
    qtbot.waitUntil(lambda: not opened.services.clinic.jobs.is_running())
    assert (told, newer_notices(opened)) == ([], [])
    add_right_foot(other_station, visit, make_foot)
    look_for_newer(opened, qtbot)
    assert told == [True]


def test_a_newer_version_is_not_offered_to_a_case_that_became_one_of_a_file(
    opened: Application, other_station: Records, visit: Visit, tmp_path: Path, qtbot: QtBot
) -> None:
    change_elsewhere(other_station, visit, 7.0)
    look_for_newer(opened, qtbot)
    opened.case.mark_saved(opened.case.record, tmp_path / "case.insole")
    assert newer_notices(opened) == []


def add_right_foot(station: Records, visit: Visit, make_foot: Callable[[Side], Foot]) -> None:
    source = ScanSource("mesh", "/nowhere/right.ply", "0" * 64)
    station.prescriptions.save(visit.id, FootRecord.begun(make_foot(Side.RIGHT), source), None)


def test_a_foot_that_was_added_elsewhere_is_newer_than_what_is_open(
    opened: Application,
    other_station: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> None:
    add_right_foot(other_station, visit, make_foot)
    told: list[bool] = []
    opened.services.keeper.when_newest(pytest.fail, lambda: told.append(True))
    qtbot.waitUntil(lambda: told == [True])
    look_for_newer(opened, qtbot)
    opened.services.notices.take("record-outdated")
    qtbot.waitUntil(lambda: len(opened.case.record.feet) == 2)
    assert newer_notices(opened) == []


def assert_told(dialog: ConflictDialog) -> None:
    texts = " ".join(label.text() for label in dialog.findChildren(QLabel))
    assert "Dr. Dal, capture-room" in texts
    assert "7 mm → 5 mm" in texts


def assert_kept(
    opened: Application, records: Records, visit: Visit, shown_mm: float, variants: list[str]
) -> None:
    """The case shows what was chosen, and the record has both versions."""
    foot = opened.case.record.current
    assert foot is not None
    assert foot.design.thickness_mm == newest_mm(records, visit) == shown_mm
    assert [variant.name for variant in foot.variants] == variants
    kept = {
        records.prescriptions.read(version.id).design.thickness_mm
        for version in records.prescriptions.versions(visit.id, Side.LEFT)
    }
    assert {5.0, 7.0} <= kept


def test_a_decision_can_wait_and_may_be_for_ones_own_version(
    opened: Application, records: Records, other_station: Records, visit: Visit, qtbot: QtBot
) -> None:
    change_elsewhere(other_station, visit, 7.0)
    thicken(opened, 5.0)
    conflict_dialog(opened, qtbot).reject()
    assert opened.services.keeper.state is KeepState.CONFLICT
    assert [notice.offers for notice in opened.services.notices.notices] == [("Decide…",)]
    QTest.qWait(0)
    opened.services.notices.take("record-conflict")
    dialog = conflict_dialog(opened, qtbot)
    assert_told(dialog)
    QTest.mouseClick(dialog.buttons[Choice.MINE], Qt.MouseButton.LeftButton)
    wait_until_saved(opened, qtbot)
    assert_kept(opened, records, visit, 5.0, ["A"])


def rename_elsewhere(station: Records, visit: Visit, name: str) -> None:
    person = station.persons.get(visit.person_id)
    station.persons.change(replace(person, name=name), person.revision)


def rename(app: Application, name: str, notes: str = "") -> None:
    app.case.apply(replace(app.case.record.patient, name=name, notes=notes), "Name")


@pytest.mark.parametrize(
    ("choice", "name"), [(FieldChoice.MINE, "Anna Ek"), (FieldChoice.THEIRS, "Anna Lind")]
)
def test_both_values_of_a_patients_field_are_shown_to_who_saves_second(
    opened: Application,
    records: Records,
    other_station: Records,
    visit: Visit,
    qtbot: QtBot,
    choice: FieldChoice,
    name: str,
) -> None:
    rename_elsewhere(other_station, visit, "Anna Lind")
    rename(opened, "Anna Ek", "Flat foot")
    qtbot.waitUntil(lambda: bool(opened.window.findChildren(FieldConflictDialog)))
    (dialog,) = opened.window.findChildren(FieldConflictDialog)
    keeper = opened.services.keeper
    assert keeper.state is KeepState.CONFLICT
    dialog.choice_buttons["name", choice].click()
    QTest.mouseClick(dialog.store, Qt.MouseButton.LeftButton)
    wait_until_saved(opened, qtbot)
    patient = opened.case.record.patient
    assert (patient.name, patient.notes) == (name, "Flat foot")
    assert records.persons.get(visit.person_id).name == name
    assert records.visits.get(visit.id).findings == "Flat foot"
    if choice is FieldChoice.THEIRS:
        opened.case.undo()
        qtbot.waitUntil(lambda: records.persons.get(visit.person_id).name == "Anna Ek")


def test_a_journal_loses_no_field_that_somebody_else_has_changed(
    opened: Application,
    records: Records,
    other_station: Records,
    visit: Visit,
    paths: UserPaths,
    qtbot: QtBot,
) -> None:
    opened.services.keeper._timer.blockSignals(True)  # a crash comes before it is saved
    rename(opened, "Anna Ek", "Flat foot")
    opened.autosave.set_aside()
    opened.case.undo()
    rename_elsewhere(other_station, visit, "Anna Lind")
    told: list[tuple[str, bool]] = []
    opened.hand_over.handed_over.connect(lambda *said: told.append(said))
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    qtbot.waitUntil(lambda: told == [("Anna Ek", True)])
    assert records.persons.get(visit.person_id).name == "Anna Lind"
    assert records.visits.get(visit.id).findings == "Flat foot\nName: Anna Ek"


def test_work_waits_for_a_database_that_is_away_also_when_its_visit_is_left(
    opened: Application, records: Records, visit: Visit, away: Callable[[bool], None], qtbot: QtBot
) -> None:
    away(True)
    thicken(opened, 5.5)
    keeper = opened.services.keeper
    qtbot.waitUntil(lambda: keeper.state is KeepState.WAITING)
    kept = opened.window.status._kept
    qtbot.waitUntil(lambda: "your work is kept here" in kept.text())
    assert opened.autosave.is_kept
    away(False)
    wait_until_saved(opened, qtbot)
    assert newest_mm(records, visit) == 5.5

    away(True)
    thicken(opened, 6.0)
    opened.controller.run_action("new_case", False)
    qtbot.waitUntil(lambda: opened.case.kept is None)
    away(False)
    qtbot.waitUntil(lambda: newest_mm(records, visit) == 6.0)
    notices = opened.services.notices
    said = "Anna Berg: what was not saved yet is now in the record."
    qtbot.waitUntil(lambda: [notice.text for notice in notices.notices] == [said])


def test_a_journal_left_by_a_crash_is_handed_over_and_one_of_what_is_stored_is_no_conflict(
    opened: Application,
    records: Records,
    visit: Visit,
    away: Callable[[bool], None],
    paths: UserPaths,
    qtbot: QtBot,
) -> None:
    told: list[tuple[str, bool]] = []
    opened.hand_over.handed_over.connect(lambda *said: told.append(said))
    thicken(opened, 5.5)
    opened.autosave.set_aside()
    wait_until_saved(opened, qtbot)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    qtbot.waitUntil(lambda: told == [("Anna Berg", False)])
    assert len(records.prescriptions.versions(visit.id, Side.LEFT)) == 2

    away(True)
    thicken(opened, 6.0)
    opened.autosave.set_aside()  # as the copy of a program that has crashed: its lock is free
    opened.case.undo()
    away(False)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    qtbot.waitUntil(lambda: newest_mm(records, visit) == 6.0)
    qtbot.waitUntil(lambda: not list(paths.autosave_folder.glob("*.insole")))


def test_a_journal_changes_no_terms_but_those_that_were_changed_here(
    opened: Application,
    records: Records,
    visit: Visit,
    away: Callable[[bool], None],
    paths: UserPaths,
    qtbot: QtBot,
) -> None:
    def store_terms(terms: OrderTerms) -> None:
        stored = records.visits.get(visit.id)
        records.visits.change(replace(stored, terms=terms), stored.revision)
        case = opened.case
        qtbot.waitUntil(lambda: case.record.order.terms == case.saved_record.order.terms == terms)

    store_terms(OrderTerms(2, "black", remarks="soft heel"))
    away(True)
    thicken(opened, 5.5)
    opened.case.note_order(OrderNote(terms=OrderTerms(2, "black")))  # the remarks are emptied
    opened.autosave.set_aside()
    opened.case.open(CaseRecord(), None)
    stored = records.visits.get(visit.id)
    theirs = OrderTerms(2, "red", remarks="soft heel")
    records.visits.change(replace(stored, terms=theirs), stored.revision)
    away(False)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    qtbot.waitUntil(lambda: not list(paths.autosave_folder.glob("*.insole")))
    assert newest_mm(records, visit) == 5.5
    assert records.visits.get(visit.id).terms == OrderTerms(2, "red")


def test_a_journal_of_somebody_erased_meanwhile_goes_without_bringing_them_back(
    opened: Application,
    records: Records,
    visit: Visit,
    away: Callable[[bool], None],
    paths: UserPaths,
    qtbot: QtBot,
) -> None:
    away(True)
    thicken(opened, 5.5)
    opened.autosave.set_aside()
    opened.case.undo()
    erase_person(records.context, visit.person_id, ErasureReason.REQUEST, date.today())
    away(False)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    qtbot.waitUntil(lambda: not list(paths.autosave_folder.glob("*.insole")))
    assert newest_mm(records, visit) != 5.5
    assert records.persons.get(visit.person_id).name != "Anna Berg"


def test_a_journal_that_somebody_else_has_overtaken_stays_in_the_history(
    opened: Application,
    records: Records,
    other_station: Records,
    visit: Visit,
    away: Callable[[bool], None],
    paths: UserPaths,
    qtbot: QtBot,
) -> None:
    away(True)
    thicken(opened, 5.5)
    opened.autosave.set_aside()
    opened.case.undo()
    away(False)
    change_elsewhere(other_station, visit, 7.0)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    notices = opened.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    assert "somebody else changed the same foot" in notices.notices[0].text
    assert newest_mm(records, visit) == 7.0
    kept = records.prescriptions.versions(visit.id, Side.LEFT)
    thicknesses = [records.prescriptions.read(v.id).design.thickness_mm for v in kept]
    assert 5.5 in thicknesses


def test_work_stays_here_when_a_newer_program_has_changed_the_tables(
    opened: Application, other_station: Records, qtbot: QtBot
) -> None:
    with other_station.context.database.writing() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'")
    keeper = opened.services.keeper
    for thickness_mm in (5.5, 6.0):
        thicken(opened, thickness_mm)
        qtbot.waitUntil(lambda: keeper.state is KeepState.REFUSED)
    assert opened.case.has_unsaved_changes
    (dialog,) = opened.services.messages.dialogs  # which tells it once
    assert "install the newest version on this computer, too" in dialog.text()


def test_what_the_record_refuses_can_be_saved_as_a_file(
    opened: Application,
    questions,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    def refuse(*_given: object) -> None:
        raise RecordsError("This visit may not be changed.")

    monkeypatch.setattr(Prescriptions, "save", refuse)
    thicken(opened, 5.5)
    keeper = opened.services.keeper
    qtbot.waitUntil(lambda: keeper.state is KeepState.REFUSED)
    (dialog,) = opened.services.messages.dialogs
    assert dialog.text() == "This visit may not be changed."
    questions.path = tmp_path / "kept.insole"
    opened.controller.run_action("save_as", False)
    qtbot.waitUntil(lambda: opened.case.path is not None)
    assert keeper.state is KeepState.NOTHING
    assert not opened.case.has_unsaved_changes
    design = read_case(tmp_path / "kept.insole").design
    assert design is not None
    assert design.thickness_mm == 5.5


@pytest.fixture
def delete_elsewhere(
    clinic: Application, records: Records, other_station: Records, qtbot: QtBot
) -> Callable[[], str]:
    """Delete the visit that is open, which is empty, at the other station; return its id."""

    def delete() -> str:
        empty_id = clinic.services.keeper.visit_id
        qtbot.waitUntil(lambda: bool(other_station.presence.others(empty_id)))
        records.presence.leave(empty_id)  # as after a cut of the network
        other_station.visits.delete(empty_id)
        return empty_id

    return delete


@pytest.fixture
def empty(clinic: Application, records: Records, qtbot: QtBot) -> Visit:
    """A visit that holds nothing, open in the window."""
    anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    added = records.visits.add(Visit(anna.id, date(2026, 2, 28)))
    clinic.features.records.open_visit(added.id)
    qtbot.waitUntil(lambda: clinic.services.keeper.visit_id == added.id)
    return added


@pytest.fixture
def lost(
    clinic: Application,
    empty: Visit,
    delete_elsewhere: Callable[[], str],
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> Application:
    """The window with a foot on a visit that was deleted elsewhere, while it was empty."""
    delete_elsewhere()
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    clinic.case.open_foot(make_foot(Side.LEFT), source)
    qtbot.waitUntil(lambda: clinic.services.keeper.state is KeepState.REFUSED)
    return clinic


def lost_notice(app: Application) -> list[tuple[str, ...]]:
    return [shown.offers for shown in app.services.notices.notices if shown.key == "record-lost"]


def test_work_on_a_visit_that_was_deleted_elsewhere_is_kept_as_a_new_visit(
    lost: Application, records: Records, other_station: Records, qtbot: QtBot
) -> None:
    assert lost_notice(lost) == [("Keep as a new visit", "Save as a file…")]
    with qtbot.waitSignal(lost.services.keeper.lost):  # told again to whoever exports
        lost.services.keeper.when_newest(pytest.fail, pytest.fail)
    assert not lost.services.messages.dialogs
    kept = lost.case.kept
    assert kept is not None
    lost.services.notices.take("record-lost")
    wait_until_saved(lost, qtbot)
    (visit,) = records.visits.of_person(kept.person.id)
    assert visit.id == lost.services.keeper.visit_id != kept.visit.id
    assert visit.visited_on == date(2026, 2, 28)
    assert lost_notice(lost) == []
    thicken(lost, 5.5)
    wait_until_saved(lost, qtbot)
    assert newest_mm(records, visit) == 5.5
    qtbot.waitUntil(lambda: bool(other_station.presence.others(visit.id)))
    with qtbot.waitSignal(lost.controller.closed):
        lost.window.close()


def test_nothing_is_exported_of_a_visit_that_was_deleted_elsewhere(
    clinic: Application, empty: Visit, delete_elsewhere: Callable[[], str], qtbot: QtBot
) -> None:
    delete_elsewhere()
    keeper = clinic.services.keeper
    for _time in range(2):
        with qtbot.waitSignal(keeper.lost):
            keeper.when_newest(pytest.fail, pytest.fail)
    assert keeper.visit_id == empty.id
    assert lost_notice(clinic) == [("Keep as a new visit", "Save as a file…")]
    assert not clinic.services.messages.dialogs


def test_all_that_was_meant_for_a_lost_visit_comes_to_the_one_in_its_place(
    clinic: Application,
    records: Records,
    visit: Visit,
    delete_elsewhere: Callable[[], str],
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    """The scans, also one that was replaced, what the next foot is prescribed, and an order."""

    def scan(name: str, side: Side) -> None:
        path = tmp_path / name
        path.write_bytes(name.encode())
        source = ScanSource("mesh", str(path), sha256_of(path, 1000))
        foot = FootRecord.begun(make_foot(side), source)
        clinic.case.apply(foot, "Import a scan")

    for side in Side:
        opened = records.visits.open_case(visit.id)
        foot = opened.record.of_side(side) or FootRecord.begun(
            make_foot(side), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
        )
        thick = foot.with_design(replace(foot.design, thickness_mm=3.7))
        records.prescriptions.save(visit.id, thick, opened.bases.get(side))
    keeper, work = clinic.services.keeper, clinic.features.records
    work.show_person(visit.person_id)
    qtbot.waitUntil(lambda: work.person_on_page is not None)
    clinic.controller.run_action("new_visit_same", False)
    qtbot.waitUntil(lambda: keeper.visit_id not in ("", visit.id))
    qtbot.waitUntil(lambda: work.captures._stored is not None)
    lost_id = delete_elsewhere()
    for name in ("blurred.stl", "left.stl"):
        scan(name, Side.LEFT)
    qtbot.waitUntil(lambda: bool(lost_notice(clinic)))
    qtbot.waitUntil(lambda: not clinic.services.clinic.jobs.is_running())
    assert not clinic.services.messages.dialogs, "the notice alone tells what to do"
    solid = tmp_path / "solid.stl"
    solid.write_bytes(b"solid")
    ordered = Ordered((solid,), OrderTerms(colour="black"), "26-7")
    work.order_actions.note_export(clinic.case.record, ordered, lost_id)
    clinic.services.notices.take("record-lost")
    wait_until_saved(clinic, qtbot)
    assert keeper.visit_id not in (visit.id, lost_id)
    scan("right.stl", Side.RIGHT)
    names = {"blurred.stl", "left.stl", "right.stl"}
    qtbot.waitUntil(
        lambda: {one.file_name for one in records.captures.of_visit(keeper.visit_id)} == names
    )
    design = clinic.case.record.design
    assert design is not None
    assert design.thickness_mm == 3.7
    qtbot.waitUntil(lambda: bool(records.orders.of_person(visit.person_id)))
    (order,) = records.orders.of_person(visit.person_id)
    assert order.visit_id == keeper.visit_id
    wait_until_saved(clinic, qtbot)


def test_a_photo_for_a_lost_visit_comes_to_the_one_in_its_place(
    clinic: Application,
    records: Records,
    empty: Visit,
    delete_elsewhere: Callable[[], str],
    questions: CannedQuestions,
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    clinic.features.records.show_photos()
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(PhotosDialog)))
    (dialog,) = clinic.window.findChildren(PhotosDialog)
    questions.path = tmp_path / "sole.png"
    assert QImage(40, 30, QImage.Format.Format_RGB32).save(str(questions.path))
    delete_elsewhere()
    QTest.mouseClick(dialog.add, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(lost_notice(clinic)))
    assert not clinic.services.messages.dialogs, "the notice alone tells what to do"
    qtbot.waitUntil(lambda: not clinic.window.findChildren(PhotosDialog))  # so it can be reached
    clinic.services.notices.take("record-lost")
    wait_until_saved(clinic, qtbot)
    kept_id = clinic.services.keeper.visit_id
    assert kept_id != empty.id
    qtbot.waitUntil(lambda: len(records.photos.of_visit(kept_id)) == 1)
    clinic.features.records.show_photos()
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(PhotosDialog)))
    (dialog,) = clinic.window.findChildren(PhotosDialog)
    assert len(dialog.table.rows) == 1
    dialog.reject()
    wait_until_saved(clinic, qtbot)


@pytest.mark.parametrize("refusal", ["", "This visit may not be changed."])
def test_a_wish_for_a_new_visit_ends_with_the_saving_that_it_waited_for(
    refusal: str,
    clinic: Application,
    records: Records,
    empty: Visit,
    delete_elsewhere: Callable[[], str],
    make_foot: Callable[[Side], Foot],
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    """Be it saved after all or refused for another reason: a visit lost later is asked about."""

    def refuse(*_given: object) -> None:
        raise RecordsError(refusal)

    keeper = clinic.services.keeper
    with monkeypatch.context() as refused:
        if refusal:
            refused.setattr(keep_case, "keep_case", refuse)
        clinic.case.apply(replace(clinic.case.record.patient, born="1970-03-01"), "Edit")
        keeper.leave(lambda: None)  # saves at once
        keeper.keep_as_new_visit()
        ended = KeepState.REFUSED if refusal else KeepState.SAVED
        qtbot.waitUntil(lambda: keeper.state is ended)
    for dialog in clinic.services.messages.dialogs:
        assert dialog.text() == refusal
        dialog.done(0)
    assert delete_elsewhere() == empty.id
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    clinic.case.apply(FootRecord.begun(make_foot(Side.LEFT), source), "Import a scan")
    qtbot.waitUntil(lambda: bool(lost_notice(clinic)))
    assert keeper.visit_id == empty.id
    assert records.visits.of_person(empty.person_id) == []


def test_who_was_captured_for_stays_chosen_when_a_lost_visit_is_kept_as_a_new_one(
    lost: Application, qtbot: QtBot
) -> None:
    lost_id = lost.services.keeper.visit_id
    lost.controller.run_action("capture", False)
    stage = lost.features.capture.stage
    assert stage is not None
    visits = stage.view._visits
    qtbot.waitUntil(lambda: stage.view.visit_id == lost_id)
    lost.services.notices.take("record-lost")
    qtbot.waitUntil(lambda: stage.view.visit_id not in ("", lost_id))
    wait_until_saved(lost, qtbot)
    assert stage.view.visit_id == lost.services.keeper.visit_id
    assert visits.currentText() == "Anna Berg (open here)"
    assert visits.count() == 2
    stage.close()


def test_work_on_a_visit_that_was_deleted_elsewhere_is_saved_as_a_file(
    lost: Application, questions, tmp_path: Path, qtbot: QtBot
) -> None:
    messages = lost.services.messages
    for _attempt in range(2):  # whoever leaves is told each time why it does not go on
        lost.window.close()
        qtbot.waitUntil(lambda: bool(messages.dialogs))
        (dialog,) = messages.dialogs
        assert dialog.text() == (
            "This visit was deleted elsewhere: keep what you have made as a new visit, or save it "
            "as a file."
        )  # and not to open the person again, which leaves the work
        dialog.done(0)
    assert len(lost_notice(lost)) == 1
    questions.path = tmp_path / "kept.insole"
    lost.services.notices.take("record-lost", 1)
    qtbot.waitUntil(lambda: lost.case.path is not None)
    assert read_case(tmp_path / "kept.insole").of_side(Side.LEFT) is not None
    assert lost.services.keeper.state is KeepState.NOTHING
    assert lost_notice(lost) == []
    with qtbot.waitSignal(lost.controller.closed):
        lost.window.close()


def test_what_the_record_refuses_of_a_journal_waits_in_sight_and_can_become_a_case(
    opened: Application,
    records: Records,
    paths: UserPaths,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    def refuse(*_given: object) -> None:
        raise RecordsError("This visit may not be changed.")

    opened.services.keeper._timer.blockSignals(True)
    thicken(opened, 5.5)
    opened.autosave.set_aside()
    opened.case.undo()
    monkeypatch.setattr(Prescriptions, "save", refuse)
    opened.hand_over.take(find_recovered(paths.autosave_folder))
    notices = opened.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    (notice,) = notices.notices
    assert "is not in the record yet" in notice.text
    assert notice.offers == ("Open it as a case",)
    notices.take(notice.key)
    qtbot.waitUntil(lambda: opened.case.kept is None)
    design = opened.case.record.design
    assert design is not None
    assert design.thickness_mm == 5.5
    assert opened.case.has_unsaved_changes


def test_a_record_that_does_not_answer_at_the_start_is_opened_as_soon_as_it_does(
    opened: Application,
    records: Records,
    visit: Visit,
    paths: UserPaths,
    monkeypatch: pytest.MonkeyPatch,
    qtbot: QtBot,
) -> None:
    """A journal that was left waits meanwhile, told by its patient's name."""

    def fail(_location: object) -> None:
        raise Unreachable("The database does not answer.")

    opened.services.keeper._timer.blockSignals(True)
    thicken(opened, 5.5)
    opened.autosave.set_aside()
    opened.case.open(CaseRecord(), None)
    clinic, notices = opened.services.clinic, opened.services.notices
    clinic._retry.setInterval(20)
    with monkeypatch.context() as away:
        away.setattr(clinic_record, "_open", fail)
        clinic.reopen()
        qtbot.waitUntil(lambda: clinic.state is RecordState.REFUSED)
        opened.hand_over.take(find_recovered(paths.autosave_folder))
        (notice,) = notices.notices
        assert notice.text.startswith("Anna Berg: what was changed on ")
    said = "Anna Berg: what was not saved yet is now in the record."
    qtbot.waitUntil(lambda: [shown.text for shown in notices.notices] == [said])
    station = clinic.ask_now(lambda found: found)
    assert newest_mm(station, visit) == 5.5


def test_a_record_that_only_reads_is_not_asked_to_save_without_end(
    opened: Application,
    records: Records,
    visit: Visit,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each answer to a question would take it for back, and save at once, and fail."""
    retry_ms, tries = 500, 4
    monkeypatch.setattr(clinic_record, "RETRY_MS", retry_ms)
    monkeypatch.setattr(record_keeper, "RETRY_MS", retry_ms)
    attempts_s: list[float] = []
    with monkeypatch.context() as away:

        def fail(*_given: object) -> None:
            attempts_s.append(time.monotonic())
            raise Unreachable("The database does not answer.")

        away.setattr(Prescriptions, "save", fail)
        thicken(opened, 4.5)
        qtbot.waitUntil(lambda: len(attempts_s) >= tries + 2)
    # Without a rest they follow each other in milliseconds; the first two may: a change is one too.
    # Two timers may meet, so of the rests between four more tries two are counted.
    assert attempts_s[-1] - attempts_s[1] > 0.8 * 2 * retry_ms / 1000
    wait_until_saved(opened, qtbot)
    qtbot.waitUntil(lambda: opened.services.clinic.is_open)
    assert newest_mm(records, visit) == 4.5


def test_no_visit_is_begun_while_the_open_one_cannot_be_left(
    opened: Application,
    records: Records,
    other_station: Records,
    visit: Visit,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    opened.services.clinic._watch.stop()
    change_elsewhere(other_station, visit, 5.0)
    thicken(opened, 4.5)
    conflict_dialog(opened, qtbot).reject()
    opened.controller._go_to_step("patient")
    rest()
    opened.controller.run_action("new_visit", False)
    rest()
    assert [kept.id for kept in records.visits.of_person(visit.person_id)] == [visit.id]
    assert opened.services.keeper.visit_id == visit.id


def test_an_open_visit_takes_the_pseudonym_of_whom_it_is_merged_into_and_gives_it_back(
    opened: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    """In the window that exports, too, and through all steps of undo."""
    anna = records.persons.get(visit.person_id)
    twin = records.persons.add(Person("Anna Berg", anna.birth_date))
    thicken(opened, 4.5)
    wait_until_saved(opened, qtbot)
    opened.case.apply(replace(opened.case.record.patient, notes="Pain at night"), "Edit")
    wait_until_saved(opened, qtbot)
    opened.controller.run_action("export", False)
    opened.window.actions_by_key["merge_patients"].trigger()
    (dialog,) = opened.window.findChildren(MergeDialog)
    rest()
    if "visits 1" not in dialog.moves.text():
        dialog.swap.click()
        rest()
    dialog.merge.click()
    qtbot.waitUntil(lambda: opened.case.record.patient.pseudonym == twin.pseudonym)
    form = opened.features.export.stage.view.form
    assert form.pseudonym.text() == twin.pseudonym
    assert opened.case.kept is not None
    assert opened.case.kept.person.id == twin.id
    assert not opened.case.has_unsaved_changes
    for _ in range(2):
        opened.case.undo()
        assert opened.case.record.patient.pseudonym == twin.pseudonym
    wait_until_saved(opened, qtbot)
    assert records.persons.get(twin.id).pseudonym == twin.pseudonym
    dialog.tabs.setCurrentIndex(1)
    dialog.undo.click()
    qtbot.waitUntil(lambda: opened.case.record.patient.pseudonym == anna.pseudonym)
