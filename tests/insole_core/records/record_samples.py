"""Records with the tables of every revision, as the programs of that time have written them.

`PYTHONPATH=. python tests/insole_core/records/record_samples.py` writes those of the newest tables:
the samples of the revision before, brought to them by this program.
"""

from __future__ import annotations

import re
import sqlite3
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from postgres_server import PostgresServer, running_server
from stations import make_tables

from insole_core.records.migrate import SCHEMA
from insole_core.records.place import RecordsPlace

SCHEMAS = Path(__file__).parent / "schemas"
_OF_THE_SERVER = re.compile(
    r"^(\\.*\n\n?|(-- Dumped |SELECT pg_catalog\.set_config|SET transaction_timeout).*\n)",
    re.MULTILINE,
)
"""Lines of a dump that only its version of PostgreSQL knows, or that leave no schema to look in."""


def place_of_sample(
    revision: str, kind: str, folder: Path, request: pytest.FixtureRequest
) -> RecordsPlace:
    """Make a record with a person, Anna Berg, and a visit; kind is "sqlite" or "postgresql"."""
    if kind == "sqlite":
        return _in_file(revision, folder)
    return _on_server(revision, folder, request.getfixturevalue("postgres"))


def _in_file(revision: str, folder: Path) -> RecordsPlace:
    place = RecordsPlace.local(folder)
    with closing(sqlite3.connect(place.database_file)) as connection:
        connection.executescript((SCHEMAS / f"{revision}.sqlite.sql").read_text("utf-8"))
    return place


def _on_server(revision: str, folder: Path, server: PostgresServer) -> RecordsPlace:
    server.execute("DROP DATABASE IF EXISTS sample")
    server.execute("CREATE DATABASE sample")
    script = (SCHEMAS / f"{revision}.postgresql.sql").read_text("utf-8")
    server.execute(script, database="sample")
    return RecordsPlace.of_url(server.url("sample"), folder / "contents")


def write_newest(schemas: Path, server: PostgresServer) -> None:
    """Write the samples of the newest tables, one of each database."""
    before = f"{int(SCHEMA) - 1:04}"
    with TemporaryDirectory() as made:
        folder = Path(made)
        place = _in_file(before, folder)
        make_tables(place)
        with closing(sqlite3.connect(place.database_file)) as connection:
            script = "\n".join(connection.iterdump()) + "\n"
        (schemas / f"{SCHEMA}.sqlite.sql").write_text(script, "utf-8")
        make_tables(_on_server(before, folder, server))
        dump = server.folder / "sample.sql"
        options = ("--no-owner", "--no-privileges", "--inserts", "-f", str(dump))
        server.run("pg_dump", "-h", str(server.folder), "-U", server.user, *options, "sample")
        script = _OF_THE_SERVER.sub("", dump.read_text("utf-8"))
        (schemas / f"{SCHEMA}.postgresql.sql").write_text(script, "utf-8")


if __name__ == "__main__":
    with running_server() as started:
        write_newest(SCHEMAS, started)
