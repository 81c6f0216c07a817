"""With accounts on, nothing is shown before somebody has signed in, nor after idle minutes."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_core.records.author import Author, Role
from insole_core.records.open import open_records
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.records.sign_in_page import SignInPage
from insole_studio.user_paths import UserPaths

PASSWORD = "a long walk on soft sand"


@pytest.fixture
def locked(app: Application, paths: UserPaths, qtbot: QtBot) -> Application:
    """The window of a clinic with accounts, before somebody has signed in."""
    records = open_records(RecordsPlace.local(paths.records_folder), Author("root", "desk"))
    records.persons.add(Person("Anna Berg"))
    records.accounts.switch_on("admin", "A. Berg", PASSWORD)
    administrator = Author("admin", "desk", Role.ADMINISTRATOR)
    accounts = Records(records.context.database, records.contents, administrator).accounts
    accounts.add("dal", "Dr. Dal", Role.ORTHOPEDIST, PASSWORD)
    records.close()
    app.features.records.show_start()
    clinic = app.services.clinic
    clinic.open()
    qtbot.waitUntil(lambda: clinic.state is RecordState.LOCKED, timeout=10_000)
    return app


def page_of(app: Application) -> SignInPage:
    page = app.features.records.lock.page
    assert page is not None
    return page


def sign_in(app: Application, password: str, name: str = "dal") -> None:
    page = page_of(app)
    page.name.setText(name)
    page.password.setText(password)
    QTest.keyClick(page.password, Qt.Key.Key_Return)


def test_nothing_is_shown_before_somebody_has_signed_in(locked: Application) -> None:
    assert locked.window.page is page_of(locked)
    assert not locked.window.menuBar().isEnabled()
    assert not locked.stage.steps.isVisible()
    start = locked.features.records.start
    assert start is not None
    assert not start.isVisible()
    assert start.found.rows == ()


def test_a_wrong_password_is_refused_and_the_right_one_opens(
    locked: Application, qtbot: QtBot
) -> None:
    sign_in(locked, "wrong")
    page = page_of(locked)
    qtbot.waitUntil(page.refusal.isVisible, timeout=10_000)
    assert page.refusal.text().startswith("The name or the password is wrong")
    assert page.password.text() == ""
    sign_in(locked, PASSWORD)
    clinic = locked.services.clinic
    qtbot.waitUntil(lambda: clinic.is_open, timeout=10_000)
    start = locked.features.records.start
    assert start is not None
    assert locked.window.page is start
    assert locked.window.menuBar().isEnabled()
    qtbot.waitUntil(lambda: [row.cells[0] for row in start.found.rows] == ["Anna Berg"])
    assert clinic.author is not None
    assert clinic.author.name == "dal"


def test_who_may_not_see_patients_is_told_so(locked: Application, qtbot: QtBot) -> None:
    sign_in(locked, PASSWORD, "admin")
    start = locked.features.records.start
    assert start is not None
    qtbot.waitUntil(start.message.isVisible, timeout=10_000)
    assert "may not see patients" in start.message.text()
    assert start.found.rows == ()


def test_a_visit_stays_open_behind_the_lock(locked: Application, qtbot: QtBot) -> None:
    sign_in(locked, PASSWORD)
    clinic = locked.services.clinic
    qtbot.waitUntil(lambda: clinic.is_open, timeout=10_000)
    locked.controller.run_action("new_case", False)
    locked.services.notices.put("patient", "Anna Berg")
    assert locked.stage.notices.isVisible()
    clinic.lock()
    assert not locked.stage.notices.isVisible()
    assert locked.window.page is page_of(locked)
    assert not locked.stage.patient.isVisible()
    assert locked.window.windowTitle() == "Locked[*] – Insole Studio"
    sign_in(locked, PASSWORD)
    qtbot.waitUntil(lambda: clinic.is_open, timeout=10_000)
    assert locked.window.page is None
    assert locked.stage.patient.isVisible()
    assert locked.stage.notices.isVisible()


def test_minutes_without_input_lock(locked: Application, qtbot: QtBot) -> None:
    sign_in(locked, PASSWORD)
    clinic = locked.services.clinic
    qtbot.waitUntil(lambda: clinic.is_open, timeout=10_000)
    idle = locked.features.records.lock._idle
    assert idle.interval() == 600_000
    idle.start(50)
    qtbot.waitUntil(lambda: clinic.state is RecordState.LOCKED, timeout=10_000)
    assert locked.window.page is page_of(locked)


def test_without_accounts_nobody_is_asked(clinic: Application, visit: Visit) -> None:
    assert clinic.features.records.lock.page is None
    assert not clinic.features.records.lock._idle.isActive()
