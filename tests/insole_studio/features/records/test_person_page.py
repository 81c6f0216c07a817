"""A person's page: fields, time line, pictures, versions, orders, follow-up."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, date, datetime, time, timedelta
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QPushButton
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError, RecordsError, Unreachable
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift
from insole_core.records.capture import CaptureFacts
from insole_core.records.captures import MESH
from insole_core.records.person import Person
from insole_core.records.prescription import Base
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.record_field import FieldChoice, Line
from insole_core.records.records import Records
from insole_core.records.visit import CaptureState, Visit
from insole_core.workflows.starting_design import mirrored_foot, starting_device
from insole_studio.app.bootstrap import Application
from insole_studio.app.main_controller import SCANNING
from insole_studio.features.records.person_page import PERSON, PersonPage
from insole_studio.features.records.person_presenter import trends_of
from insole_studio.features.records.record_dialogs import FollowUpDialog, VisitDialog
from insole_studio.features.records.record_transfer import PersonExportDialog
from insole_studio.features.records.version_dialogs import FieldConflictDialog, HistoryDialog
from insole_studio.services.person_list import visit_time_text
from insole_studio.texts import moment_text
from insole_studio.widgets.notice_bar import Notice
from insole_studio.widgets.side_switch import SideBadge

pytestmark = pytest.mark.one_window

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def page(clinic: Application, visit: Visit, rest: Callable[[], None], qtbot: QtBot) -> PersonPage:
    """The page of Anna Berg, who has one visit."""
    clinic.features.records.show_person(visit.person_id)
    rest()
    shown = clinic.features.records.person
    assert shown is not None
    qtbot.waitUntil(lambda: list(shown.cards) == [visit.id])
    return shown


def type_in(page: PersonPage, key: str, text: str) -> QLineEdit:
    field = page._fields[key]
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return field


def press(page: PersonPage, visit: Visit, key: str) -> None:
    buttons = page.cards[visit.id].findChildren(QPushButton)
    QTest.mouseClick(next(b for b in buttons if b.property("action") == key), LEFT)


def test_every_field_is_in_the_form_stored_at_once_and_undone(
    clinic: Application,
    page: PersonPage,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
) -> None:
    type_in(page, "birth_date", "1971-3-1")
    type_in(page, "contact", "070-123")
    rest()
    person = records.persons.get(visit.person_id)
    assert (person.birth_date, person.contact) == (date(1971, 3, 1), "070-123")
    clinic.controller.run_action("undo", False)
    clinic.controller.run_action("undo", False)
    rest()
    person = records.persons.get(visit.person_id)
    assert (person.birth_date, person.contact) == (date(1970, 2, 28), "")
    clinic.controller.run_action("redo", False)
    rest()
    assert records.persons.get(visit.person_id).birth_date == date(1971, 3, 1)

    labels = {label.text() for label in page.findChildren(QLabel)}
    assert {field.label for field in PERSON.values() if field.is_told} - labels == set()
    assert page._fields.keys() == PERSON.keys() - {"pseudonym"}
    lines = {k for k, f in PERSON.items() if isinstance(f, Line) and not f.is_needed}
    for key in lines:
        type_in(page, key, f"new {key}")
    rest()
    stored = records.persons.get(visit.person_id)
    assert {key: getattr(stored, key) for key in lines} == {key: f"new {key}" for key in lines}


def test_a_visit_says_when_it_was_captured_and_the_sensors_calibrated(
    page: PersonPage,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
    tmp_path: Path,
) -> None:
    path = tmp_path / "scan.stl"
    told = CaptureFacts(
        "2026-11-20T10:00:00Z", ("<i>A1",), "2026-10-01T08:00:00Z", {"<i>A1: camera, px": 0.312}
    )
    for facts in (CaptureFacts(sensor_serials=("A1",)), told):
        path.write_bytes(f"solid {facts.recorded_at}".encode())  # one scan is stored once
        records.captures.add(visit.id, MESH, path, facts)
    qtbot.waitUntil(lambda: "calibrated 2026-10-01" in page.cards[visit.id].scan.text())
    rest()
    label = page.cards[visit.id].scan
    assert label.text().splitlines()[1].endswith("calibration of the sensors not recorded")
    assert label.toolTip() == "&lt;i&gt;A1: camera 0.31 px"


def test_a_visit_says_of_which_foot_a_capture_is_once_one_is_made_of_it(
    page: PersonPage,
    records: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
    tmp_path: Path,
) -> None:
    def capture(hour: int) -> str:
        path = tmp_path / f"{hour}.stl"
        path.write_bytes(f"solid {hour}".encode())
        facts = CaptureFacts(f"2026-11-20T{hour}:40:00Z", ("A1",), "2026-10-01T08:00:00Z")
        return records.captures.add(visit.id, MESH, path, facts).source_sha256

    right, _not_made_yet = ScanSource("mesh", "10.stl", capture(10)), capture(11)
    records.prescriptions.save(visit.id, FootRecord.begun(make_foot(Side.RIGHT), right), None)
    times = [moment_text(f"2026-11-20T{hour}:40:00Z") for hour in (11, 10)]
    qtbot.waitUntil(lambda: "foot" in page.cards[visit.id].scan.text())
    assert page.cards[visit.id].scan.text().splitlines() == [
        f"Captured {times[0]}; sensors calibrated 2026-10-01",
        f"Captured {times[1]}, right foot; sensors calibrated 2026-10-01",
    ]


@pytest.fixture
def changed_elsewhere(
    page: PersonPage, other_station: Records, visit: Visit, clinic: Application
) -> Person:
    """The person of the page, after somebody else has changed their contact and number."""
    clinic.services.clinic._watch.stop()  # as if that were known a moment later
    person = other_station.persons.get(visit.person_id)
    theirs = replace(person, contact="08-999", personal_number="K 1")
    return other_station.persons.change(theirs, person.revision)


def field_dialog(clinic: Application, qtbot: QtBot) -> FieldConflictDialog:
    def shown() -> list[FieldConflictDialog]:
        dialogs = clinic.window.findChildren(FieldConflictDialog)
        return [dialog for dialog in dialogs if dialog.isVisible()]

    qtbot.waitUntil(lambda: bool(shown()))
    return shown()[0]


@pytest.mark.parametrize(
    ("choice", "contact"),
    [
        (FieldChoice.MINE, "070-123"),
        (FieldChoice.THEIRS, "08-999"),
        (FieldChoice.BOTH, "08-999\n070-123"),
    ],
)
def test_both_values_of_a_field_are_shown_to_who_saves_second(
    clinic: Application,
    page: PersonPage,
    records: Records,
    changed_elsewhere: Person,
    rest: Callable[[], None],
    qtbot: QtBot,
    choice: FieldChoice,
    contact: str,
) -> None:
    type_in(page, "birth_date", "1971-3-1")
    type_in(page, "contact", "070-123")
    dialog = field_dialog(clinic, qtbot)
    texts = [label.text() for label in dialog.findChildren(QLabel)]
    assert {"070-123", "08-999"} <= set(texts)
    dialog.choice_buttons["contact", choice].click()
    QTest.mouseClick(dialog.store, LEFT)
    rest()
    person = records.persons.get(changed_elsewhere.id)
    assert person.contact == contact
    assert (person.birth_date, person.personal_number) == (date(1971, 3, 1), "K 1")
    if choice is not FieldChoice.MINE:
        clinic.controller.run_action("undo", False)
        rest()
        assert records.persons.get(person.id).contact == "070-123"


def test_fields_that_do_not_collide_are_put_together_without_a_word(
    clinic: Application,
    page: PersonPage,
    records: Records,
    changed_elsewhere: Person,
    rest: Callable[[], None],
) -> None:
    type_in(page, "birth_date", "1971-3-1")
    rest()
    person = records.persons.get(changed_elsewhere.id)
    assert (person.birth_date, person.contact) == (date(1971, 3, 1), "08-999")
    assert clinic.window.findChildren(FieldConflictDialog) == []


def test_both_values_of_a_visit_are_shown_to_who_saves_second(
    clinic: Application,
    page: PersonPage,
    records: Records,
    other_station: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    press(page, visit, "edit")
    (form,) = clinic.window.findChildren(VisitDialog)
    stored = other_station.visits.get(visit.id)
    theirs = replace(stored, findings="Flat foot", weight_kg=70.0)
    other_station.visits.change(theirs, stored.revision)
    form.editors["findings"].setPlainText("Tight calf")
    form.editors["shoe_size_eu"].setText("41")
    QTest.mouseClick(form.keep, LEFT)
    dialog = field_dialog(clinic, qtbot)
    QTest.mouseClick(dialog.store, LEFT)
    rest()
    found = records.visits.get(visit.id)
    assert found.findings == "Flat foot\nTight calf"
    assert (found.weight_kg, found.shoe_size_eu) == (70.0, 41.0)


def test_what_cannot_be_right_is_refused_beside_the_field_until_the_page_is_left(
    clinic: Application, page: PersonPage, records: Records, visit: Visit
) -> None:
    for key, text, sentence in (
        ("birth_date", "1970-02-30", "1970-02-30 is no date"),
        ("name", " ", "The name is missing"),
        ("name", "A" * 201, "The name has 201 characters"),
    ):
        before = page._fields[key].text()
        field = type_in(page, key, text)
        assert page._refusals[key].text().startswith(sentence)
        assert field.text() == before
        assert records.persons.get(visit.person_id).revision == 1
    assert page._refusals["name"].isVisible()
    clinic.features.records.show_start()
    assert not any(refusal.isVisible() for refusal in page._refusals.values())


def test_fields_that_two_change_at_once_are_both_kept(
    page: PersonPage,
    records: Records,
    other_station: Records,
    visit: Visit,
    rest: Callable[[], None],
) -> None:
    person = other_station.persons.get(visit.person_id)
    other_station.persons.change(replace(person, notes="Allergic to nickel"), person.revision)
    type_in(page, "contact", "070-123")
    rest()
    stored = records.persons.get(visit.person_id)
    assert (stored.contact, stored.notes) == ("070-123", "Allergic to nickel")


@pytest.mark.drawn
def test_a_visit_shows_pictures_of_foot_and_insole(
    page: PersonPage, visit: Visit, qtbot: QtBot
) -> None:
    labels = page.cards[visit.id]._pictures
    assert [(key.side, key.kind) for key in labels] == [(Side.LEFT, "foot"), (Side.LEFT, "insole")]
    qtbot.waitUntil(lambda: all(not label.pixmap().isNull() for label in labels.values()))


@pytest.mark.drawn
def test_an_insole_that_cannot_be_built_leaves_no_empty_picture(
    clinic: Application,
    records: Records,
    visit: Visit,
    qtbot: QtBot,
    qtlog: Any,
) -> None:
    opened = records.visits.open_case(visit.id)
    foot = opened.record.feet[0]
    lifts = tuple(HeelLift(height_mm=20.0) for _ in range(5))
    prescribed = replace(foot.design, corrections=lifts)
    records.prescriptions.save(visit.id, foot.with_design(prescribed), opened.bases[Side.LEFT])
    clinic.features.records.show_person(visit.person_id)
    shown = clinic.features.records.person
    assert shown is not None
    qtbot.waitUntil(lambda: list(shown.cards) == [visit.id])
    labels = {key.kind: label for key, label in shown.cards[visit.id]._pictures.items()}
    qtbot.waitUntil(lambda: not labels["foot"].pixmap().isNull())
    assert labels["foot"].isVisible()
    assert not labels["insole"].isVisible()
    assert not [told for told in qtlog.records if "null pixmap" in told.message]


@pytest.mark.drawn
@pytest.mark.parametrize(
    ("error", "is_place_kept"),
    [
        (Unreachable("The database does not answer."), True),
        (RecordsError("The version is damaged."), False),
    ],
)
def test_pictures_keep_their_places_while_the_database_does_not_answer(
    clinic: Application,
    visit: Visit,
    error: RecordsError,
    is_place_kept: bool,
    monkeypatch: pytest.MonkeyPatch,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    """They are made later; what cannot be read has none."""

    def fail(*_given: object) -> None:
        raise error

    with monkeypatch.context() as away:
        away.setattr(Prescriptions, "read", fail)
        clinic.features.records.show_person(visit.person_id)
        shown = clinic.features.records.person
        assert shown is not None
        qtbot.waitUntil(lambda: list(shown.cards) == [visit.id])
        rest()
        labels = shown.cards[visit.id]._pictures.values()
        assert [label.isVisible() for label in labels] == 2 * [is_place_kept]
        assert all(label.pixmap().isNull() for label in labels)
    if is_place_kept:  # they come once the database answers again; nothing is read anew
        qtbot.waitUntil(lambda: clinic.services.clinic.is_open)
        qtbot.waitUntil(lambda: all(not label.pixmap().isNull() for label in labels))


def test_a_visit_is_opened_from_its_card(
    clinic: Application, page: PersonPage, visit: Visit, qtbot: QtBot
) -> None:
    press(page, visit, "open")
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    assert clinic.window.page is None
    clinic.stage.steps.chosen.emit("patient")
    assert clinic.window.page is page


def test_the_fields_of_a_visit_are_edited(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
) -> None:
    press(page, visit, "edit")
    (dialog,) = clinic.window.findChildren(VisitDialog)
    dialog.editors["weight_kg"].setText("abc")
    QTest.mouseClick(dialog.keep, LEFT)
    assert dialog.refusal.text() == "Abc is no number; write it such as 72.5."
    dialog.editors["weight_kg"].setText("72,5")
    dialog.capture.setChecked(True)
    QTest.mouseClick(dialog.keep, LEFT)
    rest()
    stored = records.visits.get(visit.id)
    assert stored.weight_kg == 72.5
    assert stored.capture_state is CaptureState.WANTED


FULL = "The disk is full; make room on it."


def refuse(*_given: object) -> NoReturn:
    raise RecordsError(FULL)


def test_the_fields_of_a_visit_that_were_not_stored_are_still_in_the_form(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    monkeypatch: pytest.MonkeyPatch,
    rest: Callable[[], None],
) -> None:
    press(page, visit, "edit")
    (dialog,) = clinic.window.findChildren(VisitDialog)
    dialog.editors["weight_kg"].setText("72,5")
    dialog.capture.setChecked(True)
    with monkeypatch.context() as full:
        full.setattr(records.visits, "change", refuse)
        QTest.mouseClick(dialog.keep, LEFT)
        rest()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    (dialog,) = clinic.window.findChildren(VisitDialog)
    (told,) = clinic.services.messages.dialogs
    assert (told.text(), told.parent()) == (FULL, dialog)
    told.accept()
    assert dialog.editors["weight_kg"].text() == "72.5"
    QTest.mouseClick(dialog.keep, LEFT)
    rest()
    stored = records.visits.get(visit.id)
    assert (stored.weight_kg, stored.capture_state) == (72.5, CaptureState.WANTED)


def test_a_follow_up_that_was_not_stored_is_still_in_the_form(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    monkeypatch: pytest.MonkeyPatch,
    rest: Callable[[], None],
) -> None:
    clinic.controller.run_action("follow_up", False)
    rest()
    (dialog,) = clinic.window.findChildren(FollowUpDialog)
    QTest.keyClicks(dialog.outcome, "Better")
    dialog.notes.setPlainText("Walks to work again")
    with monkeypatch.context() as full:
        full.setattr(records.follow_ups, "add", refuse)
        QTest.mouseClick(dialog.add, LEFT)
        rest()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    (dialog,) = clinic.window.findChildren(FollowUpDialog)
    (told,) = clinic.services.messages.dialogs
    assert (told.text(), told.parent()) == (FULL, dialog)
    told.accept()
    QTest.mouseClick(dialog.add, LEFT)
    rest()
    (added,) = records.follow_ups.of_person(visit.person_id)
    assert (added.outcome, added.notes) == ("Better", "Walks to work again")


def test_versions_say_what_they_changed_and_are_signed(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
) -> None:
    opened = records.visits.open_case(visit.id)
    foot = opened.record.feet[0]
    thicker = foot.with_design(replace(foot.design, thickness_mm=5.0))
    records.prescriptions.save(visit.id, thicker, opened.bases[Side.LEFT], "For work shoes")
    press(page, visit, "versions")
    rest()
    (dialog,) = clinic.window.findChildren(HistoryDialog)
    rest()
    assert [row.cells[1] for row in dialog.table.rows] == ["2", "1"]
    assert dialog.table.rows[0].cells[4] == "For work shoes"
    assert dialog.changes.text() == "Thickness: 3 mm → 5 mm"
    QTest.mouseClick(dialog.sign, LEFT)
    rest()
    newest = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    assert newest.signed_by == records.who.name
    press(page, visit, "versions")
    rest()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    (dialog,) = clinic.window.findChildren(HistoryDialog)
    assert not dialog.sign.isEnabled()
    assert dialog.sign.toolTip() == "This version is signed already."


@pytest.mark.parametrize(
    ("heights_mm", "words"), [([6.0], "heel lift, 6 mm"), ([], "no corrections")]
)
def test_a_new_visit_with_the_same_prescription_fits_it_to_the_new_scan(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
    heights_mm: list[float],
    words: str,
) -> None:
    opened = records.visits.open_case(visit.id)
    foot = opened.record.feet[0]
    lifts = tuple(HeelLift(height_mm=height_mm) for height_mm in heights_mm)
    prescribed = replace(foot.design, corrections=lifts, thickness_mm=3.7)
    records.prescriptions.save(visit.id, foot.with_design(prescribed), opened.bases[Side.LEFT])
    clinic.controller.run_action("new_visit_same", False)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    assert clinic.services.keeper.visit_id != visit.id

    def notices() -> dict[str, Notice]:
        return {shown.key: shown for shown in clinic.services.notices.notices}

    qtbot.waitUntil(lambda: notices().keys() == {"same-prescription", "earlier-scan"})
    notice = notices()["same-prescription"]
    assert "as last time: left:" in notice.text
    assert words in notice.text
    source = ScanSource("mesh", "/nowhere/new.ply", "1" * 64)
    clinic.case.open_foot(make_foot(Side.LEFT), source)
    design = clinic.case.record.design
    assert design is not None
    assert design.thickness_mm == 3.7
    lifts = [lift for lift in design.corrections if isinstance(lift, HeelLift)]
    assert [lift.height_mm for lift in lifts] == heights_mm
    assert len(design.corrections) == len(lifts)
    assert clinic.services.notices.notices == []
    qtbot.waitUntil(
        lambda: bool(records.prescriptions.versions(clinic.services.keeper.visit_id, Side.LEFT))
    )


def test_what_adds_to_a_patient_says_why_it_is_grey_while_the_record_is_away(
    clinic: Application, page: PersonPage, qtbot: QtBot
) -> None:
    keys = ("new_visit", "follow_up")
    parts = [page._buttons[key] for key in keys]
    actions = [clinic.window.actions_by_key[key] for key in keys]
    told = "Nothing can be changed in the record at the moment."
    clinic.services.clinic.note_failure(Unreachable("The database does not answer."))
    assert not any(part.isEnabled() for part in (*parts, *actions))
    assert {part.toolTip() for part in (*parts, *actions)} == {told}
    assert {part.accessibleDescription() for part in parts} == {told}
    assert {action.statusTip() for action in actions} == {told}
    assert page._buttons["person_orders"].isEnabled()
    qtbot.waitUntil(parts[0].isEnabled)
    assert all(part.isEnabled() for part in (*parts, *actions))
    assert told not in {part.toolTip() for part in (*parts, *actions)}


def test_the_same_prescription_is_offered_where_there_is_one(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    action = clinic.window.actions_by_key["new_visit_same"]
    button = page._buttons["new_visit_same"]

    def said() -> set[str]:
        assert action.isEnabled() == button.isEnabled()
        return {action.statusTip(), button.toolTip(), button.accessibleDescription()}

    why_not = {"Nothing was prescribed on an earlier visit."}
    rest()
    assert not button.isEnabled()  # its insole is as a new one begins
    assert said() == why_not
    opened = records.visits.open_case(visit.id)
    foot = opened.record.feet[0]
    lifted = foot.with_design(foot.design.with_added(HeelLift(height_mm=6.0)))
    records.prescriptions.save(visit.id, lifted, opened.bases[Side.LEFT])
    qtbot.waitUntil(button.isEnabled)
    assert said().isdisjoint(why_not)
    record = clinic.services.clinic
    record.note_failure(Unreachable("The database does not answer."))
    assert not button.isEnabled()
    assert said() == {"Nothing can be changed in the record at the moment."}
    qtbot.waitUntil(button.isEnabled)
    assert said().isdisjoint(why_not)
    other = records.persons.add(Person("Bo Dal"))
    clinic.features.records.show_person(other.id)
    assert not action.isEnabled()
    rest()
    assert not button.isEnabled()
    assert said() == why_not
    clinic.controller.run_action("patients", False)
    assert "to be prescribed as the last one" in action.statusTip()


def test_nothing_is_scanned_on_the_page_of_a_person_without_a_visit(
    page: PersonPage, clinic: Application, visit: Visit, rest: Callable[[], None], qtbot: QtBot
) -> None:
    """The foot would be nobody's."""
    rest()
    assert clinic.window.page is page
    actions = [clinic.window.actions_by_key[key] for key in SCANNING]
    assert not any(action.isEnabled() for action in actions)
    new_visit = clinic.window.actions_by_key["new_visit"]
    assert new_visit.isEnabled()
    clinic.controller.run_action("patients", False)
    assert not new_visit.isEnabled()  # it needs their page
    clinic.features.records.show_person(visit.person_id)
    rest()
    clinic.controller.run_action("new_visit", False)
    qtbot.waitUntil(lambda: clinic.window.page is None)
    assert all(action.isEnabled() for action in actions)


