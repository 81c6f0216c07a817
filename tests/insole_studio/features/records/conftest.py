"""A window on the start page of a new record."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from pytestqt.qtbot import QtBot

from insole_core.records.records import Records
from insole_studio.app.bootstrap import Application


@pytest.fixture
def rest(qtbot: QtBot, clinic: Application) -> Callable[[], None]:
    """Wait until the record and the window have nothing left to do."""

    def is_at_rest() -> bool:
        return not clinic.services.clinic.jobs.is_running() and not clinic.jobs.is_running()

    def wait() -> None:
        qtbot.waitUntil(is_at_rest, timeout=20_000)

    return wait


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
