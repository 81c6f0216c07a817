"""Opening a record: its database is made if there is none, and brought to this program's tables."""

from __future__ import annotations

import os
from pathlib import Path

from insole_core.export.atomic import make_output_folder
from insole_core.export.file_mode import PRIVATE_FILE
from insole_core.export.write_errors import output_errors
from insole_core.records.author import Author
from insole_core.records.content_store import ContentStore
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA, migrate
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records


def open_records(place: RecordsPlace, who: Author) -> Records:
    """Open the record of a place.

    Raises
    ------
    RecordsError
        When it comes from a newer program, is damaged, or does not answer.
    OutputError
        When a new one cannot be made.
    """
    if place.is_local and not place.database_file.exists():
        _make_file(place.database_file)
    database = Database(place)
    try:
        migrate(database)
    except BaseException:
        database.close()
        raise
    database.schema = SCHEMA
    return Records(database, ContentStore(place.contents), who)


def _make_file(path: Path) -> None:
    """Make an empty file that only its owner may read; another program may be as quick."""
    make_output_folder(path.parent)
    with output_errors(path):
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, PRIVATE_FILE))
