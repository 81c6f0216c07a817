"""The dialogs of the administration of the record."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from administering import OTHER_PASSWORD, PASSWORD, Dialog, shown
from pytestqt.qtbot import QtBot
from stations import add_member, proven

from insole_core.records.author import Role
from insole_core.records.place import DATABASE_FILE
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState


@pytest.fixture(autouse=True)
def no_slow_passphrases(quick_passphrases: None) -> None:
    """Passphrases open their keys in no time."""


@pytest.fixture
def run(clinic: Application, rest: Callable[[], None]) -> Callable[[str, type[Dialog]], Dialog]:
    """Run an action of the menu, and return the dialog that it opens."""

    def run(key: str, kind: type[Dialog]) -> Dialog:
        clinic.window.actions_by_key[key].trigger()
        rest()
        return shown(clinic, kind)

    return run


@pytest.fixture
def with_accounts(clinic: Application, records: Records, qtbot: QtBot) -> Application:
    """The same with accounts: an administrator, and Eva who treats patients; nobody signed in."""
    records.accounts.switch_on("admin", "Rut Root", PASSWORD)
    root = proven("admin", Role.ADMINISTRATOR)
    add_member(records.for_author(root).accounts, "eva", "Eva Ek", Role.ORTHOPEDIST, OTHER_PASSWORD)
    record = clinic.services.clinic
    qtbot.waitUntil(lambda: record.state is RecordState.SIGNED_OUT)
    return clinic


@pytest.fixture
def backup_folder(tmp_path: Path) -> Path:
    folder = tmp_path / "disk"
    folder.mkdir()
    return folder


@pytest.fixture
def damage(clinic: Application) -> Callable[[str], None]:
    """Close the record, and overwrite the first page of one of its tables."""

    def damage(table: str) -> None:
        record = clinic.services.clinic
        record.let_go()
        file = clinic.services.paths.records_folder / DATABASE_FILE
        with closing(sqlite3.connect(file)) as connection:
            connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            [size] = connection.execute("PRAGMA page_size").fetchone()
            query = "SELECT rootpage FROM sqlite_master WHERE name = ?"
            [page] = connection.execute(query, (table,)).fetchone()
        content = bytearray(file.read_bytes())
        content[(page - 1) * size : page * size] = b"\xff" * size
        file.write_bytes(content)

    return damage
