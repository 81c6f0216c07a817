"""A cell of a local database that another program has filled with what it cannot be."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from typing import Any

import pytest
from sqlalchemy import Column, Table, select

from insole_core.errors import RecordsError
from insole_core.records import schema
from insole_core.records.author import Author
from insole_core.records.checked_values import day_of
from insole_core.records.database import Database
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records

COLUMNS = [(table, column) for table in schema.metadata.sorted_tables for column in table.columns]


@pytest.fixture(scope="module")
def loose(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Database]:
    """A record whose tables take anything, with a row in each."""
    place = RecordsPlace.local(tmp_path_factory.mktemp("loose"))
    open_records(place, Author("anna", "desk")).close()
    with closing(sqlite3.connect(place.database_file, isolation_level=None)) as database:
        loosen(database)
    made = Database(place)
    yield made
    made.close()


def loosen(database: sqlite3.Connection) -> None:
    database.execute("PRAGMA foreign_keys = OFF")
    for (name,) in database.execute(
        "SELECT name FROM sqlite_master WHERE type = 'trigger'"
    ).fetchall():
        database.execute(f'DROP TRIGGER "{name}"')
    for table in schema.metadata.sorted_tables:
        columns = ", ".join(f'"{column.name}"' for column in table.columns)
        database.execute(f'DROP TABLE "{table.name}"')
        database.execute(f'CREATE TABLE "{table.name}" ({columns})')


def fill(place: RecordsPlace, table: Table, column: Column[Any], cell: object) -> None:
    with closing(sqlite3.connect(place.database_file)) as database:
        database.execute(f'DELETE FROM "{table.name}"')
        database.execute(f'INSERT INTO "{table.name}" ("{column.name}") VALUES (?)', [cell])
        database.commit()


def test_a_cell_that_holds_nothing_or_bytes_is_told_with_its_column(loose: Database) -> None:
    for table, column in COLUMNS:
        for cell in (None, b"\xff\x00"):
            if cell is None and column.nullable:
                continue
            fill(loose.place, table, column, cell)
            for transaction in (loose.reading, loose.writing):
                with (
                    pytest.raises(RecordsError, match="cannot be read") as told,
                    transaction() as c,
                ):
                    c.execute(select(column)).all()
                assert str(column) in str(told.value)


def test_a_moment_that_is_none_is_told_as_damage(loose: Database) -> None:
    assert day_of("2026-11-20T10:00:00.000000Z").isoformat() == "2026-11-20"
    with pytest.raises(RecordsError, match="cannot be read"), loose.reading():
        day_of("-92233720368")
