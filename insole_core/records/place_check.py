"""Trying a place before the record is moved there, or looking after it; nothing is changed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from datetime import datetime

from insole_core.errors import RecordsError
from insole_core.messages import Message
from insole_core.records.backup.back_up import key_in, last_backup_at
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.database import Database, check_not_lost
from insole_core.records.migrate import SCHEMA, check_schema, schema_of
from insole_core.records.place import RecordsPlace
from insole_core.records.sample_patient import count_patients

_ONLY_LOOKS = Message("it is only looked at.")


@dataclass(frozen=True)
class PlaceReport:
    """What a place holds.

    Parameters
    ----------
    patients
        Number of real patients in its record; None where there is no record yet.
    is_older
        Whether the record comes from an older program; opening it brings it up to date.
    last_good_backup
        When it was in a backup last that lacks nothing; None for never.
    backup_key
        Of its backups; None until they are set up.
    """

    patients: int | None
    is_older: bool = False
    last_good_backup: datetime | None = None
    backup_key: BackupKey | None = None


def check_place(place: RecordsPlace) -> PlaceReport:
    """Return what a place on a server holds, if a record can be there.

    Raises
    ------
    Unreachable
        When the database does not answer.
    RecordsError
        When it refuses the user, comes from a newer program, or the folder of the large files
        cannot be written.
    """
    if not os.access(place.contents, os.W_OK | os.X_OK):
        raise RecordsError(
            "The folder of the large files, {folder}, is not there or may not be written by you; "
            "connect the share, or choose another folder.",
            folder=place.contents,
        )
    return look_at_place(place)


def look_at_place(place: RecordsPlace) -> PlaceReport:
    """Return what a place holds; its large files are not looked at.

    Raises
    ------
    Unreachable
        When the database does not answer.
    RecordsError
        When it refuses the user, is damaged, has lost its database, or comes from a newer program.
    """
    check_not_lost(place)
    if place.is_local and not place.database_file.exists():
        return PlaceReport(None)
    database = Database(place, problem=_ONLY_LOOKS)
    try:
        with database.snapshot(), database.reading() as connection:
            schema = schema_of(connection)
            check_schema(schema, place.name)
            if schema is None:
                return PlaceReport(None)
            return PlaceReport(
                count_patients(connection),
                is_older=schema != SCHEMA,
                last_good_backup=last_backup_at(database, good=True),
                backup_key=key_in(connection),
            )
    finally:
        database.close()
