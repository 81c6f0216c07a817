"""Accounts are switched on and administered in the window; then it is signed into and locked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date

import pytest
from administering import OTHER_PASSWORD, PASSWORD, shown, sign_in, type_into
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot
from stations import FIRST, proven

from insole_core.errors import FirstPassword
from insole_core.records.author import Role
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.clinic import session_lock
from insole_studio.features.clinic.account_form import ChangedAccount, NewAccount, OwnPassword
from insole_studio.features.clinic.accounts_dialog import AccountsDialog
from insole_studio.features.clinic.sign_in_dialog import SignInDialog

Run = Callable[[str, type], object]


def signed_in(
    clinic: Application, qtbot: QtBot, name: str = "eva", password: str = OTHER_PASSWORD
) -> None:
    sign_in(shown(clinic, SignInDialog), name, password)
    record = clinic.services.clinic
    qtbot.waitUntil(lambda: record.author is not None and record.author.name == name)
    qtbot.waitUntil(lambda: not record.jobs.is_running())


def name_patient(clinic: Application, name: str) -> None:
    clinic.case.apply(replace(clinic.case.record.patient, name=name), "Name")


def test_while_accounts_are_off_nothing_is_seen_of_them(clinic: Application) -> None:
    actions = clinic.window.actions_by_key
    assert not actions["lock"].isVisible()
    assert not actions["change_password"].isVisible()
    actions["lock"].trigger()
    assert clinic.features.clinic.lock.dialog is None


def test_switching_on_makes_the_first_administrator_who_then_signs_in(
    clinic: Application, records: Records, run: Run, qtbot: QtBot
) -> None:
    dialog = run("accounts", AccountsDialog)
    assert isinstance(dialog, AccountsDialog)
    type_into(dialog.name, "admin")
    type_into(dialog.full_name, "Rut Root")
    type_into(dialog.passwords.first, PASSWORD)
    type_into(dialog.passwords.again, "something else")
    dialog.switch_on.click()
    assert "not the same" in dialog.message.text()
    assert not records.accounts.are_on
    for line in (dialog.passwords.first, dialog.passwords.again):
        type_into(line, "admin admin admin")
    dialog.switch_on.click()
    qtbot.waitUntil(lambda: "first that are tried" in dialog.message.text())
    for line in (dialog.passwords.first, dialog.passwords.again):
        type_into(line, PASSWORD)
    dialog.switch_on.click()
    record = clinic.services.clinic
    qtbot.waitUntil(lambda: record.state is RecordState.SIGNED_OUT)
    signed_in(clinic, qtbot, "admin", PASSWORD)
    assert record.is_open
    assert clinic.window.actions_by_key["lock"].isVisible()


def test_a_wrong_password_is_told_and_so_is_the_lock_after_too_many(
    with_accounts: Application, qtbot: QtBot
) -> None:
    dialog = shown(with_accounts, SignInDialog)
    for _ in range(5):
        sign_in(dialog, "eva", "wrong")
        qtbot.waitUntil(lambda: dialog.isEnabled() and "wrong" in dialog.message.text())
        assert dialog.password.text() == ""
    sign_in(dialog, "eva", OTHER_PASSWORD)
    qtbot.waitUntil(lambda: "Too many wrong passwords" in dialog.message.text())
    assert with_accounts.services.clinic.state is RecordState.SIGNED_OUT


def test_whoever_has_a_first_password_chooses_their_own(
    with_accounts: Application, records: Records, qtbot: QtBot
) -> None:
    root = records.for_author(proven("admin"))
    root.accounts.add("tom", "Tom Tall", Role.TECHNICIAN, FIRST)
    dialog = shown(with_accounts, SignInDialog)
    assert not dialog.own.first.isVisible()
    sign_in(dialog, "tom", FIRST)
    qtbot.waitUntil(dialog.own.first.isVisible)
    assert "chosen by somebody else" in dialog.message.text()
    type_into(dialog.name, "eva")  # whose password it is not
    assert not dialog.own.first.isVisible()
    sign_in(dialog, "tom", FIRST)
    qtbot.waitUntil(lambda: dialog.isEnabled() and dialog.own.first.isVisible())
    for again, told in ((PASSWORD, "not the same"), (FIRST, "had before")):
        type_into(dialog.own.first, FIRST)
        type_into(dialog.own.again, again)
        dialog.sign_in.click()
        qtbot.waitUntil(lambda told=told: told in dialog.message.text())
    assert with_accounts.services.clinic.state is RecordState.SIGNED_OUT
    for line in (dialog.own.first, dialog.own.again):
        type_into(line, "yet other long words")
    dialog.sign_in.click()
    qtbot.waitUntil(lambda: with_accounts.services.clinic.is_open)
    assert records.accounts.sign_in("tom", "yet other long words").role is Role.TECHNICIAN


def test_the_status_line_says_who_has_signed_in(with_accounts: Application, qtbot: QtBot) -> None:
    def told() -> list[str]:
        return [label.text() for label in with_accounts.window.status.findChildren(QLabel)]

    assert not any("Signed in" in text for text in told())
    signed_in(with_accounts, qtbot)
    assert "Signed in as eva" in told()


def test_files_are_open_to_somebody_who_does_not_sign_in(with_accounts: Application) -> None:
    shown(with_accounts, SignInDialog).close_button.click()
    page = with_accounts.features.records.start
    assert page is not None
    assert not page.search.isEnabled()
    assert "Sign in" in page.message.text()
    page.remedies["lock"].click()
    assert shown(with_accounts, SignInDialog).isVisible()


def test_the_lock_hides_names_and_titles_and_unlocking_returns_to_the_page(
    with_accounts: Application, records: Records, qtbot: QtBot
) -> None:
    signed_in(with_accounts, qtbot)
    window = with_accounts.window
    name_patient(with_accounts, "Anna Berg")
    title, page = window.windowTitle(), window.page
    with_accounts.window.actions_by_key["lock"].trigger()
    lock = with_accounts.features.clinic.lock
    assert lock.dialog is not None
    assert "Anna" not in window.windowTitle()
    name_patient(with_accounts, "Berta Berg")
    assert "Berta" not in window.windowTitle()
    start = with_accounts.features.records.start
    assert start is not None
    covering = window.childAt(start.search.mapTo(window, start.search.rect().center()))
    assert covering is not start.search
    assert not start.isAncestorOf(covering)
    QTest.keyClicks(start.search, "anna")
    assert start.search.text() == ""
    dialog = shown(with_accounts, SignInDialog)
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert dialog.isVisible()
    signed_in(with_accounts, qtbot)
    assert lock.dialog is None
    assert window.windowTitle() == title.replace("Anna", "Berta")
    assert window.page is page
    QTest.keyClicks(start.search, "anna")
    assert start.search.text() == "anna"


def test_windows_that_open_while_it_is_locked_are_covered_too(
    with_accounts: Application, qtbot: QtBot
) -> None:
    signed_in(with_accounts, qtbot)
    with_accounts.window.actions_by_key["lock"].trigger()
    with_accounts.services.messages.show_sentence("Anna Berg cannot be saved.")
    (told,) = with_accounts.services.messages.dialogs
    qtbot.waitUntil(told.isVisible)
    centre = told.rect().center()
    assert told.childAt(centre).text() == "Locked"  # type: ignore[attr-defined]
    QTest.keyClick(told, Qt.Key.Key_Escape)
    assert told.isVisible()
    signed_in(with_accounts, qtbot)
    QTest.keyClick(told, Qt.Key.Key_Escape)
    assert not told.isVisible()


def test_the_window_locks_itself_after_minutes_without_input(
    with_accounts: Application, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session_lock.IdleWatch, "start", _start_in_seconds)
    signed_in(with_accounts, qtbot)
    lock = with_accounts.features.clinic.lock
    qtbot.waitUntil(lambda: lock.dialog is not None)


def _start_in_seconds(watch: session_lock.IdleWatch, most_s: float) -> None:
    """Let a minute be a twentieth of a second."""
    _START(watch, most_s / 1200)
    watch._timer.setInterval(50)


_START = session_lock.IdleWatch.start


def test_input_keeps_the_window_open(with_accounts: Application, qtbot: QtBot) -> None:
    watch = session_lock.IdleWatch(with_accounts.window)
    ended: list[bool] = []
    watch.idle.connect(lambda: ended.append(True))
    watch.start(0.6)
    watch._timer.setInterval(50)
    for _ in range(8):
        QTest.keyClick(with_accounts.window, Qt.Key.Key_Shift)
        QTest.qWait(120)
    assert ended == []
    qtbot.waitUntil(lambda: ended == [True])
    assert not watch.is_running


def test_an_administrator_adds_changes_and_unlocks_accounts(
    with_accounts: Application, records: Records, run: Run, rest: Callable[[], None], qtbot: QtBot
) -> None:
    sign_in(shown(with_accounts, SignInDialog), "eva", "wrong")
    qtbot.waitUntil(shown(with_accounts, SignInDialog).isEnabled)
    signed_in(with_accounts, qtbot, "admin", PASSWORD)
    dialog = run("accounts", AccountsDialog)
    assert isinstance(dialog, AccountsDialog)
    assert [row.cells[3] for row in dialog.table.rows] == ["", "wrong passwords: 1"]
    dialog.table.selectRow(0)
    assert not dialog.unlock.isEnabled()
    assert dialog.unlock.toolTip() == "This account is not locked."
    dialog.table.selectRow(1)
    assert dialog.unlock.toolTip() == ""
    dialog.unlock.click()
    rest()
    assert [row.cells[3] for row in dialog.table.rows] == ["", ""]
    dialog.add.click()
    form = shown(with_accounts, NewAccount)
    type_into(form.name, "tom")
    type_into(form.full_name, "Tom Tall")
    form.role.setCurrentIndex(form.role.findData(str(Role.TECHNICIAN)))
    for line in (form.passwords.first, form.passwords.again):
        type_into(line, "yet other long words")
    form.accept_button.click()
    rest()
    assert [row.cells[0] for row in dialog.table.rows] == ["admin", "eva", "tom"]
    dialog.table.selectRow(0)
    dialog.edit.click()
    changed = shown(with_accounts, ChangedAccount)
    changed.disabled.setChecked(True)
    changed.accept_button.click()
    rest()
    assert "only administrator" in changed.message.text()
    changed.disabled.setChecked(False)
    type_into(changed.system_user, "rut")
    changed.accept_button.click()
    rest()
    dialog.table.selectRow(0)
    dialog.edit.click()
    again = shown(with_accounts, ChangedAccount)
    assert again.system_user.text() == "rut"
    again.reject()
    dialog.minutes.setValue(3)
    QTest.keyClick(dialog.minutes, Qt.Key.Key_Return)
    rest()
    assert with_accounts.features.clinic.lock.lock_minutes == 3
    assert dialog.table.rows[2].cells[3] == "first password"
    with pytest.raises(FirstPassword):
        records.accounts.sign_in("tom", "yet other long words")


def test_what_a_role_may_not_do_is_refused_in_words(
    with_accounts: Application, records: Records, run: Run, qtbot: QtBot
) -> None:
    signed_in(with_accounts, qtbot)
    dialog = run("accounts", AccountsDialog)
    assert isinstance(dialog, AccountsDialog)
    assert "eva (orthopedist) may not manage accounts" in dialog.message.text()
    assert not dialog.table.isVisible()


def test_an_administrator_who_takes_over_sees_no_patient(
    with_accounts: Application, records: Records, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    signed_in(with_accounts, qtbot)
    eva = records.for_author(proven("eva"))
    eva.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    pages = with_accounts.features.records
    assert pages.start is not None
    pages.start.begin()
    qtbot.waitUntil(lambda: pages.start is not None and len(pages.start.found.rows) == 1)
    pages.show_person(eva.persons.recent()[0].id)
    rest()
    assert with_accounts.window.page is pages.person
    with_accounts.window.actions_by_key["lock"].trigger()
    signed_in(with_accounts, qtbot, "admin", PASSWORD)
    rest()
    assert with_accounts.window.page is pages.start
    assert pages.start.found.rows == ()
    assert "sees no patients" in pages.start.message.text()


def test_ones_own_password_is_changed_with_the_present_one(
    with_accounts: Application, records: Records, run: Run, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    signed_in(with_accounts, qtbot)
    form = run("change_password", OwnPassword)
    assert isinstance(form, OwnPassword)
    for line, text in (
        (form.old, OTHER_PASSWORD),
        (form.passwords.first, "a better one of words"),
        (form.passwords.again, "a better one of words"),
    ):
        type_into(line, text)
    QTest.keyClick(form.passwords.again, Qt.Key.Key_Return)
    rest()
    assert records.accounts.sign_in("eva", "a better one of words").name == "eva"
