"""The sample patient in the window: shown from Help, removed on its page, its name locked."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.features.records.person_page import PersonPage
from insole_studio.services.questions import Answer

NAME = "Anna Example (sample patient)"


def page_of(clinic: Application) -> PersonPage:
    page = clinic.features.records.person
    assert page is not None
    return page


def removal_of(clinic: Application) -> QPushButton:
    buttons = page_of(clinic).findChildren(QPushButton)
    return next(b for b in buttons if b.property("action") == "remove_sample")


@pytest.fixture
def sample(clinic: Application, rest: Callable[[], None]) -> Application:
    """The window on the page of the sample patient."""
    clinic.window.actions_by_key["sample_patient"].trigger()
    rest()
    rest()
    return clinic


def test_a_first_start_has_a_sample_and_a_removed_one_stays_away(
    clinic: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    clinic.features.records.sample.add_at_first_start()
    rest()
    start = clinic.features.records.start
    assert start is not None
    qtbot.waitUntil(lambda: [row.cells[0] for row in start.found.rows] == [NAME])
    clinic.window.actions_by_key["remove_sample"].trigger()
    qtbot.waitUntil(lambda: not start.found.rows)
    clinic.features.records.sample.add_at_first_start()
    rest()
    assert records.persons.recent() == []


def test_a_record_that_has_patients_gets_no_sample_by_itself(
    clinic: Application, records: Records, rest: Callable[[], None]
) -> None:
    records.persons.add(Person("Eva Berg"))
    clinic.features.records.sample.add_at_first_start()
    rest()
    assert records.persons.sample() is None


def test_its_page_says_what_it_is_and_removes_it_after_a_question(
    sample: Application, records: Records, questions, rest: Callable[[], None], qtbot: QtBot
) -> None:
    eva = records.persons.add(Person("Eva Berg"))
    sample.features.records.show_person(eva.id)
    rest()
    assert not removal_of(sample).isVisible()
    assert not page_of(sample)._fields["name"].isReadOnly()
    sample.window.actions_by_key["sample_patient"].trigger()
    qtbot.waitUntil(lambda: removal_of(sample).isVisible())
    questions.unsaved = Answer.CANCEL
    QTest.mouseClick(removal_of(sample), Qt.MouseButton.LeftButton)
    rest()
    assert records.persons.sample() is not None
    questions.unsaved = Answer.DISCARD
    QTest.mouseClick(removal_of(sample), Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: sample.window.page is sample.features.records.start)
    assert questions.asked == ["remove sample"] * 2
    assert records.persons.sample() is None


def test_neither_page_nor_case_takes_its_label_and_it_goes_while_it_is_open(
    sample: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    assert page_of(sample)._fields["name"].isReadOnly()
    person = records.persons.sample()
    assert person is not None
    (visit,) = records.visits.of_person(person.id)
    sample.features.records.open_visit(visit.id)
    rest()
    name = next(
        field
        for field in sample.stage.patient.findChildren(QLineEdit)
        if field.property("key") == "name"
    )
    name.setFocus()
    name.selectAll()
    QTest.keyClicks(name, "Eva Berg")
    QTest.keyClick(name, Qt.Key.Key_Return)
    assert sample.case.record.patient.name == name.text() == NAME
    assert sample.window.windowTitle().startswith(NAME)
    sample.window.actions_by_key["remove_sample"].trigger()
    qtbot.waitUntil(lambda: sample.window.page is sample.features.records.start)
    rest()
    assert sample.case.is_empty
    assert records.persons.sample() is None
