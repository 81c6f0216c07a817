"""Connections and transactions of the record, in SQLite and PostgreSQL."""

from __future__ import annotations

import os
import sqlite3
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from json import JSONDecodeError
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Table, column, create_engine, event, func, select, table
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.engine import Engine
from sqlalchemy.exc import DBAPIError, NoResultFound
from sqlalchemy.exc import TimeoutError as PoolTimeoutError
from sqlalchemy.pool import QueuePool

from insole_core.errors import RecordsError
from insole_core.messages import Message
from insole_core.records.checked_values import NoValue
from insole_core.records.content_store import IDENTITY_FILE
from insole_core.records.database_errors import (
    DamagedDatabase,
    busy,
    damaged,
    described,
    unreadable,
)
from insole_core.records.head_witness import HeadWitness
from insole_core.records.place import RecordsPlace

BUSY_S: Final = 10.0
"""How long to wait for another writer."""
MIGRATION_LOCK: Final = 1_502_600_001
"""Key of the advisory lock that keeps writers and a migration of PostgreSQL apart."""
SCHEMA_TABLE: Final = table("alembic_version", column("version_num"))
SCHEMA_COLUMN: Final = SCHEMA_TABLE.c.version_num
_WRITES: Final = "insole_studio_writes"
_NO_VALUE: Final = (
    ValueError, TypeError, OverflowError, RecursionError, LookupError, AttributeError,
    NoResultFound,
)  # fmt: skip
"""What a date, a word or a JSON text raises that is none, or one of another form; or a row that is
always there."""
_DAMAGED_CELL: Final = (NoValue, JSONDecodeError, NoResultFound)
"""The same, where other errors are those of whoever writes."""
_SERVER_ARGUMENTS: Final[dict[str, Any]] = {
    "connect_timeout": 10,
    "application_name": "insole-studio",
    # A server that has gone is noticed within half a minute, not within hours.
    "keepalives_idle": 10,
    "keepalives_interval": 5,
    "keepalives_count": 3,
    "tcp_user_timeout": 20_000,
    "options": f"-csynchronous_commit=on -clock_timeout={BUSY_S * 1000:.0f}",
}


class Database:
    """A database whose transactions are durable, and whose errors are sentences.

    Parameters
    ----------
    problem
        Why nothing can be changed: a local file is opened so that nothing of it changes. Damage
        that is noticed later on has the same effect. None where everything can be changed.
    """

    def __init__(self, place: RecordsPlace, *, problem: Message | None = None) -> None:
        self.place = place
        self.problem = problem
        self.schema: str | None = None
        """Revision of the schema that this program writes; None does not check it."""
        self.upgraded_from: str | None = None
        """What the copy is called that was kept when this program changed the tables."""
        self._is_closed = False
        self._snapshots = threading.local()
        self.witness = HeadWitness(place.contents)
        self.engine = _engine(place, self.is_read_only)

    @property
    def is_read_only(self) -> bool:
        """Whether nothing can be changed."""
        return self.problem is not None

    @property
    def is_sqlite(self) -> bool:
        """Whether the database is a file of this computer."""
        return self.place.is_local

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """Yield a connection whose statements all see the same moment.

        Raises
        ------
        RecordsError
            Whatever goes wrong in the database, as a sentence.
        """
        shared: Connection | None = getattr(self._snapshots, "connection", None)
        if shared is not None:
            yield shared
            return
        options: dict[str, Any] = {}
        if not self.is_sqlite:
            options = {"isolation_level": "REPEATABLE READ", "postgresql_readonly": True}
        with self.understanding(), self._transaction(**options) as connection:
            yield connection

    @contextmanager
    def understanding(self) -> Iterator[None]:
        """Make values of what was read; a date, a word or a JSON text that is none is told as such.

        Raises
        ------
        RecordsError
        """
        with self._telling(_NO_VALUE):
            yield

    @contextmanager
    def _telling(self, kinds: tuple[type[Exception], ...]) -> Iterator[None]:
        try:
            yield
        except kinds as error:
            raise unreadable(self.place, error) from error

    @contextmanager
    def snapshot(self) -> Iterator[None]:
        """Let all that this thread reads meanwhile see the same moment, in one transaction.

        Raises
        ------
        RecordsError
            Whatever goes wrong in the database, as a sentence.
        """
        with self.reading() as connection:
            before = getattr(self._snapshots, "connection", None)
            self._snapshots.connection = connection
            try:
                yield
            finally:
                self._snapshots.connection = before

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """Yield a connection for one transaction; when the block ends, it is on the disk.

        Rows are locked in a fixed order, so that writers wait for each other and never in a ring:
        person, visit, prescription, order, and the head of the audit log last.

        Raises
        ------
        RecordsError
            Whatever goes wrong in the database, as a sentence; then nothing was written.
        """
        if self.problem is not None:
            raise RecordsError(
                "The record is open for reading only, so nothing can be changed: {reason}",
                reason=self.problem,
            )
        with self._telling(_DAMAGED_CELL), self._transaction(**{_WRITES: True}) as connection:
            self._check_schema(connection)
            yield connection
            head = None if self.schema is None else self.witness.coming(connection)
        if head is not None:
            self.witness.write(head)

    def note_head(self) -> None:
        """Note the last line of the audit log beside the files, where another log was before."""
        with self.reading() as connection:
            head = self.witness.coming(connection)
        if head is not None:
            self.witness.write(head)

    def close(self) -> None:
        """Close all connections; one that is in use is closed after its transaction."""
        self._is_closed = True
        self.engine.dispose()

    def _check_schema(self, connection: Connection) -> None:
        """Refuse to write where a newer program has changed the tables meanwhile."""
        if self.schema is None:
            return
        if not self.is_sqlite:
            connection.execute(select(func.pg_advisory_xact_lock_shared(MIGRATION_LOCK)))
        found = connection.execute(select(SCHEMA_COLUMN)).scalar()
        if found != self.schema:
            raise RecordsError(
                "A newer Insole Studio has changed {place} meanwhile; install the newest version "
                "on this computer, too.",
                place=self.place.name,
            )

    @contextmanager
    def _transaction(self, **options: Any) -> Iterator[Connection]:
        try:
            with self.engine.connect() as connection:
                connection.execution_options(**options)
                try:
                    with connection.begin():
                        yield connection
                finally:
                    if self._is_closed:
                        connection.detach()  # its pool, which is gone, would keep it open
        except DBAPIError as error:
            raise self._noted(described(self.place, error)) from error
        except PoolTimeoutError as error:
            raise busy(self.place) from error

    def _noted(self, error: RecordsError) -> RecordsError:
        """Write nothing more to a database that turns out to be damaged."""
        if isinstance(error, DamagedDatabase):
            self.problem = error.message
        return error


