"""The window makes the clinic's backups, says why it could not, and lets unused files go."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pyrage
import pytest
from pytestqt.qtbot import QtBot

from insole_core.errors import OutputError
from insole_core.records.author import Author
from insole_core.records.backup.back_up import back_up, set_up_backups
from insole_core.records.backup.backup_folder import BackupFolder
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.schedule import BackupSchedule, set_schedule
from insole_core.records.open import open_records
from insole_core.records.place import RecordsPlace
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_maintenance import BACKUP, RecordMaintenance
from insole_studio.jobs import Jobs


@pytest.fixture
def backups(qtbot: QtBot, tmp_path: Path) -> Iterator[RecordMaintenance]:
    """Of a record whose first backup is a year old."""
    records = open_records(RecordsPlace.local(tmp_path / "records"), Author.of_user())
    recipient = pyrage.x25519.Identity.generate().to_public()
    set_up_backups(records.context, BackupKey.for_recipients([str(recipient)]))
    folder = tmp_path / "backups"
    back_up(records.context, folder)
    (first,) = (folder / "snapshots").iterdir()
    first.rename(first.with_name("000001-2025-01-01T00-00-00Z.age"))
    unused = records.contents.path(records.contents.put(b"nobody needs it"))
    os.utime(unused, (0, 0))
    set_schedule(records.context, BackupSchedule(folder, 24, records.who.station))
    records.close()
    clinic = ClinicRecord(tmp_path / "records", Jobs())
    backups = RecordMaintenance(clinic, {}, Jobs())
    backups.look()  # nothing is done before the record is open
    clinic.open()
    qtbot.waitUntil(lambda: clinic.is_open)
    yield backups
    backups.close()
    clinic.close()


def test_a_backup_that_is_due_is_made_once(
    backups: RecordMaintenance, qtbot: QtBot, tmp_path: Path
) -> None:
    with qtbot.waitSignal(backups.made):
        backups.look()
    folder = BackupFolder(tmp_path / "backups")
    assert [snapshot.number for snapshot in folder.snapshots()] == [1, 2]
    backups.look()
    qtbot.waitUntil(lambda: not backups._jobs.is_running(BACKUP))
    assert len(folder.snapshots()) == 2


def test_unused_files_are_set_aside(
    backups: RecordMaintenance, qtbot: QtBot, tmp_path: Path
) -> None:
    contents = tmp_path / "records" / "contents"
    assert not (contents / "removed").exists()
    with qtbot.waitSignal(backups.made):
        backups.look()
    (aside,) = (contents / "removed").iterdir()
    assert aside.read_bytes() == b"nobody needs it"


def test_a_disk_that_is_not_connected_is_told(
    backups: RecordMaintenance, qtbot: QtBot, tmp_path: Path
) -> None:
    (tmp_path / "backups").rename(tmp_path / "away")
    with qtbot.waitSignal(backups.failed) as failed:
        backups.look()
    (error,) = failed.args
    assert isinstance(error, OutputError)
    assert "connect its disk" in str(error)
    assert not (tmp_path / "backups").exists()
