"""The record as it was before a newer program changed its tables: kept, and put back on request.

Beside a local database it is a file. On a server it is a schema of the same database, made in the
transaction that changes the tables. The large files are those of the record: no upgrade touches
them, and a program before this one opens the copy, too.
"""

from __future__ import annotations

import re
import sqlite3
from contextlib import closing, suppress
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from sqlalchemy import Connection, func, inspect, select, text

from insole_core.errors import OutputError, RecordsError
from insole_core.files.file_mode import PRIVATE_FILE
from insole_core.files.sync import sync
from insole_core.files.temporary import make_file, release, remove
from insole_core.files.write_errors import output_errors
from insole_core.records.backup.portable_rows import tables_of
from insole_core.records.database import MIGRATION_LOCK, Database
from insole_core.records.database_errors import busy
from insole_core.records.migrate import upgrade
from insole_core.records.rights import Right, require

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext

_OF_FILE: Final = re.compile(r".* until .* \(tables \d{4}\)")
_OF_SERVER: Final = re.compile(r"insole_studio_until_\d+_tables_(\d{4})")
_TRIES: Final = 10
_FUNCTIONS: Final = text(
    "SELECT DISTINCT p.proname FROM pg_trigger t JOIN pg_proc p ON p.oid = t.tgfoid "
    "JOIN pg_class c ON c.oid = t.tgrelid "
    "WHERE NOT t.tgisinternal AND c.relnamespace = to_regnamespace('public')"
)


class _Changed(Exception):  # noqa: N818 - nobody is told
    """Another station has changed the record since it was copied."""


def keep_copy(database: Database, connection: Connection, found: str) -> str:
    """Keep the record as it is, in the transaction that is about to change its tables.

    Parameters
    ----------
    found
        Revision of its tables.

    Returns
    -------
    str
        What the copy is called.

    Raises
    ------
    OutputError
        When the disk cannot take it; then the tables must stay as they are.
    """
    if not database.is_sqlite:
        return _copy_to_schema(connection, found)
    path = database.place.database_file
    moment = datetime.now(UTC).strftime("%Y-%m-%d %H.%M.%S.%f")
    copy = path.with_name(f"{path.stem} until {moment} (tables {found}){path.suffix}")
    _copy_file(path, copy)
    return copy.name


def copies_of(database: Database) -> list[str]:
    """Return what the copies are called that are kept, the oldest first."""
    if database.is_sqlite:
        path = database.place.database_file
        found = [p.name for p in path.parent.glob(f"*{path.suffix}") if _OF_FILE.fullmatch(p.stem)]
    else:
        with database.reading() as connection:
            found = [s for s in inspect(connection).get_schema_names() if _OF_SERVER.fullmatch(s)]
    return sorted(found)


def forget_copies(database: Database) -> None:
    """Remove all copies: they hold somebody who is erased."""
    for name in copies_of(database):
        if database.is_sqlite:
            path = database.place.database_file.with_name(name)
            with output_errors(path):
                remove(path)
        else:
            with database.writing() as connection:
                connection.execute(text(f'DROP SCHEMA "{name}" CASCADE'))


def put_back(context: RecordsContext, name: str) -> str:
    """Put a copy in the place of the record, and keep the record as another copy.

    Parameters
    ----------
    name
        Of one of `copies_of`.

    Returns
    -------
    str
        What the copy of the record until now is called.

    Raises
    ------
    NotAllowed
    RecordsError
        When there is no such copy.
    OutputError
        When it cannot be written. What was there is untouched.
    """
    database = context.database
    with database.reading() as connection:
        require(connection, context.author, Right.SET_UP)
    if name not in copies_of(database):
        raise RecordsError("There is no copy {name} of the record; choose one that is.", name=name)
    put_back_copy = _put_back_file if database.is_sqlite else _put_back_schema
    kept = put_back_copy(database, name)
    database.witness.forget()  # the log of the copy ends earlier
    return kept


def _put_back_file(database: Database, name: str) -> str:
    path = database.place.database_file
    with closing(sqlite3.connect(path)) as watch:
        for _ in range(_TRIES):
            before = _version(watch)
            with database.writing() as connection:
                found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
                kept = keep_copy(database, connection, str(found))
            with suppress(_Changed):
                _overwrite(path, name, watch, before)
                database.close()
                return kept
            remove(path.with_name(kept))
    raise busy(database.place)


