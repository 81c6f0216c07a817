"""A database that another program has made or changed: a sentence, and nothing left behind."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from datetime import date
from pathlib import Path

import pytest
from sqlalchemy import select

from insole_core.errors import InsoleError, NotAllowed, RecordsError
from insole_core.records.audit import head_of
from insole_core.records.author import Author
from insole_core.records.context import RecordsContext
from insole_core.records.person import Person
from insole_core.records.place import DATABASE_FILE, RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.schema import persons, visits
from insole_core.records.visit import Visit

WHO = Author("anna", "desk")
PASSWORD = "correct horse battery"
DAY = date(2026, 11, 22)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("made")
    with closing(open_records(RecordsPlace.local(folder), WHO)) as records:
        person = records.persons.add(Person(name="Anna Ek", birth_date=date(1970, 1, 1)))
        records.visits.add(Visit(person_id=person.id, visited_on=DAY))
        records.accounts.switch_on("chief", "Chief", PASSWORD)
    with closing(sqlite3.connect(folder / DATABASE_FILE)) as database:
        database.executescript("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE")
    return (folder / DATABASE_FILE).read_bytes()


@pytest.fixture
def folder(made: bytes, tmp_path: Path) -> Path:
    (tmp_path / DATABASE_FILE).write_bytes(made)
    return tmp_path


def change(folder: Path, *statements: str) -> None:
    with closing(sqlite3.connect(folder / DATABASE_FILE)) as database:
        found = database.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for (name,) in found:
            database.execute(f'DROP TRIGGER "{name}"')
        for statement in statements:
            database.execute(statement)
        database.commit()


def opened(folder: Path) -> Records:
    return open_records(RecordsPlace.local(folder), WHO)


TABLES = {
    "newer": ("9999", "was made by a newer Insole Studio"),
    "none": ("0000", "no Insole Studio knows"),
    "empty": ("", "no Insole Studio knows"),
    "a word": ("head", "no Insole Studio knows"),
    "a number": (7, "no Insole Studio knows"),
    "bytes": (b"\xff", "no Insole Studio knows"),
    "older than they are": ("0002", "refused what was to be written"),
}


@pytest.mark.parametrize("case", TABLES)
def test_tables_of_no_known_version_are_refused_and_nothing_is_left(
    folder: Path, case: str
) -> None:
    version, words = TABLES[case]
    with closing(sqlite3.connect(folder / DATABASE_FILE)) as database:
        database.execute("UPDATE alembic_version SET version_num = ?", [version])
        database.commit()
    before = sorted(folder.iterdir())
    with pytest.raises(RecordsError, match=words):
        opened(folder)
    assert sorted(folder.iterdir()) == before


def test_the_database_of_another_program_stays_as_it_is(tmp_path: Path) -> None:
    with closing(sqlite3.connect(tmp_path / DATABASE_FILE)) as database:
        database.execute("CREATE TABLE urls (id INTEGER PRIMARY KEY)")
    with pytest.raises(RecordsError, match="database of another program"):
        opened(tmp_path)
    with closing(sqlite3.connect(tmp_path / DATABASE_FILE)) as database:
        found = database.execute("SELECT name FROM sqlite_master").fetchall()
    assert found == [("urls",)]


def sign_in(records: Records) -> object:
    return records.accounts.sign_in("chief", PASSWORD)


def search(records: Records) -> object:
    return records.persons.search("", 5)


def open_visit(records: Records) -> object:
    with records.context.database.reading() as connection:
        visit_id = connection.execute(select(visits.c.id)).scalar_one()
    return records.visits.open_case(visit_id)


def head_of_log(records: Records) -> object:
    with records.context.database.reading() as connection:
        return head_of(connection)


def erase(records: Records) -> object:
    chief = records.accounts.sign_in("chief", PASSWORD)
    context = RecordsContext(records.context.database, records.contents, chief)
    with context.database.reading() as connection:
        person_id = connection.execute(select(persons.c.id)).scalar_one()
    return erase_person(context, person_id, ErasureReason.REQUEST, DAY)


CELLS: dict[str, tuple[str, Callable[[Records], object]]] = {
    "birth date": (
        "UPDATE persons SET birth_date = '9999-99-99'", search,
    ),
    "birth date as bytes": (
        "UPDATE persons SET birth_date = x'ff00'", search,
    ),
    "day": ("UPDATE visits SET visited_on = ''", lambda records: records.visits.work_list()),
    "state": (
        "UPDATE visits SET capture_state = 'gone'", lambda records: records.visits.on(DAY),
    ),
    "state of a visit that is changed": (
        "UPDATE visits SET capture_state = 'gone'", open_visit,
    ),
    "measures of a visit that is changed": ("UPDATE visits SET measures = '{'", open_visit),
    "head of the log that is read": (
        "DELETE FROM audit_head", head_of_log,
    ),
    "head of the log that is written": (
        "DELETE FROM audit_head", open_visit,
    ),
    "moment of a person who is erased": ("UPDATE persons SET created_at = 'noon'", erase),
    "setting": ("UPDATE clinic SET value = '{'", lambda records: records.accounts.are_on),
    "role": (
        "UPDATE accounts SET role = 'king'", sign_in,
    ),
    "failures": (
        "UPDATE accounts SET failures = 'x'", sign_in,
    ),
    "password": (
        "UPDATE accounts SET password_hash = x'00'",
        sign_in,
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CELLS)
def test_a_value_that_is_none_is_told_in_a_sentence(folder: Path, case: str) -> None:
    statement, read = CELLS[case]
    change(folder, statement)
    with pytest.raises(InsoleError) as told, closing(opened(folder)) as records:
        read(records)
    assert "cannot be read" in str(told.value) or told.type is NotAllowed
    assert str(told.value).endswith(".")
