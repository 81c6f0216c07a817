"""The window lets files go that nothing in the record refers to."""

from __future__ import annotations

import os
from datetime import date
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from insole_core.errors import RecordsError
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.records.retention import ErasureReason
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_location import RecordLocation
from insole_studio.document.record_maintenance import SWEEP, ErasedLeftovers, RecordMaintenance
from insole_studio.jobs import Jobs
from insole_studio.settings import Settings, load_settings, save_settings
from insole_studio.user_paths import UserPaths


def put_unused(folder: Path, content: bytes) -> Path:
    """Add an old file to the record to which nothing refers."""
    records = open_records(RecordsPlace.local(folder), Author.of_user())
    path = records.contents.path(records.contents.put(content))
    records.close()
    os.utime(path, (0, 0))
    return path


def paths_in(folder: Path) -> UserPaths:
    return UserPaths(folder / "config" / "settings.json", folder / "autosave")


def test_what_an_erased_patient_has_left_goes_at_the_next_start(
    qtbot: QtBot, tmp_path: Path
) -> None:
    """The program was stopped between the erasure and what had to follow it on this computer."""
    paths, folder = paths_in(tmp_path), tmp_path / "records"
    settings = Settings(recent=["/home/Uniqname.insole", "/home/eva.insole"])
    save_settings(settings, paths.settings_file)
    records = open_records(RecordsPlace.local(folder), Author.of_user())
    names = ("Zaphodina Uniqname", "Eva Ek", "Eva Eck")
    erased, kept, merged = (records.persons.add(Person(name)) for name in names)
    records.persons.merge(kept.id, merged.id)
    leftovers = ErasedLeftovers(paths)
    leftovers.erase(records, erased.id, ErasureReason.REQUEST, date.today())
    with pytest.raises(RecordsError, match="was merged"):  # what is refused leaves a note, too
        leftovers.erase(records, merged.id, ErasureReason.REQUEST, date.today())
    assert "niqname" not in "".join(p.read_text() for p in paths.erasures_folder.iterdir())
    records.close()
    clinic = ClinicRecord(RecordLocation(folder), Jobs())
    maintenance = RecordMaintenance(clinic, ErasedLeftovers(paths, settings))
    clinic.open()
    qtbot.waitUntil(lambda: settings.recent == ["/home/eva.insole"])
    qtbot.waitUntil(lambda: len(list(paths.erasures_folder.iterdir())) == 1)
    assert load_settings(paths.settings_file).recent == ["/home/eva.insole"]
    (refused,) = paths.erasures_folder.iterdir()
    os.utime(refused, (0, 0))
    maintenance.look()
    qtbot.waitUntil(lambda: not leftovers.are_noted)
    maintenance.close()
    clinic.close()


def test_unused_files_are_set_aside_once_a_day(qtbot: QtBot, tmp_path: Path) -> None:
    folder = tmp_path / "records"
    unused = put_unused(folder, b"nobody needs it")
    clinic = ClinicRecord(RecordLocation(folder), Jobs())
    maintenance = RecordMaintenance(clinic, ErasedLeftovers(paths_in(tmp_path)))
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