def _overwrite(path: Path, name: str, watch: sqlite3.Connection, version: int) -> None:
    """Put a copy in the place of a database, in one transaction.

    Raises
    ------
    _Changed
        When the database has another version; then nothing is changed.
    OutputError
    """
    checks = [partial(_check_unchanged, watch, version)]

    def look(*_pages: int) -> None:
        if checks:  # after the first page: from now on nobody else can write
            checks.pop()()

    try:
        with (
            closing(sqlite3.connect(path.with_name(name))) as source,
            closing(sqlite3.connect(path)) as target,
        ):
            source.backup(target, pages=1, progress=look)
    except sqlite3.Error as error:
        raise OutputError(
            "The copy {copy} could not be put back ({reason}), so the record stays as it was; free "
            "some space, or choose another copy.",
            copy=name,
            reason=str(error),
        ) from error


def _version(watch: sqlite3.Connection) -> int:
    """Return a number that changes with every change of the database by others."""
    return int(watch.execute("PRAGMA data_version").fetchone()[0])


def _check_unchanged(watch: sqlite3.Connection, before: int) -> None:
    if _version(watch) != before:
        raise _Changed


def _copy_file(path: Path, copy: Path) -> None:
    """Copy a database that may be in use, and read the copy again."""
    with output_errors(copy):
        beside = make_file(copy.parent, copy)
    try:
        with (
            closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)) as source,
            closing(sqlite3.connect(beside)) as target,
        ):
            source.backup(target)
            target.execute("PRAGMA journal_mode=DELETE")
            told = target.execute("PRAGMA quick_check(1)").fetchone()[0]
        if told != "ok":
            raise sqlite3.DatabaseError(told)
        with output_errors(copy):
            beside.chmod(PRIVATE_FILE)
            sync(beside)
            beside.rename(copy)
            sync(copy.parent)
    except sqlite3.Error as error:
        raise OutputError(
            "The record could not be copied to {copy} before it is brought up to date ({reason}), "
            "so it stays as it was; free some space, and try again.",
            copy=copy,
            reason=str(error),
        ) from error
    finally:
        if beside.exists():
            remove(beside)
        release(beside)


def _copy_to_schema(connection: Connection, found: str) -> str:
    name = _schema_name(found)
    connection.execute(text(f'CREATE SCHEMA "{name}"'))
    for table in inspect(connection).get_table_names():
        connection.execute(text(f'CREATE TABLE "{name}"."{table}" AS TABLE public."{table}"'))
    return name


def _put_back_schema(database: Database, name: str) -> str:
    """Move the tables of now to a schema of their own, make those of before, and fill them."""
    with database.writing() as connection:
        connection.execute(select(func.pg_advisory_xact_lock(MIGRATION_LOCK)))
        found = str(connection.execute(text("SELECT version_num FROM alembic_version")).scalar())
        kept = _schema_name(found)
        functions = connection.execute(_FUNCTIONS).scalars().all()
        connection.execute(text(f'CREATE SCHEMA "{kept}"'))
        for moved in inspect(connection).get_table_names():
            connection.execute(text(f'ALTER TABLE public."{moved}" SET SCHEMA "{kept}"'))
        for function in functions:
            connection.execute(text(f'ALTER FUNCTION public."{function}"() SET SCHEMA "{kept}"'))
        before = _OF_SERVER.fullmatch(name)
        assert before is not None
        upgrade(connection, before[1])
        for table in tables_of(connection):
            columns = ", ".join(f'"{column.name}"' for column in table.columns)
            rows = f'SELECT {columns} FROM "{name}"."{table.name}"'
            insertion = f'INSERT INTO public."{table.name}" ({columns}) {rows}'
            connection.execute(text(f"{insertion} ON CONFLICT DO NOTHING"))
        connection.execute(
            text(
                "UPDATE public.audit_head AS now SET seq = before.seq, hash = before.hash "
                f'FROM "{name}".audit_head AS before '
                "WHERE now.id = before.id AND now.seq < before.seq"
            )
        )
    return kept


def _schema_name(found: str) -> str:
    return f"insole_studio_until_{datetime.now(UTC):%Y%m%d%H%M%S%f}_tables_{found}"
