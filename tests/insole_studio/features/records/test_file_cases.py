"""Cases of files work as before, also without a record, and can become visits."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from datetime import date, timedelta
from pathlib import Path

import pytest
from canned_questions import CannedQuestions
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.person import Person
from insole_core.records.place import DATABASE_FILE
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_core.workflows.order_package import Ordered
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.records.patient_dialogs import ChoosePersonDialog
from insole_studio.features.records.record_dialogs import OrderDialog
from insole_studio.services.questions import Namesake
from insole_studio.user_paths import UserPaths

pytestmark = pytest.mark.one_window

LEFT = Qt.MouseButton.LeftButton


def open_case(app: Application, make_foot: Callable[[Side], Foot]) -> None:
    foot = FootRecord.begun(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/a.ply", "0" * 64))
    app.case.open(CaseRecord.of_foot(foot, Patient("Anna Berg", "1970-02-28")), None)


@pytest.mark.parametrize("is_new", [True, False])
def test_a_case_becomes_a_visit(
    clinic: Application,
    records: Records,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
    is_new: bool,
) -> None:
    known = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    open_case(clinic, make_foot)
    clinic.controller.run_action("add_to_record", False)
    (dialog,) = clinic.window.findChildren(ChoosePersonDialog)
    qtbot.waitUntil(lambda: bool(dialog.table.rows))
    assert dialog.add.toolTip() == "Choose a patient in the list first."
    dialog.table.take_first()
    assert dialog.add.toolTip() == ""
    QTest.mouseClick(dialog.new if is_new else dialog.add, LEFT)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    kept = clinic.case.kept
    assert kept is not None
    assert (kept.person.id == known.id) is not is_new
    assert kept.person.birth_date == date(1970, 2, 28)
    assert len(records.prescriptions.versions(kept.visit.id, Side.LEFT)) == 1
    assert not clinic.window.actions_by_key["add_to_record"].isEnabled()


def test_a_case_of_a_namesake_may_become_a_visit_of_the_one_who_is_there(
    clinic: Application,
    records: Records,
    questions: CannedQuestions,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
) -> None:
    known = records.persons.add(Person("Berg, Anna", date(1970, 2, 28)))
    questions.namesake = Namesake.SAME
    open_case(clinic, make_foot)
    clinic.controller.run_action("add_to_record", False)
    (dialog,) = clinic.window.findChildren(ChoosePersonDialog)
    QTest.mouseClick(dialog.new, LEFT)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    assert questions.asked == [f"Berg, Anna, 1970-02-28 ({known.pseudonym})"]
    kept = clinic.case.kept
    assert kept is not None
    assert kept.person.id == known.id
    assert len(records.persons.recent()) == 1
    assert len(records.visits.of_person(known.id)) == 1


@pytest.mark.parametrize("trouble", ["damaged", "newer"])
def test_a_record_that_cannot_be_opened_is_told_and_files_go_on(
    app: Application,
    paths: UserPaths,
    make_foot: Callable[[Side], Foot],
    qtbot: QtBot,
    trouble: str,
) -> None:
    paths.records_folder.mkdir(parents=True)
    database = paths.records_folder / DATABASE_FILE
    if trouble == "damaged":
        database.write_bytes(b"SQLite format 3\0" + b"\xff" * 5000)
    else:
        with sqlite3.connect(database) as connection:
            connection.execute("CREATE TABLE alembic_version (version_num TEXT)")
            connection.execute("INSERT INTO alembic_version VALUES ('9999_future')")
        connection.close()
    app.features.records.show_start()
    app.services.clinic.open()
    qtbot.waitUntil(lambda: app.services.clinic.state is RecordState.REFUSED)
    page = app.features.records.start
    assert page is not None
    said = page.message.text()
    assert page.message.isVisible()
    assert str(database) in said
    assert "Cases in files can be opened as before." in said
    assert not page.search.isEnabled()
    open_case(app, make_foot)
    assert app.window.page is None
    assert app.services.keeper.state is KeepState.NOTHING


def test_an_export_of_a_visit_is_an_order_with_its_files(
    clinic: Application, records: Records, visit: Visit, tmp_path: Path, qtbot: QtBot
) -> None:
    clinic.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    solid = tmp_path / "insole-left.stl"
    solid.write_bytes(b"solid insole")
    ordered = Ordered((solid,), OrderTerms(remarks="soft heel"), "26-7KQ4M")
    clinic.features.export.exported_files.emit(clinic.case.record, ordered, visit.id)
    notices = clinic.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    (order,) = records.orders.of_person(visit.person_id)
    kept = records.orders.get(order.id)
    assert [file.name for file in kept.files] == ["insole-left.stl"]
    assert (kept.number, kept.remarks) == ("26-7KQ4M", "soft heel")
    notices.take("record-order")
    qtbot.waitUntil(lambda: bool(clinic.window.findChildren(OrderDialog)))
    (dialog,) = clinic.window.findChildren(OrderDialog)
    assert dialog.editors["due_on"].text() == (date.today() + timedelta(days=14)).isoformat()
    dialog.editors["shop"].setText("CNC Nord")
    dialog.editors["due_on"].setText("2026-02-30")
    QTest.mouseClick(dialog.keep, LEFT)
    assert dialog.refusal.text().startswith("2026-02-30 is no date")
    dialog.editors["due_on"].setText(date.today().isoformat())
    QTest.mouseClick(dialog.keep, LEFT)
    qtbot.waitUntil(lambda: records.orders.get(order.id).shop == "CNC Nord")
    assert records.orders.get(order.id).due_on == date.today()