def test_undo_and_redo_are_offered_where_an_edit_of_the_page_is_there_to_be(
    clinic: Application,
    page: PersonPage,
    records: Records,
    rest: Callable[[], None],
) -> None:
    undo, redo = (clinic.window.actions_by_key[key] for key in ("undo", "redo"))

    def offered() -> tuple[bool, bool]:
        return undo.isEnabled(), redo.isEnabled()

    assert offered() == (False, False)
    type_in(page, "contact", "070-123")
    assert offered() == (True, False)
    assert undo.text() == "Undo: Edit the patient's fields"
    rest()
    undo.trigger()
    assert offered() == (False, True)
    rest()
    redo.trigger()
    rest()
    assert offered() == (True, False)
    other = records.persons.add(Person("Bo Dal"))
    clinic.features.records.show_person(other.id)
    rest()
    assert offered() == (False, False)
    clinic.controller.run_action("patients", False)
    assert offered() == (False, False)


@pytest.mark.parametrize("action", ["new_visit", "new_visit_same"])
def test_a_visit_without_a_scan_takes_the_last_one_and_says_its_day(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
    action: str,
) -> None:
    opened = records.visits.open_case(visit.id)
    foot = opened.record.feet[0]
    lifted = foot.with_design(foot.design.with_added(HeelLift(height_mm=6.0)))
    records.prescriptions.save(visit.id, lifted, opened.bases[Side.LEFT])
    before = date.today() - timedelta(days=200)
    records.visits.change(replace(visit, visited_on=before), visit.revision)
    rest()
    clinic.controller.run_action(action, False)
    notices = clinic.services.notices
    qtbot.waitUntil(lambda: "earlier-scan" in [shown.key for shown in notices.notices])
    (button,) = [
        button
        for button in clinic.window.findChildren(QPushButton)
        if button.text() == f"Use the scan of {before.isoformat()}"
    ]
    QTest.mouseClick(button, LEFT)
    qtbot.waitUntil(lambda: bool(clinic.case.record.feet))
    (taken,) = clinic.case.record.feet
    assert np.array_equal(taken.foot.mesh.vertices, foot.foot.mesh.vertices)
    assert taken.source.scanned_on == taken.foot.scanned_on == before.isoformat()
    assert bool(taken.design.corrections) == (action == "new_visit_same")
    assert taken.earlier is not None
    starting = starting_device(clinic.services.paths.settings_folder).design(taken.foot)
    assert (taken.design.device == starting.device) == (action != "new_visit_same")
    badges = [badge.text() for badge in clinic.window.findChildren(SideBadge)]
    assert f"LEFT · scan of {before.isoformat()}" in badges
    now = clinic.services.keeper.visit_id
    qtbot.waitUntil(lambda: bool(records.prescriptions.versions(now, Side.LEFT)))
    rest()
    (version,) = records.prescriptions.newest(now)
    assert (version.summary.side, version.source.scanned_on) == (Side.LEFT, before.isoformat())
    assert records.visits.get(now).measures == {}
    clinic.features.records.show_person(visit.person_id)
    told = f"Scan of the visit of {before.isoformat()}, used once more"
    qtbot.waitUntil(lambda: now in page.cards and told in page.cards[now].row.scan)
    third = records.visits.add(Visit(visit.person_id, date.today()))
    (again,) = records.prescriptions.last_scanned(third.person_id)
    assert again.scanned_on == before


