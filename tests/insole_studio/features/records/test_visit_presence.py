"""Who else has the open visit open: other stations, and other windows of this one."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from canned_questions import CannedQuestions
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application, build_application

pytestmark = pytest.mark.own_window


def told(app: Application) -> list[str]:
    """What the window says of others, without the rest of its notices."""
    return [n.text for n in app.services.notices.notices if "open elsewhere" in n.text]


@pytest.fixture
def second(
    opened: Application,
    visit: Visit,
    qapp: QApplication,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> Iterator[Application]:
    """Another window at this station, with the same visit on its panels."""
    rest()
    assert told(opened) == []
    window = build_application(qapp, opened.services.paths)
    window.services.messages.questions = CannedQuestions()  # type: ignore[assignment]
    clinic = window.services.clinic
    clinic.open()
    qtbot.waitUntil(lambda: clinic.is_open)
    window.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: told(window) != [])
    yield window
    window.autosave.forget()
    window.close()


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
    assert told(opened) == [], "the first one is not disturbed"
    second.case.open(CaseRecord(), None)
    qtbot.waitUntil(lambda: not second.services.clinic.jobs.is_running())
    (present,) = other_station.presence.others(visit.id)
    assert present.visit_id == visit.id, "the first one has it open still"


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
