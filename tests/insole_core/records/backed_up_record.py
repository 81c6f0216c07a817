"""A small record with something in every kind of row, and its backup."""

from __future__ import annotations

import shutil
from datetime import date
from pathlib import Path
from typing import Any

import pyrage
from sqlalchemy import insert, select

from insole_core.records import schema
from insole_core.records.author import Author
from insole_core.records.backup.portable_rows import tables_of
from insole_core.records.content_store import ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.migrate import SCHEMA
from insole_core.records.place import RecordsPlace
from insole_core.records.row_report import seal_everything
from insole_core.records.signing import sign

ANNA = Author("anna", "desk")
IDENTITY = pyrage.x25519.Identity.generate()
SECRET, RECIPIENT = str(IDENTITY), str(IDENTITY.to_public())
"""A private key of age: a passphrase takes a second each time, by design."""
TIMES = {"created_at": "2026-11-22T10:00:00", "changed_at": "2026-11-22T10:00:00", "revision": 1}
STRANGE = "Zoë \u202e O'Brien\n; DROP TABLE persons; -- مريم 李"
MESH, SESSION = b"solid left foot" * 5000, bytes(range(256)) * 2000


def context_of(place: RecordsPlace) -> RecordsContext:
    database = Database(place)
    database.schema = SCHEMA
    return RecordsContext(database, ContentStore(place.contents), ANNA)


def make_record(empty: Path, folder: Path) -> RecordsContext:
    """Make a record in a folder that does not exist yet."""
    place = RecordsPlace.local(folder)
    folder.mkdir()
    shutil.copy(empty, place.database_file)
    context = context_of(place)
    mesh, session = context.contents.put(MESH), context.contents.put(SESSION)
    fill(context, mesh, session)
    return context


def fill(context: RecordsContext, mesh: str, session: str) -> None:
    person = {"search_text": "", **TIMES}
    rows: list[tuple[Any, dict[str, Any]]] = [
        (schema.contents, {"sha256": mesh, "size": len(MESH), "kind": "mesh",
                           "created_at": "2026-11-22"}),
        (schema.contents, {"sha256": session, "size": len(SESSION), "kind": "session",
                           "created_at": "2026-11-21"}),
        # The person that another was merged into was made later.
        (schema.persons, {"id": "kept", "name": STRANGE, "birth_date": date(1970, 2, 28),
                          "pseudonym": "26-A", **person, "created_at": "2026-11-23"}),
        (schema.persons, {"id": "merged", "name": "Eva", "pseudonym": "26-B",
                          "merged_into": "kept", "is_erased": False, **person}),
        (schema.visits, {"id": "v", "person_id": "kept", "visited_on": date(2026, 11, 22),
                         "weight_kg": 70.1, **TIMES}),
        (schema.captures, {"id": "c", "visit_id": "v", "kind": "session", "file_name": "s.zip",
                           "number": 1, "content_sha256": session, "program_version": "0.1",
                           "created_at": "2026", "author": "anna"}),
        (schema.prescription_versions, {
            "id": "left", "visit_id": "v", "side": "left", "number": 1, "document": '{"å": 0.1}',
            "mesh_sha256": mesh, "capture_id": "c", "author": "anna", "station": "desk",
            "program_version": "0.1", **TIMES,
        }),
        (schema.orders, {"id": "o", "number": "26-7KQ4M", "visit_id": "v", "person_id": "kept",
                         "state": "sent", "due_on": date(2026, 12, 24), **TIMES}),
        (schema.order_feet, {"order_id": "o", "prescription_version_id": "left"}),
        (schema.order_files, {"order_id": "o", "name": "left.stl", "content_sha256": mesh,
                              "size": len(MESH)}),
        (schema.clinic, {"key": "name", "value": '"Fotkliniken Åre"'}),
    ]  # fmt: skip
    with context.database.writing() as connection:
        for table, values in rows:
            connection.execute(insert(table).values(values))
        seal_everything(connection, context.author)
        context.log(connection, "added", "person", "kept")
        sign(connection, "left", context.author)


def add_person(context: RecordsContext, name: str) -> None:
    values = {"id": name, "name": name, "pseudonym": name, "search_text": "", **TIMES}
    with context.database.writing() as connection:
        connection.execute(insert(schema.persons).values(values))
        context.log(connection, "added", "person", name)


def _in_order(row: tuple[Any, ...]) -> tuple[int, str]:
    """Sort numbers by their size, and all else in any order that is always the same."""
    return (row[0] if isinstance(row[0], int) else 0, repr(row))


def all_rows(context: RecordsContext) -> dict[str, list[tuple[Any, ...]]]:
    """Return everything that the tables hold, in the order of the columns of new tables."""
    with context.database.reading() as connection:
        found = {}
        for table in tables_of(connection):
            known = schema.metadata.tables.get(table.name, table)
            rows = connection.execute(select(*(table.c[column.name] for column in known.columns)))
            found[table.name] = sorted(map(tuple, rows), key=_in_order)
        return found
