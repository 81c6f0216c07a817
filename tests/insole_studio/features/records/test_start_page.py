"""The program opens on the clinic's patients: search, new patient, everything by keyboard."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, date, datetime, time, timedelta
from typing import NoReturn

import pytest
from canned_questions import CannedQuestions
from pointing import click_heading
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.errors import RecordsError
from insole_core.records.person import Person
from insole_core.records.persons import add_persons
from insole_core.records.records import Records
from insole_core.records.rights import Right
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.app.theme import DARK, LIGHT
from insole_studio.features.records.patient_dialogs import NewPatientDialog
from insole_studio.features.records.start_page import StartPage
from insole_studio.features.records.start_presenter import MOST_FOUND
from insole_studio.services.questions import Namesake
from insole_studio.widgets.tour import Tour

pytestmark = pytest.mark.one_window


def page_of(clinic: Application) -> StartPage:
    page = clinic.features.records.start
    assert page is not None
    return page


def names(page: StartPage) -> list[str]:
    return [row.cells[0] for row in page.found.rows]


def dialog_of(clinic: Application) -> NewPatientDialog:
    (dialog,) = clinic.window.findChildren(NewPatientDialog)
    return dialog


def fill(dialog: NewPatientDialog, name: str, born: str = "", number: str = "") -> None:
    for field, text in ((dialog.name, name), (dialog.born, born), (dialog.number, number)):
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, text)


@pytest.mark.parametrize("is_shown", [True, False])
def test_the_icons_have_the_colour_of_the_theme(clinic: Application, is_shown: bool) -> None:
    page = page_of(clinic)
    if not is_shown:
        clinic.controller.run_action("new_case", False)
    assert page.isVisible() is is_shown

    def colors() -> set[str]:
        found: set[str] = set()
        for button in page.findChildren(QPushButton):
            if not button.icon().isNull():
                image = button.icon().pixmap(button.iconSize()).toImage()
                places = [(x, y) for x in range(image.width()) for y in range(image.height())]
                seen = [image.pixelColor(x, y) for x, y in places]
                found |= {color.name() for color in seen if color.alpha() == 255}
        return found

    light = colors()
    clinic.controller.run_action("dark", True)
    dark = colors()
    clinic.controller.run_action("dark", False)
    assert (light, dark) == ({LIGHT.text}, {DARK.text})
    assert colors() == light


def test_the_search_line_has_the_focus_and_the_panels_have_gone(clinic: Application) -> None:
    page = page_of(clinic)
    assert clinic.window.page is page
    assert QApplication.focusWidget() is page.search
    assert not clinic.stage.patient.isVisible()
    assert clinic.stage.steps.isVisible()


@pytest.mark.usefixtures("unmade_tables")
def test_the_window_makes_the_tables_of_a_new_record(clinic: Application, records: Records) -> None:
    assert clinic.services.clinic.trouble == ""
    assert records.upgrade is None
    assert records.persons.add(Person("Anna Berg")).revision == 1


def test_patients_are_found_as_they_are_typed_and_enter_opens_the_first(
    clinic: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    for name in ("Anna Berg", "Ängla Åström", "Bertil Annasson"):
        records.persons.add(Person(name, date(1970, 2, 28)))
    page = page_of(clinic)
    QTest.keyClicks(page.search, "angla astr")
    qtbot.waitUntil(lambda: names(page) == ["Ängla Åström"])
    page.search.clear()
    QTest.keyClicks(page.search, "anna")
    qtbot.waitUntil(lambda: names(page) == ["Anna Berg", "Bertil Annasson"])
    QTest.keyClick(page.search, Qt.Key.Key_Return)
    rest()
    person = clinic.features.records.person
    assert person is not None
    assert clinic.window.page is person
    assert person._fields["name"].text() == "Anna Berg"


def test_the_arrows_go_from_the_search_line_into_the_list(
    clinic: Application, records: Records, qtbot: QtBot
) -> None:
    for name in ("Anna Berg", "Anna Dal"):
        records.persons.add(Person(name))
    page = page_of(clinic)
    QTest.keyClicks(page.search, "anna")
    qtbot.waitUntil(lambda: names(page) == ["Anna Berg", "Anna Dal"])  # not the recent ones
    QTest.keyClick(page.search, Qt.Key.Key_Down)
    assert QApplication.focusWidget() is page.found
    QTest.keyClick(page.found, Qt.Key.Key_Down)
    QTest.keyClick(page.found, Qt.Key.Key_Return)
    opened = clinic.features.records
    qtbot.waitUntil(lambda: opened.person is not None and opened.person._name.text() == "Anna Dal")


def test_todays_visits_are_listed_and_yesterdays_are_not(
    clinic: Application, records: Records, qtbot: QtBot
) -> None:
    anna = records.persons.add(Person("Anna Berg"))
    today = date.today()
    records.visits.add(Visit(anna.id, today, reason="Heel pain"))
    records.visits.add(Visit(anna.id, today - timedelta(days=1), reason="Before"))
    page = page_of(clinic)
    qtbot.waitUntil(lambda: len(page.today.rows) == 1)
    assert page.today.rows[0].cells[:2] == ("Anna Berg", "Heel pain")


def test_two_visits_of_one_day_are_told_apart_by_when_they_were_begun(
    clinic: Application, records: Records, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    anna = records.persons.add(Person("Anna Berg"))
    today, before = date.today(), date.today() - timedelta(days=3)
    for day, hour in ((today, 9), (today, 14), (before, 9)):
        moment = datetime.combine(day, time(hour, 40)).astimezone()
        written = moment.astimezone(UTC).isoformat()
        monkeypatch.setattr("insole_core.records.visits.utc_now", lambda told=written: told)
        records.visits.add(Visit(anna.id, today, reason="Heel pain"))
    page = page_of(clinic)
    qtbot.waitUntil(lambda: len(page.today.rows) == 3)
    assert [row.cells[-1] for row in page.today.rows] == ["", "09:40", "14:40"]
    assert page.today.rows[0].tip == f"Begun {before.isoformat()} 09:40"


def test_no_new_patient_is_named_as_somebody_else_was_searched_for(
    clinic: Application, records: Records, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    def filled_in() -> tuple[str, bool]:
        clinic.controller.run_action("new_patient", False)
        dialog = dialog_of(clinic)
        filled = dialog.name.text(), dialog.focusWidget() is dialog.name
        dialog.reject()
        rest()
        return filled

    anna = records.persons.add(Person("Anna Berg"))
    page = page_of(clinic)
    QTest.keyClicks(page.search, "Bert")
    rest()
    assert filled_in() == ("Bert", False)
    page.search.clear()
    QTest.keyClicks(page.search, "ann")
    qtbot.waitUntil(lambda: len(page.found.rows) == 1)
    assert filled_in() == ("", True)
    page.search.setText("Bert")
    rest()
    clinic.features.records.show_person(anna.id)
    qtbot.waitUntil(lambda: not page.isVisible())
    assert page.search.text() == "Bert"
    assert filled_in() == ("", True)


def test_a_new_patient_is_added_with_the_birth_date_of_the_number(
    clinic: Application, records: Records, rest: Callable[[], None]
) -> None:
    page = page_of(clinic)
    QTest.keyClicks(page.search, "Anna Berg")
    clinic.controller.run_action("new_patient", False)
    dialog = dialog_of(clinic)
    assert dialog.name.text() == "Anna Berg"
    dialog.kind.show_value("se")
    fill(dialog, "Anna Berg", number="121212-1212")
    dialog.name.setFocus()
    dialog.consent.setChecked(True)
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    (found,) = records.persons.search("20121212-1212")
    person = records.persons.get(found.id)
    assert (person.name, person.birth_date) == ("Anna Berg", date(2012, 12, 12))
    assert person.consent_on == date.today()
    assert clinic.window.page is clinic.features.records.person
    assert clinic.settings.number_kind == "se"


REFUSED = (
    ("", "", "", "The name is missing; type one."),
    ("A" * 300, "", "", "The name has 201 characters, and may have 200; shorten it."),
    ("Anna", "1970-02-30", "", "1970-02-30 is no date"),
    ("Anna", "130228", "", "130228 can be 2013-02-28, 1913-02-28, 1928-02-13; write"),
    ("Anna", "", "19700228-1111", "The last digit of 19700228-1111 does not fit the others"),
)


def test_what_cannot_be_right_is_refused_in_the_dialog(
    clinic: Application, records: Records
) -> None:
    for name, born, number, sentence in REFUSED:
        clinic.controller.run_action("new_patient", False)
        dialog = dialog_of(clinic)
        dialog.kind.show_value("se")
        fill(dialog, name, born, number)
        QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
        assert dialog.isVisible()
        assert dialog.refusal.text().startswith(sentence)
        assert records.persons.recent() == []
        dialog.reject()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_a_birth_date_is_typed_as_in_a_personal_number(
    clinic: Application, records: Records, rest: Callable[[], None]
) -> None:
    clinic.controller.run_action("new_patient", False)
    dialog = dialog_of(clinic)
    fill(dialog, "Anna Berg", "700228")
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    (found,) = records.persons.recent()
    assert found.birth_date == date(1970, 2, 28)


def test_a_number_that_is_known_opens_its_patient(
    clinic: Application, records: Records, rest: Callable[[], None]
) -> None:
    anna = records.persons.add(Person("Anna Berg", personal_number="X-77"))
    clinic.controller.run_action("new_patient", False)
    dialog = dialog_of(clinic)
    fill(dialog, "A. Berg", number="X-77")
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    assert [person.id for person in records.persons.recent()] == [anna.id]
    page = clinic.features.records.person
    assert page is not None
    assert page._name.text() == "Anna Berg"


@pytest.mark.parametrize("answer", [Namesake.SAME, Namesake.ANOTHER, Namesake.CANCEL])
def test_of_a_namesake_born_on_the_same_day_one_question_is_asked(
    clinic: Application,
    records: Records,
    questions: CannedQuestions,
    rest: Callable[[], None],
    answer: Namesake,
) -> None:
    anna = records.persons.add(Person("Anna Bérg", date(1970, 2, 28)))
    records.persons.add(Person("Anna Berg", date(1971, 2, 28)))
    questions.namesake = answer
    clinic.controller.run_action("new_patient", False)
    dialog = dialog_of(clinic)
    fill(dialog, "BERG, anna", "1970-02-28", "X-77")
    dialog.consent.setChecked(True)
    QTest.mouseClick(dialog.add_button, Qt.MouseButton.LeftButton)
    rest()
    assert questions.asked == [f"Anna Bérg, 1970-02-28 ({anna.pseudonym})"]
    added = records.persons.with_number("X-77")
    assert len(added) == (answer is Namesake.ANOTHER)
    shown = {Namesake.SAME: "Anna Bérg", Namesake.ANOTHER: "BERG, anna"}.get(answer)
    page = clinic.features.records.person
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    forms = clinic.window.findChildren(NewPatientDialog)
    if shown is None:
        assert clinic.window.page is page_of(clinic)
        (form,) = forms  # with all that was typed: it may be a name or a day that was mistyped
        assert form.isVisible()
        assert (form.name.text(), form.born.text()) == ("BERG, anna", "1970-02-28")
        assert (form.number.text(), form.consent.isChecked()) == ("X-77", True)
        assert form.kind.currentData() == ""
        form.reject()
    else:
        assert forms == []
        assert page is not None
        assert (clinic.window.page is page, page._name.text()) == (True, shown)


def test_a_new_patient_whom_the_record_did_not_take_is_still_in_the_form(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(_person: Person) -> NoReturn:
        raise RecordsError("The disk is full; make room on it.")

    monkeypatch.setattr(records.persons, "add", refuse)
    clinic.controller.run_action("new_patient", False)
    fill(dialog_of(clinic), "Anna Berg", "1970-02-28", "X-77")
    QTest.mouseClick(dialog_of(clinic).add_button, Qt.MouseButton.LeftButton)
    rest()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    form = dialog_of(clinic)
    (told,) = clinic.services.messages.dialogs
    assert (told.text(), told.parent()) == ("The disk is full; make room on it.", form)
    told.accept()
    typed = form.name.text(), form.born.text(), form.number.text()
    assert typed == ("Anna Berg", "1970-02-28", "X-77")
    monkeypatch.undo()
    QTest.mouseClick(form.add_button, Qt.MouseButton.LeftButton)
    rest()
    assert [person.name for person in records.persons.recent()] == ["Anna Berg"]


def test_a_namesake_is_named_by_the_number_and_one_without_birth_date_is_asked_of_too(
    clinic: Application,
    records: Records,
    questions: CannedQuestions,
    rest: Callable[[], None],
) -> None:
    records.persons.add(Person("Anna Berg", personal_number="X-77"))
    records.persons.add(Person("Bo Dal", date(1970, 2, 28)))
    for name in ("Anna Berg", "Bo Dal"):
        clinic.controller.run_action("new_patient", False)
        fill(dialog_of(clinic), name)
        QTest.mouseClick(dialog_of(clinic).add_button, Qt.MouseButton.LeftButton)
        rest()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert questions.asked == ["Anna Berg (X-77)"]


def test_a_new_case_brings_the_panels_and_f3_the_patients_again(clinic: Application) -> None:
    clinic.controller.run_action("new_case", False)
    assert clinic.window.page is None
    assert clinic.stage.patient.isVisible()
    clinic.controller.run_action("patients", False)
    assert clinic.window.page is page_of(clinic)
    assert not clinic.stage.foot.isVisible()


def test_the_tour_is_offered_until_it_is_not_wanted(clinic: Application, qtbot: QtBot) -> None:
    def offers() -> list[QPushButton]:
        buttons = clinic.stage.notices.findChildren(QPushButton)
        return [button for button in buttons if button.isVisible()]

    clinic.main.help.offer_tour()
    qtbot.waitUntil(lambda: len(offers()) == 2)
    assert clinic.window.findChildren(Tour) == []
    take, not_now = offers()
    assert take.text() == "Take the tour"
    QTest.mouseClick(not_now, Qt.MouseButton.LeftButton)
    assert clinic.settings.tour_seen
    clinic.main.help.offer_tour()
    assert offers() == []


def test_the_first_page_offers_what_a_new_user_needs(clinic: Application) -> None:
    page = page_of(clinic)
    asked: list[str] = []
    page.action_requested.disconnect()
    page.action_requested.connect(asked.append)
    needed = ["open_example", "calibrate", "restore_record"]
    for action in needed:
        buttons = [b for b in page.findChildren(QPushButton) if b.property("action") == action]
        (shown,) = [button for button in buttons if button.isVisible()]
        shown.click()
    assert asked == needed


def test_further_patients_are_a_click_away(
    clinic: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    many = [Person(f"Eva {number:02}") for number in range(MOST_FOUND + 10)]
    with records.context.writing(Right.WRITE) as connection:
        add_persons(records.context, connection, many)
    page = page_of(clinic)
    QTest.keyClicks(page.search, "eva")
    qtbot.waitUntil(lambda: len(page.found.rows) == MOST_FOUND)
    assert page.more.isVisible()
    QTest.mouseClick(page.more, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: len(page.found.rows) == MOST_FOUND + 10)
    assert not page.more.isVisible()


def test_a_thousand_patients_are_sorted_where_they_are_and_loaded_as_one_scrolls(
    clinic: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    born = date(1950, 1, 1)
    many = [Person(f"P{n:05}", born + timedelta(days=7 * n % 997)) for n in range(1000)]
    with records.context.writing(Right.WRITE) as connection:
        add_persons(records.context, connection, many)
    oldest = records.visits.add(Visit(many[432].id, date.today() - timedelta(days=400)))
    records.visits.add(Visit(many[17].id, date.today()))
    page = page_of(clinic)
    rest()

    def click(column: int) -> None:
        click_heading(page.found, column)
        rest()

    click(3)
    assert [row.cells[0] for row in page.found.rows[:3]] == ["P00432", "P00017", "P00000"]
    assert page.found.rows[0].cells[3] == oldest.visited_on.isoformat()
    click(1)
    days = [row.cells[1] for row in page.found.rows]
    assert len(days) == MOST_FOUND
    assert days == sorted(days)
    assert days[0] == "1950-01-01"
    bar = page.found.verticalScrollBar()
    bar.setValue(bar.maximum())
    rest()
    assert len(page.found.rows) == 2 * MOST_FOUND
    click(1)
    assert (
        page.found.rows[0].cells[1] == max(p.birth_date for p in many if p.birth_date).isoformat()
    )
    QTest.keyClicks(page.search, "p0004")
    rest()
    assert [row.cells[0][:5] for row in page.found.rows] == ["P0004"] * 10
