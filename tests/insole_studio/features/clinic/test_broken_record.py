"""A record that is damaged, missing or held: the window says so, reads what it can, restores."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pyrage
import pytest
from administering import OTHER_PASSWORD, shown, sign_in, type_into
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot
from stations import proven

from insole_core.records import database as database_module
from insole_core.records.backup.back_up import back_up, set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.person import Person
from insole_core.records.place import DATABASE_FILE
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.clinic.restore_dialog import RestoreDialog
from insole_studio.features.clinic.sign_in_dialog import SignInDialog
from insole_studio.features.records.start_page import StartPage


@pytest.fixture
def secret() -> str:
    """A private key, which opens a backup sooner than a passphrase does."""
    return str(pyrage.x25519.Identity.generate())


@pytest.fixture
def backed_up(
    with_accounts: Application, records: Records, backup_folder: Path, secret: str
) -> Application:
    """Eva's patient Anna is in a backup."""
    records.for_author(proven("eva")).persons.add(Person("Anna Berg"))
    root = records.for_author(proven("admin"))
    recipient = str(pyrage.x25519.Identity.from_str(secret).to_public())
    set_up_backups(root.context, BackupKey.for_recipients([recipient]))
    back_up(root.context, backup_folder)
    with_accounts.settings.backup_folder = str(backup_folder)
    return with_accounts


def start_page(app: Application) -> StartPage:
    page = app.features.records.start
    assert page is not None
    return page


def reopen(app: Application, qtbot: QtBot, state: RecordState) -> None:
    record = app.services.clinic
    record.open()
    qtbot.waitUntil(lambda: record.state is state)


def restore(app: Application, secret: str, rest: Callable[[], None]) -> None:
    """Restore as a user does who only has the secret."""
    dialog = shown(app, RestoreDialog)
    rest()
    type_into(dialog.secret, secret)
    QTest.keyClick(dialog.secret, Qt.Key.Key_Return)  # shows what the backup holds
    rest()
    QTest.keyClick(dialog.restore_button, Qt.Key.Key_Return)
    rest()
    if dialog.restore_button.isEnabled():  # now it sets the present record aside
        QTest.keyClick(dialog.restore_button, Qt.Key.Key_Return)
        rest()
    assert "The record is as it was on" in dialog.message.text()
    assert not any(found.isVisible() for found in app.window.findChildren(SignInDialog))
    dialog.close_button.click()


def test_a_damaged_record_with_accounts_is_read_after_signing_in(
    backed_up: Application, damage: Callable[[str], None], rest: Callable[[], None], qtbot: QtBot
) -> None:
    damage("presence")
    reopen(backed_up, qtbot, RecordState.SIGNED_OUT)
    dialog = shown(backed_up, SignInDialog)
    assert "is damaged; restore the record from a backup" in dialog.problem.text()
    assert dialog.restore.isVisible()
    sign_in(dialog, "eva", "a wrong password")
    qtbot.waitUntil(lambda: "is wrong" in dialog.message.text())
    sign_in(dialog, "eva", OTHER_PASSWORD)
    qtbot.waitUntil(lambda: backed_up.services.clinic.is_open)
    rest()
    page = start_page(backed_up)
    assert [row.cells[0] for row in page.found.rows] == ["Anna Berg"]
    assert "is damaged" in page.message.text()
    assert page.remedies["restore_record"].isVisible()
    assert not page.new_patient.isEnabled()
    actions = backed_up.window.actions_by_key
    keys = ("new_patient", "import_table", "import_cases")
    for part in (page.new_patient, *(actions[key] for key in keys)):
        assert not part.isEnabled()
        assert part.toolTip() == "Nothing can be changed in the record at the moment."


def test_a_damaged_record_with_accounts_is_restored_before_signing_in(
    backed_up: Application,
    damage: Callable[[str], None],
    secret: str,
    rest: Callable[[], None],
    qtbot: QtBot,
) -> None:
    """Not even the accounts can be read, so that nobody can sign in."""
    damage("accounts")
    reopen(backed_up, qtbot, RecordState.SIGNED_OUT)
    dialog = shown(backed_up, SignInDialog)
    sign_in(dialog, "eva", OTHER_PASSWORD)
    qtbot.waitUntil(lambda: "is damaged" in dialog.message.text())
    dialog.restore.click()
    restore(backed_up, secret, rest)
    record = backed_up.services.clinic
    assert record.state is RecordState.SIGNED_OUT
    dialog = shown(backed_up, SignInDialog)
    assert dialog.problem.text() == ""
    assert not dialog.restore.isVisible()
    sign_in(dialog, "eva", OTHER_PASSWORD)
    qtbot.waitUntil(lambda: record.is_open)
    assert not record.is_read_only


@pytest.mark.parametrize(
    ("lose", "told"),
    [
        (Path.unlink, "is missing, but the files of the record beside it are there"),
        (lambda file: os.truncate(file, 0), "is damaged; restore the record from a backup"),
    ],
    ids=["gone", "empty"],
)
def test_a_lost_database_is_told_and_restored(
    backed_up: Application,
    secret: str,
    rest: Callable[[], None],
    qtbot: QtBot,
    lose: Callable[[Path], None],
    told: str,
) -> None:
    record = backed_up.services.clinic
    record.let_go()
    lose(backed_up.services.paths.records_folder / DATABASE_FILE)
    reopen(backed_up, qtbot, RecordState.REFUSED)
    page = start_page(backed_up)
    assert told in page.message.text()
    assert not page.search.isEnabled()
    page.remedies["restore_record"].click()
    restore(backed_up, secret, rest)
    assert record.state is RecordState.SIGNED_OUT
    assert shown(backed_up, SignInDialog).problem.text() == ""


def test_a_database_that_another_program_holds_is_told_and_opened_later(
    clinic: Application,
    records: Records,
    rest: Callable[[], None],
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    records.persons.add(Person("Anna Berg"))
    monkeypatch.setattr(database_module, "BUSY_S", 0.1)
    record = clinic.services.clinic
    record.let_go()
    file = clinic.services.paths.records_folder / DATABASE_FILE
    page = start_page(clinic)
    with held(file):
        reopen(clinic, qtbot, RecordState.REFUSED)
        assert "is held by another program; wait until that has finished" in page.message.text()
        assert page.remedies["retry_record"].isVisible()
    page.remedies["retry_record"].click()
    qtbot.waitUntil(lambda: record.is_open)
    rest()
    assert [row.cells[0] for row in page.found.rows] == ["Anna Berg"]
    assert page.message.text() == ""


@contextmanager
def held(file: Path) -> Iterator[None]:
    """Let another program lock a database, also for reading."""
    with closing(sqlite3.connect(file, isolation_level=None)) as other:
        other.execute("PRAGMA locking_mode=EXCLUSIVE")
        other.execute("BEGIN EXCLUSIVE")
        yield
