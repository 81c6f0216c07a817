"""The window lets files go that nothing in the record refers to."""

from __future__ import annotations

import os
from pathlib import Path

from pytestqt.qtbot import QtBot

from insole_core.records.author import Author
from insole_core.records.open import open_records
from insole_core.records.place import RecordsPlace
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_location import RecordLocation
from insole_studio.document.record_maintenance import SWEEP, RecordMaintenance
from insole_studio.jobs import Jobs


def put_unused(folder: Path, content: bytes) -> Path:
    """Add an old file to the record to which nothing refers."""
    records = open_records(RecordsPlace.local(folder), Author.of_user())
    path = records.contents.path(records.contents.put(content))
    records.close()
    os.utime(path, (0, 0))
    return path


def test_unused_files_are_set_aside_once_a_day(qtbot: QtBot, tmp_path: Path) -> None:
    folder = tmp_path / "records"
    unused = put_unused(folder, b"nobody needs it")
    clinic = ClinicRecord(RecordLocation(folder), Jobs())
    maintenance = RecordMaintenance(clinic)
    maintenance.look()  # nothing is done before the record is open
    clinic.open()
    qtbot.waitUntil(lambda: clinic.is_open)
    assert unused.exists()
    with qtbot.waitSignal(maintenance.swept):
        maintenance.look()
    (aside,) = (folder / "contents" / "removed").iterdir()
    assert aside.read_bytes() == b"nobody needs it"
    again = put_unused(folder, b"nor this")
    maintenance.look()
    assert not clinic.jobs.is_running(SWEEP)
    assert again.exists()
    maintenance.close()
    clinic.close()
