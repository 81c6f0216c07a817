"""Duplicates are merged, patients erased, and the audit log is read in the window."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date, timedelta

from administering import type_into
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.features.clinic.audit_dialog import AuditDialog
from insole_studio.features.clinic.erase_dialog import EraseDialog
from insole_studio.features.clinic.merge_dialog import MergeDialog

Run = Callable[[str, type], object]
BORN = date(1970, 2, 28)


def test_a_proposal_tells_what_moves_merges_and_is_undone(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    kept = records.persons.add(Person("Anna Berg", BORN))
    other = records.persons.add(Person("BERG, ANNA", BORN, contact="Storgatan 1"))
    records.visits.add(Visit(kept.id, date.today()))
    records.visits.add(Visit(other.id, date.today() - timedelta(days=9)))
    dialog = run("merge_patients", MergeDialog)
    assert isinstance(dialog, MergeDialog)
    rest()
    (row,) = dialog.proposals.rows
    assert row.cells == ("Anna Berg, 1970-02-28", "BERG, ANNA, 1970-02-28", "name and birth date")
    assert "From BERG, ANNA, 1970-02-28 to Anna Berg" in dialog.moves.text()
    assert "visits 1, orders 0, follow-ups 0" in dialog.moves.text()
    assert "contact" in dialog.moves.text()
    dialog.merge.click()
    rest()
    assert dialog.proposals.rows == ()
    assert len(records.visits.of_person(kept.id)) == 2
    assert records.persons.get(other.id).id == kept.id
    dialog.tabs.setCurrentIndex(1)
    (merge,) = dialog.merges.rows
    assert merge.cells[:2] == (
        f"Anna Berg, 1970-02-28, {kept.pseudonym}",
        f"BERG, ANNA, 1970-02-28, {other.pseudonym}",
    )
    assert dialog.undo.isVisible()
    dialog.undo.click()
    rest()
    assert dialog.merges.rows == ()
    assert len(records.visits.of_person(other.id)) == 1
    assert records.persons.get(kept.id).contact == ""


def test_two_persons_are_chosen_by_hand_and_swapped(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None], qtbot: QtBot
) -> None:
    anna = records.persons.add(Person("Anna Berg"))
    records.persons.add(Person("<b>Annika</b> Berg"))
    dialog = run("merge_patients", MergeDialog)
    assert isinstance(dialog, MergeDialog)
    assert dialog.proposals.rows == ()
    for button in (dialog.merge, dialog.swap):
        assert not button.isEnabled()
        assert button.toolTip() == "Choose two patients first."
    dialog.tabs.setCurrentIndex(1)
    assert not dialog.undo.isEnabled()
    assert dialog.undo.toolTip() == "Choose in the list what is to be undone first."
    dialog.tabs.setCurrentIndex(0)
    type_into(dialog.kept.search, "anna berg")
    rest()
    type_into(dialog.other.search, "anna berg")
    rest()
    assert "same person twice" in dialog.moves.text()
    assert not dialog.merge.isEnabled()
    type_into(dialog.other.search, "annika")
    rest()
    assert "From <b>Annika</b> Berg to Anna Berg" in dialog.moves.text()
    assert dialog.moves.textFormat() == Qt.TextFormat.PlainText
    assert dialog.merge.isEnabled()
    assert dialog.merge.toolTip() == ""
    dialog.swap.click()
    rest()
    assert "From Anna Berg to <b>Annika</b> Berg" in dialog.moves.text()
    dialog.merge.click()
    rest()
    assert records.persons.get(anna.id).name == "<b>Annika</b> Berg"


def test_erasing_tells_what_the_law_keeps_and_asks_for_the_reason(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None], qtbot: QtBot
) -> None:
    clinic.settings.recent = ["/home/Anna Berg.insole", "/home/eva.insole"]
    anna = records.persons.add(Person("Anna Berg", BORN, notes="nickel"))
    records.visits.add(Visit(anna.id, date.today(), findings="flat foot"))
    dialog = run("erase_patient", EraseDialog)
    assert isinstance(dialog, EraseDialog)
    assert dialog.erase.toolTip() == "Give the pseudonym of the patient first."
    type_into(dialog.pseudonym, "P-NOBODY")
    QTest.keyClick(dialog.pseudonym, Qt.Key.Key_Return)
    rest()
    assert "nobody to erase with the pseudonym P-NOBODY" in dialog.message.text()
    type_into(dialog.pseudonym, anna.pseudonym)
    dialog.find_button.click()
    rest()
    assert "visits 1, orders 0" in dialog.means.text()
    assert f"until {date.today().year + 10}" in dialog.means.text()
    assert "Anna" not in dialog.means.text()
    assert not dialog.erase.isEnabled()
    assert dialog.erase.toolTip() == "Choose the reason first."
    dialog.reason.setCurrentIndex(1)
    dialog.reason.activated.emit(1)
    dialog.erase.click()
    rest()
    assert dialog.erase.text() == f"Erase {anna.pseudonym} for good"
    assert "cannot be undone" in dialog.message.text()
    assert not records.persons.get(anna.id).is_erased
    type_into(dialog.pseudonym, anna.pseudonym)
    assert dialog.erase.text() == "Erase…", "what is asked is asked of who is shown"
    assert dialog.message.text() == ""
    dialog.find_button.click()
    rest()
    dialog.erase.click()
    dialog.erase.click()
    rest()
    assert "stay documented until" in dialog.message.text()
    erased = records.persons.get(anna.id)
    assert erased.is_erased
    assert erased.name == anna.pseudonym
    assert erased.notes == ""
    assert not dialog.erase.isEnabled()
    qtbot.waitUntil(lambda: clinic.settings.recent == ["/home/eva.insole"])


def test_whoever_is_on_the_page_is_proposed_to_be_erased_by_the_pseudonym_there(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    anna = records.persons.add(Person("Anna Berg", BORN))
    pages = clinic.features.records
    pages.show_person(anna.id)
    rest()
    assert pages.person is not None
    assert anna.pseudonym in [label.text() for label in pages.person.findChildren(QLabel)]
    dialog = run("erase_patient", EraseDialog)
    assert isinstance(dialog, EraseDialog)
    rest()
    assert dialog.pseudonym.text() == anna.pseudonym
    assert "visits 0, orders 0" in dialog.means.text()
    assert dialog.means.text().startswith("Anna Berg, 1970-02-28")
    berta = records.persons.add(Person("Berta Dal", BORN))
    type_into(dialog.pseudonym, berta.pseudonym)
    dialog.find_button.click()
    rest()
    assert berta.pseudonym in dialog.means.text()
    assert "Anna" not in dialog.means.text()
    assert "Berta" not in dialog.means.text(), (
        "whoever erases may not be somebody who sees patients"
    )


def test_the_log_is_filtered_by_patient_author_and_day_and_verified(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    anna, berta = (records.persons.add(Person(name)) for name in ("Anna Berg", "Berta Dal"))
    records.visits.add(Visit(anna.id, date.today()))
    dialog = run("audit_log", AuditDialog)
    assert isinstance(dialog, AuditDialog)
    rest()
    assert len(dialog.table.rows) == 3
    assert all("Anna" not in " ".join(row.cells) for row in dialog.table.rows)
    type_into(dialog.pseudonym, anna.pseudonym.lower())
    dialog.show_button.click()
    rest()
    assert [row.cells[4] for row in dialog.table.rows] == ["added", "added"]
    assert dialog.table.rows[1].cells[5] == f"person {anna.pseudonym}"
    type_into(dialog.pseudonym, berta.pseudonym)
    type_into(dialog.first_day, "2020-13-40")
    dialog.show_button.click()
    assert "is no date" in dialog.message.text()
    assert dialog.table.rows == ()
    assert not dialog.more.isEnabled()
    assert "No lines are shown yet" in dialog.more.toolTip()  # older ones, there may be
    type_into(dialog.first_day, (date.today() + timedelta(days=3)).isoformat())
    QTest.keyClick(dialog.first_day, Qt.Key.Key_Return)
    rest()
    assert dialog.table.rows == ()
    assert "Nothing was written that fits" in dialog.message.text()
    dialog.verify.click()
    rest()
    assert "All 3 lines are what was written" in dialog.message.text()


def test_older_lines_come_on_request(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    with records.context.database.writing() as connection:
        for _ in range(250):
            records.context.log(connection, "exported", "person", "nobody")
    dialog = run("audit_log", AuditDialog)
    assert isinstance(dialog, AuditDialog)
    rest()
    assert len(dialog.table.rows) == 200
    dialog.more.click()
    rest()
    assert len(dialog.table.rows) == 250
    assert not dialog.more.isEnabled()
    assert "There are no older lines" in dialog.more.toolTip()


def test_those_whose_time_is_over_are_listed_and_erased_once_that_was_confirmed(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    """The clinic keeps its record for twelve years: for two of three that is over."""
    today = date.today()
    added = []
    for number, years in enumerate((13, 14, 11)):
        person = records.persons.add(Person(f"Patient {number}"))
        records.visits.add(Visit(person.id, today.replace(day=1, year=today.year - years)))
        added.append(person)
    with records.context.database.writing() as connection:
        connection.exec_driver_sql("UPDATE persons SET created_at = '2000-01-01T00:00:00'")
    dialog = run("erase_patient", EraseDialog)
    assert isinstance(dialog, EraseDialog)
    assert len(dialog.over.rows) == 3
    dialog.years.setFocus()
    dialog.years.selectAll()
    QTest.keyClicks(dialog.years, "12")
    QTest.keyClick(dialog.years, Qt.Key.Key_Tab)
    rest()
    oldest_first = [added[1].pseudonym, added[0].pseudonym]
    assert [row.cells[0] for row in dialog.over.rows] == oldest_first
    assert dialog.erase_all.text() == "Erase all listed…"
    dialog.erase_all.click()
    rest()
    assert dialog.erase_all.text() == "Erase 2 patients for good"
    assert "the 2 listed patients goes" in dialog.message.text()
    assert not any(records.persons.get(person.id).is_erased for person in added)
    dialog.erase_all.click()
    rest()
    assert [records.persons.get(person.id).is_erased for person in added] == [True, True, False]
    assert "Patients erased: 2." in dialog.message.text()
    assert "Nobody's time of keeping is over." in dialog.words.text()
    assert not dialog.erase_all.isVisible()


def test_one_patient_whose_time_is_over_is_told_as_one(
    clinic: Application, records: Records, run: Run, rest: Callable[[], None]
) -> None:
    person = records.persons.add(Person("Patient"))
    records.visits.add(Visit(person.id, date.today().replace(day=1, year=2000)))
    with records.context.database.writing() as connection:
        connection.exec_driver_sql("UPDATE persons SET created_at = '2000-01-01T00:00:00'")
    dialog = run("erase_patient", EraseDialog)
    assert isinstance(dialog, EraseDialog)
    assert len(dialog.over.rows) == 1
    dialog.erase_all.click()
    rest()
    assert dialog.erase_all.text() == "Erase one patient for good"
    assert "of the listed patient goes" in dialog.message.text()


def test_the_record_is_kept_no_shorter_than_the_law_asks_for(clinic: Application, run: Run) -> None:
    dialog = run("erase_patient", EraseDialog)
    assert isinstance(dialog, EraseDialog)
    dialog.years.setValue(3)
    assert dialog.years.value() == 10
