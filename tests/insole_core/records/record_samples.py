"""Records with the tables of every revision, as the programs of that time have written them."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from postgres_server import PostgresServer

from insole_core.records.place import RecordsPlace

SCHEMAS = Path(__file__).parent / "schemas"


def place_of_sample(
    revision: str, kind: str, folder: Path, request: pytest.FixtureRequest
) -> RecordsPlace:
    """Make a record with a person, Anna Berg, and a visit; kind is "sqlite" or "postgresql"."""
    script = (SCHEMAS / f"{revision}.{kind}.sql").read_text("utf-8")
    if kind == "sqlite":
        place = RecordsPlace.local(folder)
        with closing(sqlite3.connect(place.database_file)) as connection:
            connection.executescript(script)
        return place
    server: PostgresServer = request.getfixturevalue("postgres")
    server.execute("DROP DATABASE IF EXISTS sample")
    server.execute("CREATE DATABASE sample")
    server.execute(script, database="sample")
    return RecordsPlace.of_url(server.url("sample"), folder / "contents")
