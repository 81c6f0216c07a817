"""A window with an open record, and the dialogs of its administration."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from administering import OTHER_PASSWORD, PASSWORD, Dialog, shown
from postgres_server import binaries, running_server
from pytestqt.qtbot import QtBot

from insole_core.records.accounts import Accounts
from insole_core.records.author import Author, Role
from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState


@pytest.fixture
def clinic(app: Application, qtbot: QtBot) -> Application:
    """The application on its start page, with a new record."""
    record = app.services.clinic
    app.window.resize(1366, 768)
    app.features.records.show_start()
    record.open()
    qtbot.waitUntil(lambda: record.is_open, timeout=20_000)
    return app


@pytest.fixture
def records(clinic: Application) -> Records:
    """The record that the window has open, to look into it from outside."""
    return clinic.services.clinic.ask_now(lambda found: found)


@pytest.fixture
def rest(qtbot: QtBot, clinic: Application) -> Callable[[], None]:
    """Wait until the record and the window have nothing left to do."""

    def is_at_rest() -> bool:
        all_jobs = (
            clinic.services.clinic.jobs,
            clinic.jobs,
            clinic.features.clinic.backups.jobs,
        )
        return not any(jobs.is_running() for jobs in all_jobs)

    def wait() -> None:
        qtbot.waitUntil(is_at_rest, timeout=30_000)

    return wait


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
    root = Author("admin", "desk", Role.ADMINISTRATOR)
    accounts: Accounts = records.for_author(root).accounts
    accounts.add("eva", "Eva Ek", Role.ORTHOPEDIST, OTHER_PASSWORD)
    record = clinic.services.clinic
    qtbot.waitUntil(lambda: record.state is RecordState.SIGNED_OUT, timeout=10_000)
    return clinic


@pytest.fixture
def backup_folder(tmp_path: Path) -> Path:
    folder = tmp_path / "disk"
    folder.mkdir()
    return folder


@pytest.fixture
def postgres_url() -> Iterator[str]:
    """The address of an empty database on a server of this test alone."""
    if binaries() is None:
        pytest.skip("PostgreSQL is not installed")
    with running_server() as server:
        server.execute("CREATE DATABASE records")
        yield server.url("records")