def check_not_lost(place: RecordsPlace) -> None:
    """Refuse a local place whose database is gone or empty, beside the files of its record.

    Only a database with tables gets files beside it, so that these are proof of it.

    Raises
    ------
    RecordsError
    """
    if not place.is_local or not (place.contents / IDENTITY_FILE).exists():
        return
    file = place.database_file
    if not file.exists():
        raise RecordsError(
            "The database {file} is missing, but the files of the record beside it are there; "
            "restore the record from a backup, or bring the database back to its place.",
            file=file,
        )
    if not any(map(_has_bytes, (file, file.with_name(f"{file.name}-wal")))):
        raise damaged(place)


def _has_bytes(path: Path) -> bool:
    return path.exists() and path.stat().st_size > 0


def upsert(
    connection: Connection, table: Table, values: Mapping[str, Any], changed: Sequence[str] = ()
) -> None:
    """Insert a row; where one with its key is there, change some of its columns.

    Parameters
    ----------
    changed
        Names of the columns that get the new value; without any, the row stays as it is.
    """
    dialect = sqlite if connection.dialect.name == "sqlite" else postgresql
    statement = dialect.insert(table).values(**values)
    if not changed:
        connection.execute(statement.on_conflict_do_nothing())
        return
    key = [column.name for column in table.primary_key]
    new = {name: statement.excluded[name] for name in changed}
    connection.execute(statement.on_conflict_do_update(index_elements=key, set_=new))


def _engine(place: RecordsPlace, read_only: bool) -> Engine:
    if not place.is_local:
        return create_engine(place.url, pool_pre_ping=True, connect_args=_SERVER_ARGUMENTS)
    engine = create_engine(
        "sqlite+pysqlite://",
        creator=lambda: _connect_file(place.database_file, read_only),
        poolclass=QueuePool,
    )
    event.listen(engine, "begin", _begin)
    return engine


def _connect_file(path: Path, read_only: bool) -> sqlite3.Connection:
    """Open a database that exists; SQLAlchemy begins its transactions."""
    connection = sqlite3.connect(
        f"{path.resolve().as_uri()}?{_mode(path, read_only)}",
        uri=True,
        timeout=BUSY_S,
        isolation_level=None,
        check_same_thread=False,
    )
    try:
        connection.execute("PRAGMA foreign_keys=ON")
        if read_only:
            connection.execute("PRAGMA query_only=ON")
        else:
            connection.execute("PRAGMA journal_mode=WAL")
            # Every commit is synced: WAL with NORMAL may lose the last ones with the power.
            connection.execute("PRAGMA synchronous=FULL")
            connection.execute("PRAGMA secure_delete=ON")  # else deleted text stays in the file
    except BaseException:
        connection.close()
        raise
    return connection


def _mode(path: Path, read_only: bool) -> str:
    if not read_only:
        return "mode=rw"
    if os.access(path.parent, os.W_OK) or path.with_name(f"{path.name}-wal").exists():
        return "mode=ro"
    return "mode=ro&immutable=1"  # the files that readers share cannot be made there


def _begin(connection: Connection) -> None:
    is_write = connection.get_execution_options().get(_WRITES, False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if is_write else "BEGIN")
