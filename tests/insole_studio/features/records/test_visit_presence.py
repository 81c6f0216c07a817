"""Who else has the open visit open: other stations, and other windows of this one."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from canned_questions import CannedQuestions
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application, build_application

pytestmark = pytest.mark.own_window


def told(app: Application) -> list[str]:
    """What the window says of others, without the rest of its notices."""
    return [n.text for n in app.services.notices.notices if "open elsewhere" in n.text]


def test_a_second_window_says_that_the_visit_is_open_in_another_one(
    opened: Application,
    other_station: Records,
    visit: Visit,
    qapp: QApplication,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    """The record cannot: both windows are of one person at one station."""
    rest()
    assert told(opened) == []
    second = build_application(qapp, opened.services.paths)
    try:
        second.services.messages.questions = CannedQuestions()  # type: ignore[assignment]
        clinic = second.services.clinic
        clinic.open()
        qtbot.waitUntil(lambda: clinic.is_open)
        second.features.records.open_visit(visit.id)
        qtbot.waitUntil(lambda: told(second) != [])
        (sentence,) = told(second)
        assert "in another window of this computer" in sentence
        assert told(opened) == [], "the first one is not disturbed"
    finally:
        second.autosave.forget()
        second.close()
    rest()
    (present,) = other_station.presence.others(visit.id)
    assert present.visit_id == visit.id, "the first one has it open still"
