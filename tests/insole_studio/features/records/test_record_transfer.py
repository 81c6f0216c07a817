"""Importing tables and case files, and exporting a patient, by the events a user makes."""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import date
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.records.person import Person
from insole_studio.features.records.import_dialog import (
    CharacterSetDialog,
    ImportDialog,
    TableImportDialog,
)
from insole_studio.features.records.record_transfer import PersonExportDialog

_TABLE = "Namn;Född;Ort\nÅsa Öberg;02/03/1970;Malmö\nPer Ek;04/05/1980;\nLena;1980-02-30;\n"


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "patients.csv"
    path.write_bytes(_TABLE.encode("cp1252"))
    return path


@pytest.fixture
def open_table(clinic, questions, rest) -> Callable[[Path], TableImportDialog]:
    def open_it(path: Path) -> TableImportDialog:
        questions.path = path
        clinic.features.records.transfer.import_table()
        rest()
        dialog = _dialog(clinic, TableImportDialog)
        assert dialog is not None
        return dialog

    return open_it


def test_a_table_is_imported_once_the_order_of_days_was_said(
    clinic, records, rest, table, open_table
):
    dialog = open_table(table)
    assert [box.currentText() for box in dialog.columns] == ["Name", "Born", "Address, phone"]
    assert dialog.reading.text() == "3 rows, Windows-1252, semicolon"
    assert "day or the month" in dialog.trouble.text()
    assert dialog.rows == ()
    assert not dialog.add_button.isEnabled()
    assert dialog.add_button.toolTip() != ""
    assert dialog.order.isVisible()
    _choose(dialog.order, "day first")
    rest()
    assert [(row.place, row.outcome) for row in dialog.rows] == [
        ("2", "new"), ("3", "new"), ("4", "refused"),
    ]  # fmt: skip
    assert dialog.table.rows[0].cells[0] == "4"  # what needs a look comes first
    assert dialog.add_button.text() == "Add 2"
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    found = {person.name: person for person in records.persons.everybody()}
    assert found.keys() == {"Åsa Öberg", "Per Ek"}
    assert found["Åsa Öberg"].birth_date == date(1970, 3, 2)
    assert records.persons.get(found["Åsa Öberg"].id).contact == "Malmö"
    assert [notice.text for notice in clinic.services.notices.notices] == [
        "Import: 2 added (2 new, 1 refused)"
    ]
    assert QApplication.activeModalWidget() is None


def test_names_of_an_unclear_character_set_are_chosen_by_reading_them(
    clinic, questions, rest, tmp_path
):
    path = tmp_path / "patients.csv"
    path.write_bytes("Name;Born\nAyşe Şahin;1970-02-28\n".encode("iso8859-9"))
    questions.path = path
    clinic.features.records.transfer.import_table()
    rest()
    asked = _dialog(clinic, CharacterSetDialog)
    texts = {key: button.text() for key, button in asked.readings.items()}
    assert texts["cp1252"] == "Ayþe, Þahin   (Western European)"
    assert texts["cp1254"] == "Ayşe, Şahin   (Turkish)"
    assert not asked.read.isEnabled()
    assert asked.read.toolTip() == "Choose first which names are right."
    asked.readings["cp1254"].click()
    QTest.mouseClick(asked.read, Qt.MouseButton.LeftButton)
    rest()
    dialog = _dialog(clinic, TableImportDialog)
    assert dialog.table.rows[0].cells[2] == "Ayşe Şahin"
    assert dialog.reading.text() == "1 row, Windows-1254, semicolon"


def test_a_column_that_is_no_name_is_told_until_one_is_chosen(rest, tmp_path, open_table):
    path = tmp_path / "odd.csv"
    path.write_text("X,Y\nAnna Berg,1\n", encoding="utf-8")
    dialog = open_table(path)
    assert "No column holds the names" in dialog.trouble.text()
    assert not dialog.order.isVisible()
    assert not dialog.kind.isVisible()
    _choose(dialog.columns[1], "personal_number")
    assert dialog.kind.isVisible()
    _choose(dialog.columns[0], "name")
    rest()
    assert dialog.trouble.text() == ""
    assert dialog.add_button.text() == "Add 1"
    dialog.reject()


def test_doubtful_patients_are_added_on_demand(records, rest, tmp_path, open_table):
    records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    path = tmp_path / "doubtful.csv"
    path.write_text("Name\nAnna Berg\n", encoding="utf-8")
    dialog = open_table(path)
    assert not dialog.add_button.isEnabled()
    dialog.with_doubtful.click()
    assert dialog.add_button.text() == "Add 1"
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    assert len(records.persons.everybody()) == 2


def test_closing_the_dialog_adds_nobody_and_the_report_is_kept(
    records, rest, table, tmp_path, open_table, questions
):
    dialog = open_table(table)
    _choose(dialog.order, "day first")
    rest()
    questions.path = tmp_path / "report.csv"
    QTest.mouseClick(dialog.report_button, Qt.MouseButton.LeftButton)
    assert '4,refused,,"1980-02-30 is no date' in (tmp_path / "report.csv").read_text("utf-8")
    dialog.reject()
    rest()
    assert records.persons.everybody() == []


def test_a_file_that_is_no_table_is_told(clinic, rest, tmp_path, questions):
    path = tmp_path / "picture.csv"
    path.write_bytes(bytes(range(256)))
    questions.path = path
    clinic.features.records.transfer.import_table()
    rest()
    assert len(clinic.services.messages.dialogs) == 1
    assert _dialog(clinic, ImportDialog) is None


def test_case_files_become_visits(clinic, records, rest, tmp_path, questions):
    patient = Patient("Anna Berg", "1970-02-28", "2026-03-01")
    write_case(CaseRecord(patient), tmp_path / "anna.insole")
    (tmp_path / "bad.insole").write_bytes(b"x")
    questions.path = tmp_path
    clinic.features.records.transfer.import_cases()
    rest()
    dialog = _dialog(clinic, ImportDialog)
    assert [row.outcome for row in dialog.rows] == ["new", "refused"]
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    (person,) = records.persons.everybody()
    assert person.last_visit == date(2026, 3, 1)


def test_a_patient_is_exported_with_a_pseudonym(clinic, records, rest, tmp_path, questions):
    person = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    clinic.features.records.show_person(person.id)
    rest()
    clinic.features.records.export_patient()
    dialog = _dialog(clinic, PersonExportDialog)
    dialog.pseudonymous.click()
    questions.path = tmp_path
    dialog.accept()
    rest()
    folder = tmp_path / person.pseudonym
    assert json.loads((folder / "person.json").read_text())["person"]["name"] == ""


def _dialog(clinic, kind):
    found = [d for d in clinic.window.findChildren(kind) if d.isVisible()]
    return found[0] if found else None


def _choose(box, value):
    """Choose an entry by the keyboard, as a user does."""
    box.setFocus()
    number = box.findData(value)
    box.setCurrentIndex(number)
    box.activated.emit(number)
