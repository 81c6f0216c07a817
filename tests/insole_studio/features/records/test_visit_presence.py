"""Who else has the open visit open: other stations, and other windows of this one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import date

import pytest
from canned_questions import CannedQuestions
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application, build_application

pytestmark = pytest.mark.own_window


def told(app: Application) -> list[str]:
    """What the window says of others, without the rest of its notices."""
    return [n.text for n in app.services.notices.notices if "open elsewhere" in n.text]


@pytest.fixture
def another_window(clinic: Application, qapp: QApplication, qtbot: QtBot) -> Iterator[Application]:
    """Another window at this station, with the same record and nothing on its panels."""
    window = build_application(qapp, clinic.services.paths)
    window.services.messages.questions = CannedQuestions()  # type: ignore[assignment]
    window.services.clinic.open()
    qtbot.waitUntil(lambda: window.services.clinic.is_open)
    yield window
    window.autosave.forget()
    window.close()


@pytest.fixture
def second(
    opened: Application,
    another_window: Application,
    visit: Visit,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> Application:
    """Another window at this station, with the same visit on its panels."""
    rest()
    assert told(opened) == []
    another_window.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: told(another_window) != [])
    return another_window


def test_a_second_window_says_that_the_visit_is_open_in_another_one(
    opened: Application,
    second: Application,
    other_station: Records,
    visit: Visit,
    qtbot: QtBot,
) -> None:
    """The record cannot: both windows are of one person at one station."""
    (sentence,) = told(second)
    assert "in another window of this computer" in sentence
    opened.features.records._presence._enter()  # as it does every few seconds
    qtbot.waitUntil(lambda: told(opened) == [sentence])
    second.case.open(CaseRecord(), None)
    qtbot.waitUntil(lambda: not second.services.clinic.jobs.is_running())
    (present,) = other_station.presence.others(visit.id)
    assert present.visit_id == visit.id, "the first one has it open still"
    opened.features.records._presence._enter()
    qtbot.waitUntil(lambda: told(opened) == [])


def test_others_see_the_visit_open_until_the_last_window_here_has_closed_it(
    opened: Application,
    second: Application,
    other_station: Records,
    visit: Visit,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    opened.case.open(CaseRecord(), None)
    rest()
    (present,) = other_station.presence.others(visit.id)
    assert present.visit_id == visit.id, "the second one has it open still"
    second.features.records._presence._enter()  # as it does every few seconds
    qtbot.waitUntil(lambda: told(second) == [])
    opened.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: told(opened) != [])
    second.case.open(CaseRecord(), None)
    opened.case.open(CaseRecord(), None)
    qtbot.waitUntil(lambda: other_station.presence.others(visit.id) == [])


def test_an_empty_visit_is_not_deleted_while_another_window_has_it_open(
    clinic: Application,
    another_window: Application,
    records: Records,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    """Whoever begins it there would lose it; it is deleted once that window has closed it."""
    anna = records.persons.add(Person("Anna Berg"))
    empty = records.visits.add(Visit(anna.id, date.today()))
    clinic.features.records.show_person(anna.id)
    rest()
    page = clinic.features.records.person
    assert page is not None
    another_window.features.records.open_visit(empty.id)
    qtbot.waitUntil(lambda: another_window.case.kept is not None)

    def delete() -> None:
        buttons = page.cards[empty.id].findChildren(QPushButton)
        next(button for button in buttons if button.property("action") == "delete").click()
        rest()

    delete()
    assert [dialog.text() for dialog in clinic.services.messages.dialogs] == [
        "The visit is open in another window of this computer; close it there before it is deleted."
    ]
    assert records.visits.of_person(anna.id) == [empty]
    clinic.features.records.open_visit(empty.id)  # also where it is open here, too
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    delete()
    assert clinic.case.kept is not None, "it stays open here"
    assert records.visits.of_person(anna.id) == [empty]
    another_window.case.open(CaseRecord(), None)
    qtbot.waitUntil(lambda: not another_window.services.clinic.jobs.is_running())
    delete()
    qtbot.waitUntil(lambda: not page.cards)
    assert records.visits.of_person(anna.id) == []
