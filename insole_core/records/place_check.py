"""Trying a place before the record is moved there; nothing is made or changed."""

from __future__ import annotations

import os
from dataclasses import dataclass

from sqlalchemy import func, select

from insole_core.errors import RecordsError
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA, check_schema, schema_of
from insole_core.records.place import RecordsPlace
from insole_core.records.schema import persons


@dataclass(frozen=True)
class PlaceReport:
    """What a place holds.

    Parameters
    ----------
    persons
        Number of persons in its record; None where there is no record yet.
    is_older
        Whether the record comes from an older program; opening it brings it up to date.
    """

    persons: int | None
    is_older: bool = False


def check_place(place: RecordsPlace) -> PlaceReport:
    """Return what a place on a server holds.

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
    database = Database(place)
    try:
        with database.reading() as connection:
            schema = schema_of(connection)
            check_schema(schema, place.name)
            if schema is None:
                return PlaceReport(None)
            count = connection.execute(select(func.count()).select_from(persons)).scalar_one()
            return PlaceReport(count, is_older=schema != SCHEMA)
    finally:
        database.close()
