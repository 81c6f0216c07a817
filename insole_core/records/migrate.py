"""Bring a database to the tables that this program writes, and put back the record from before."""

from __future__ import annotations

import platform
import re
import sqlite3
from collections.abc import Callable
from contextlib import closing, suppress
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final, TypeAlias

from sqlalchemy import Connection, func, inspect, select, text

from insole_core.errors import OutputError, RecordsError
from insole_core.files.file_safety import PRIVATE_FILE, sync
from insole_core.files.temporary import make_file, release, remove
from insole_core.files.write_errors import output_errors
from insole_core.records.author import Author
from insole_core.records.backup.portable_rows import tables_of
from insole_core.records.database import MIGRATION_LOCK, SCHEMA_COLUMN, SCHEMA_TABLE, Database
from insole_core.records.database_errors import busy
from insole_core.records.rights import Right, require
from insole_core.records.row_report import seal_everything

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext

SCHEMA: Final = "0006"
"""The newest revision in `migrations/versions`; revisions are numbered."""
_FIRST_SEALED: Final = "0004"
"""From which on the audit log keeps digests of rows."""
PROGRAM: Final = "Insole Studio"
"""Author of what the program does by itself."""
_REVISION: Final = re.compile(r"000[1-9]|00[1-9]\d|0[1-9]\d\d|[1-9]\d{3}")
Keep: TypeAlias = Callable[[Database, Connection, str], None]

_OF_FILE: Final = re.compile(r".* until .* \(tables \d{4}\)")
_OF_SERVER: Final = re.compile(r"insole_studio_until_\d+_tables_(\d{4})")
_TRIES: Final = 10
_FUNCTIONS: Final = text(
    "SELECT DISTINCT p.proname FROM pg_trigger t JOIN pg_proc p ON p.oid = t.tgfoid "
    "JOIN pg_class c ON c.oid = t.tgrelid "
    "WHERE NOT t.tgisinternal AND c.relnamespace = to_regnamespace('public')"
)


def schema_of(connection: Connection) -> str | None:
    """Return the revision of a database; None where it has no tables yet."""
    if not inspect(connection).has_table(SCHEMA_TABLE.name):
        return None
    row = connection.execute(select(SCHEMA_COLUMN)).first()
    return None if row is None else str(row[0])


def check_schema(found: str | None, name: str) -> None:
    """Raise a `RecordsError` if a database comes from a newer program, or from none."""
    if found is None:
        return
    if _REVISION.fullmatch(found) is None:
        raise RecordsError(
            "{place} has tables of which no Insole Studio knows ({found}); name another record, or "
            "restore this one from a backup.",
            place=name,
            found=found,
        )
    if found > SCHEMA:
        raise RecordsError(
            "{place} was made by a newer Insole Studio (tables {found}; this program knows them up "
            "to {newest}); install the newest version.",
            place=name,
            found=found,
            newest=SCHEMA,
        )


def migrate(database: Database, schema: str = SCHEMA, keep: Keep | None = None) -> bool:
    """Make the tables of an empty database, or change those of an older one.

    All is one transaction: an interrupted migration leaves the database as it was, and the next
    start makes it anew. Of two programs that start at once, one migrates, and the other waits.

    Parameters
    ----------
    schema
        Revision to bring it to: an older one only for the rows of an older backup.
    keep
        Called before the tables of an older record are changed, in the same transaction.

    Returns
    -------
    bool
        Whether anything was changed.

    Raises
    ------
    RecordsError
        When the database is newer than this program, or cannot be changed.
    """
    with database.reading() as connection:
        found = schema_of(connection)
    check_schema(found, database.place.name)
    if found == schema:
        return False
    with database.writing() as connection:
        if not database.is_sqlite:
            connection.execute(select(func.pg_advisory_xact_lock(MIGRATION_LOCK)))
        found = schema_of(connection)
        check_schema(found, database.place.name)
        if found is None and database.is_sqlite and inspect(connection).get_table_names():
            raise RecordsError(
                "{place} is the database of another program; name the folder of a record.",
                place=database.place.name,
            )
        if keep is not None and found is not None and found != schema:
            keep(database, connection, found)
        upgrade(connection, schema)
        if found is not None and found < _FIRST_SEALED and schema == SCHEMA:
            seal_everything(connection, Author(PROGRAM, platform.node() or "?"))
    return found != schema


def upgrade(connection: Connection, schema: str) -> None:
    """Bring the tables that a transaction sees to a revision."""
    # Alembic takes half a second to load, and most starts find nothing to migrate.
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", "insole_core.records:migrations")
    config.attributes["connection"] = connection
    command.upgrade(config, schema)


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
            connection.execute(
                text(
                    f'INSERT INTO public."{table.name}" ({columns}) SELECT {columns} '
                    f'FROM "{name}"."{table.name}" ON CONFLICT DO NOTHING'
                )
            )
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