@pytest.mark.parametrize("days", [365, 0])
def test_two_visits_are_compared(
    days: int,
    monkeypatch: pytest.MonkeyPatch,
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> None:
    day = date.today() - timedelta(days=days)
    begun = datetime.combine(day, time(0, 0)).astimezone(UTC).isoformat()
    monkeypatch.setattr("insole_core.records.visits.utc_now", lambda: begun)
    earlier = records.visits.add(Visit(visit.person_id, day))
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    records.prescriptions.save(earlier.id, FootRecord.begun(make_foot(Side.LEFT), source), None)
    qtbot.waitUntil(lambda: len(page.cards) == 2)
    for card in page.cards.values():
        qtbot.waitUntil(card.compare.isEnabled)
        assert page._compare.toolTip() == "Choose two visits to compare them"
        card.compare.click()
    assert page._compare.toolTip() == ""
    QTest.mouseClick(page._compare, LEFT)
    compare = clinic.features.compare
    qtbot.waitUntil(lambda: compare.stage is not None)
    assert compare.stage is not None
    texts = [compare.stage.view.sources[key].currentText() for key in ("a", "b")]
    newer = visit_time_text(records.visits.get(visit.id))
    assert texts == [f"{newer}: Left foot", f"{day.isoformat()} 00:00: Left foot"]
    qtbot.waitUntil(lambda: not compare.stage.jobs.is_running())
    compare.close()


def test_measures_over_time_are_plotted(
    page: PersonPage, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    for days, length_mm in ((365, 250.0), (30, 252.0)):
        day = date.today() - timedelta(days=days)
        measures = {
            "left_foot_length_mm": length_mm,
            "left_foot_length_mm_limits_95_by_repeat_test": 1.2,
            "right_foot_length_mm": length_mm / 2 + 125,
            "right_foot_length_mm_limits_95_by_simulation": 1.5,
            "left_heel_width_mm": length_mm - 170,  # as of before the ± were stored
        }
        records.visits.add(Visit(visit.person_id, day, measures=measures))
    qtbot.waitUntil(page.chart.isVisible)
    assert page.chart.measures.currentText() == "Foot length (mm)"
    said = page.chart.plot.accessibleDescription()
    changes = ["LEFT +2.0 ± 1.7", "RIGHT +1.0 ± 2.1: within the error"]
    assert said == f"LEFT 250.0 → 252.0, {changes[0]}; RIGHT 250.0 → 251.0, {changes[1]}"
    shown = [label.text() for label in page.chart.changes.values() if label.isVisible()]
    assert shown == changes
    page.chart.measures.setCurrentText("Heel width (mm)")
    assert page.chart.plot.accessibleDescription() == "LEFT 80.0 → 82.0, LEFT +2.0"


def test_a_follow_up_is_added(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
) -> None:
    clinic.controller.run_action("follow_up", False)
    rest()
    (dialog,) = clinic.window.findChildren(FollowUpDialog)
    assert not dialog.add.isEnabled()
    assert dialog.add.accessibleDescription() == "Type the outcome first."
    dialog.outcome.insert("x" * 250)
    QTest.mouseClick(dialog.add, LEFT)
    assert dialog.isVisible()
    assert "200" in dialog.refusal.text()
    dialog.outcome.selectAll()
    QTest.keyClicks(dialog.outcome, "Better")
    QTest.mouseClick(dialog.add, LEFT)
    rest()
    (added,) = records.follow_ups.of_person(visit.person_id)
    assert added.outcome == "Better"


def test_the_days_until_a_new_order_is_due_are_set_by_the_clinic(
    page: PersonPage,
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    clinic.controller.run_action("orders", False)
    rest()
    orders = clinic.features.records.orders
    assert orders is not None
    assert orders.days.value() == 14
    orders.days.setFocus()
    orders.days.selectAll()
    QTest.keyClicks(orders.days, "7")
    QTest.keyClick(orders.days, Qt.Key.Key_Return)
    rest()
    qtbot.waitUntil(lambda: records.orders.days_until_due() == 7)
    assert records.orders.usual_due_on(date(2026, 12, 28)) == date(2027, 1, 4)
    records.orders.set_days_until_due(0)
    assert records.orders.usual_due_on(date.today()) is None
    with pytest.raises(InputError, match="between 0 and 365"):
        records.orders.set_days_until_due(-1)


def test_export_is_of_the_patient_on_the_page_or_in_the_open_visit(
    page: PersonPage,
    clinic: Application,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    def name_asked() -> str:
        (dialog,) = (d for d in clinic.window.findChildren(PersonExportDialog) if d.isVisible())
        dialog.reject()
        return " ".join(label.text() for label in dialog.findChildren(QLabel))

    button = next(b for b in page.findChildren(QPushButton) if b.text() == "Export…")
    QTest.mouseClick(button, LEFT)
    assert "Anna Berg" in name_asked()
    other = records.persons.add(Person("Per Ek"))
    clinic.features.records.show_person(other.id)
    rest()
    clinic.features.records.open_visit(visit.id)  # as from the lists of the start page
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    clinic.controller.run_action("export_patient", False)
    assert "Anna Berg" in name_asked()


def test_an_empty_visit_is_deleted_and_one_with_contents_is_kept(
    clinic: Application,
    page: PersonPage,
    records: Records,
    visit: Visit,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    clinic.controller.run_action("new_visit", False)
    clinic.controller.run_action(
        "new_visit", False
    )  # as by a key that is held: one visit all the same
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    assert clinic.case.kept is not None
    empty = clinic.case.kept.visit
    clinic.controller._go_to_step("patient")
    qtbot.waitUntil(lambda: set(page.cards) == {visit.id, empty.id})
    press(page, visit, "delete")
    qtbot.waitUntil(lambda: bool(clinic.services.messages.dialogs))
    assert "versions of prescriptions (1)" in clinic.services.messages.dialogs[0].text()
    press(page, empty, "delete")  # although it is open in this window
    qtbot.waitUntil(lambda: list(page.cards) == [visit.id])
    rest()
    assert clinic.window.page is page
    assert clinic.case.kept is None
    assert records.visits.of_person(visit.person_id) == [visit]


def test_a_visit_can_be_added_after_the_record_was_opened_again(
    clinic: Application, page: PersonPage, qtbot: QtBot
) -> None:
    clinic.controller.run_action("new_visit", False)
    clinic.services.clinic.reopen()  # before the answer arrives
    qtbot.waitUntil(lambda: clinic.services.clinic.is_open)
    clinic.controller.run_action("new_visit", False)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)


def test_a_card_tells_what_was_prescribed_measured_ordered_and_not_scanned(
    page: PersonPage, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    (version,) = records.prescriptions.versions(visit.id, Side.LEFT)
    foot = records.prescriptions.read(version.id)
    lift = replace(foot.design, device="Running", corrections=(HeelLift(height_mm=6.0),))
    base = Base(version.id, version.revision)
    records.prescriptions.save(visit.id, foot.with_design(lift), base)
    newest = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    records.orders.add(visit.id, [newest.id], number="A 7", due_on=date.today())
    told = replace(visit, weight_kg=72.5, shoe_size_eu=42.0, findings="Flat foot")
    records.visits.change(told, visit.revision)
    day = date.today().isoformat()
    lines = [
        "Weight (kg): 72.5, Shoe size EU: 42",
        "Findings: Flat foot",
        f"Order A 7, Designed, due {day}",
    ]

    def labels() -> list[str]:
        return [label.text() for label in page.cards[visit.id].findChildren(QLabel)]

    qtbot.waitUntil(lambda: "\n".join(lines) in labels())
    assert "Running; heel lift, 6 mm" in labels()
    assert any(text.startswith("Version 2: ") for text in labels())
    assert page.cards[visit.id].row.day == moment_text(visit.created_at)  # two of a day differ
    (scanned,) = records.visits.open_case(visit.id).record.feet
    records.prescriptions.save(
        visit.id, mirrored_foot(scanned, lambda correction: correction), None
    )
    not_scanned = "Right foot not scanned: mirrored from the left"
    qtbot.waitUntil(lambda: not_scanned in page.cards[visit.id].row.scan)


def test_the_files_of_others_are_not_offered_for_a_visit_or_a_new_case(
    clinic: Application, records: Records, visit: Visit, qtbot: QtBot
) -> None:
    clinic.services.recent.remember(Path("/scans/somebody-else.stl"))
    empty = records.visits.add(Visit(visit.person_id, date.today()))

    def offered() -> list[str]:
        buttons = clinic.window.findChildren(QPushButton)
        return [button.text() for button in buttons if not button.visibleRegion().isEmpty()]

    qtbot.waitUntil(lambda: "somebody-else.stl" in offered())
    clinic.controller.run_action("new_case", False)
    qtbot.waitUntil(lambda: "Open case…" in offered())
    assert not any("somebody-else" in text for text in offered())
    clinic.features.records.open_visit(empty.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    assert not any("somebody-else" in text for text in offered())


def test_names_are_shown_as_they_are(
    clinic: Application, records: Records, rest: Callable[[], None]
) -> None:
    evil = "<b>Eva</b> & Co"
    person = records.persons.add(Person(evil))
    clinic.features.records.show_person(person.id)
    rest()
    page = clinic.features.records.person
    assert page is not None
    assert page._name.text() == evil
    assert page._name.textFormat() is Qt.TextFormat.PlainText


def test_a_trend_goes_from_the_earlier_to_the_later_of_two_visits_on_one_day() -> None:
    visits = [
        Visit(
            "p", day, measures={"right_foot_length_mm": value_mm}, created_at=f"2026-11-28T{at}:00Z"
        )
        for day, at, value_mm in (
            (date(2026, 11, 28), "10:50", 274.9),  # as the record gives them: the newest first
            (date(2026, 11, 28), "10:37", 239.5),
            (date(2026, 11, 2), "23:59", 238.0),
        )
    ]
    (trend,) = trends_of(visits)
    assert trend.values == (238.0, 239.5, 274.9)
