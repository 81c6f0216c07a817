"""The window shows one patient at a time: no step and no action works on another one's case."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QToolButton
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.actions import ACTIONS
from insole_studio.app.bootstrap import Application
from insole_studio.services.questions import Answer

pytestmark = pytest.mark.one_window


@pytest.fixture
def oberg(records: Records) -> Person:
    """Somebody in the record, with no visit."""
    return records.persons.add(Person("Åke Öberg"))


@pytest.fixture
def annas(clinic: Application, oberg: Person, make_foot: Callable[[Side], Foot]) -> Application:
    """The window with an unsaved case of Anna, who is not in the record; a lift is selected."""
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    clinic.case.open_foot(make_foot(Side.LEFT), source)
    clinic.case.apply(Patient("Anna Berg"), "Name")
    lift = HeelLift(height_mm=6.0)
    assert clinic.case.record.design is not None
    clinic.case.apply(clinic.case.record.design.with_added(lift), "Lift the heel")
    clinic.case.select(lift.id)
    return clinic


def look_up(app: Application, name: str, qtbot: QtBot) -> None:
    """Press F3, type a name, and press Enter."""
    app.controller.run_action("patients", False)
    page = app.features.records.start
    assert page is not None
    QTest.keyClicks(page.search, name)
    qtbot.waitUntil(lambda: [row.cells[0] for row in page.found.rows] == [name])
    QTest.keyClick(page.search, Qt.Key.Key_Return)


def words_of_strip(app: Application) -> list[str]:
    return [label.text() for label in app.stage.steps.findChildren(QLabel)]


def steps_enabled(app: Application) -> list[str]:
    buttons = app.stage.steps.findChildren(QToolButton)
    return [button.property("key") for button in buttons if button.isEnabled()]


def test_another_page_is_not_shown_while_work_on_a_case_goes_on(
    annas: Application, questions: CannedQuestions, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    questions.unsaved = Answer.CANCEL
    record = annas.case.record
    look_up(annas, "Åke Öberg", qtbot)
    rest()
    assert questions.asked == ["unsaved"]
    assert annas.window.page is annas.features.records.start
    assert annas.case.record is record
    assert "Anna Berg  ·  LEFT foot" in words_of_strip(annas)


def test_title_steps_and_actions_are_those_of_the_page(
    annas: Application,
    questions: CannedQuestions,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    questions.unsaved = Answer.DISCARD
    look_up(annas, "Åke Öberg", qtbot)
    qtbot.waitUntil(lambda: "Öberg" in annas.window.windowTitle())
    rest()
    assert annas.window.page is annas.features.records.person
    assert annas.case.is_empty
    assert "Åke Öberg" in words_of_strip(annas)
    assert not any("Anna" in word for word in words_of_strip(annas))
    assert steps_enabled(annas) == ["patient"]
    actions = annas.window.actions_by_key
    of_case = [r.key for r in ACTIONS if r.needs_foot or r.needs_both]
    assert not [key for key in of_case if actions[key].isEnabled()]
    assert not annas.window._pads_entry.isEnabled()


def test_a_visit_is_saved_and_left_when_another_patient_is_looked_up(
    clinic: Application,
    records: Records,
    visit: Visit,
    oberg: Person,
    qtbot: QtBot,
    rest: Callable[[], None],
) -> None:
    clinic.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    design = clinic.case.record.design
    assert design is not None
    clinic.case.apply(replace(design, thickness_mm=4.5), "Thickness")
    look_up(clinic, "Åke Öberg", qtbot)
    qtbot.waitUntil(lambda: "Öberg" in clinic.window.windowTitle())
    rest()
    assert clinic.case.kept is None
    newest = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    assert records.prescriptions.read(newest.id).design.thickness_mm == 4.5


def test_the_page_of_the_open_case_keeps_its_steps(
    clinic: Application, visit: Visit, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    clinic.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    look_up(clinic, "Anna Berg", qtbot)
    rest()
    assert clinic.window.page is clinic.features.records.person
    assert clinic.case.kept is not None
    assert "export" in steps_enabled(clinic)


def test_nothing_is_changed_in_a_case_behind_a_page(annas: Application) -> None:
    """On the start page the case is not seen, so neither undo nor delete may reach it."""
    record = annas.case.record
    assert len(annas.case.history) > 0
    annas.controller.run_action("patients", False)
    for key in ("undo", "redo", "remove"):
        annas.window.actions_by_key[key].trigger()
        assert annas.case.record is record, key
