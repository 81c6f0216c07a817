"""An open record of the clinic; its database is made, or brought to the tables of this program."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from sqlalchemy import Connection, Table, func, or_, select, text

from insole_core.errors import InsoleError, RecordsError
from insole_core.files.atomic import make_output_folder
from insole_core.files.file_safety import PRIVATE_FILE
from insole_core.files.temporary import remove
from insole_core.files.write_errors import output_errors
from insole_core.messages import Message
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author
from insole_core.records.captures import Captures
from insole_core.records.clinic import ClinicSettings, setting_of, write_setting
from insole_core.records.content_store import IDENTITY_VALUE, ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database, check_not_lost
from insole_core.records.database_errors import DamagedDatabase
from insole_core.records.deleted_text import finish_erasing
from insole_core.records.migrate import SCHEMA, check_schema, keep_copy, migrate, schema_of
from insole_core.records.orders import Orders
from insole_core.records.persons import Persons
from insole_core.records.photos import Photos
from insole_core.records.place import RecordsPlace
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.schema import (
    audit_head,
    clinic,
    metadata,
    persons,
    prescription_versions,
    visits,
)
from insole_core.records.stations import ChangeFeed, Changes, Presence
from insole_core.records.visits import FollowUps, Visits

log = logging.getLogger(__name__)

_NEEDED: Final = (persons, visits, prescription_versions, clinic)
"""Without these there is nothing to read."""
_IS_READ_ONLY: Final = select(
    or_(
        func.pg_is_in_recovery(),
        func.current_setting("default_transaction_read_only") == "on",
    )
)


class Records:
    """The parts of an open record; all of them may be called from any thread.

    Parameters
    ----------
    database
        With the tables of this program.
    who
        Author of all changes.
    """

    def __init__(self, database: Database, contents: ContentStore, who: Author) -> None:
        self._database = database
        self.who = who
        context = RecordsContext(database, contents, who)
        self.context = context
        self.contents = contents
        self.persons = Persons(context)
        self.prescriptions = Prescriptions(context)
        self.visits = Visits(context, self.prescriptions)
        self.captures = Captures(context)
        self.photos = Photos(context)
        self.orders = Orders(context)
        self.follow_ups = FollowUps(context)
        self.presence = Presence(context)
        self.clinic = ClinicSettings(context)
        self.audit = AuditLog(database, who)
        self.accounts = Accounts(database, who)
        self._changes = ChangeFeed(context)

    @property
    def place(self) -> RecordsPlace:
        """Where the record is."""
        return self._database.place

    @property
    def is_read_only(self) -> bool:
        """Whether nothing can be changed."""
        return self._database.is_read_only

    @property
    def problem(self) -> Message | None:
        """Why nothing can be changed, in one sentence; None where everything can."""
        return self._database.problem

    @property
    def upgrade(self) -> Message | None:
        """That the record was brought up to date as it was opened, and what was kept of before."""
        copy = self._database.upgraded_from
        if copy is None:
            return None
        return Message(
            "The record was brought up to date; as it was before, it is kept as “{copy}”.",
            copy=copy,
        )

    def for_author(self, who: Author) -> Records:
        """Return the same record for somebody else who has signed in at this station.

        Both have the same connections; close one of them.
        """
        return Records(self._database, self.contents, who)

    @contextmanager
    def snapshot(self) -> Iterator[None]:
        """Let all that this thread reads meanwhile see the same moment, which is faster as well.

        What it writes meanwhile is not seen by these readings.

        Raises
        ------
        RecordsError
            Whatever goes wrong in the database.
        """
        with self._database.snapshot():
            yield

    def mark(self) -> int:
        """Return the mark of now, for `changes_since`."""
        return self._changes.mark()

    def changes_since(self, mark: int) -> Changes:
        """Return what any station has changed since a mark."""
        return self._changes.since(mark)

    def close(self) -> None:
        """Close all connections; the record cannot be used any more."""
        self._database.close()


def open_records(place: RecordsPlace, who: Author) -> Records:
    """Open the record of a place.

    A local one is made if there is none. Before the tables of an older one are changed, a copy of
    it is kept; `Records.upgrade` says where. Where it may not be written, or is damaged, it is
    opened for reading only, as far as that goes; `Records.problem` says why.

    Raises
    ------
    RecordsError
        When it comes from a newer program, is damaged, has lost its database, or does not answer.
    OutputError
        When a new one cannot be made.
    """
    check_not_lost(place)
    if place.is_local and not place.database_file.exists():
        _make_file(place.database_file)
    database = Database(place, problem=_why_read_only(place))
    try:
        if not place.is_local:
            database.problem = _why_server_read_only(database)
        try:
            if not database.is_read_only:
                _migrate(database)
            _check_tables(database, metadata.sorted_tables)
        except DamagedDatabase as error:
            database.close()
            database = Database(place, problem=error.message)
            _check_tables(database, _NEEDED)
        database.schema = SCHEMA
        if database.upgraded_from is not None:
            database.note_head()  # an older program may have noted nothing
        if not database.is_read_only:
            _finish_erasing(database)
        return Records(database, _content_store(database), who)
    except BaseException:
        database.close()
        raise


def _finish_erasing(database: Database) -> None:
    """Go on where a program was stopped after it had erased somebody; the record opens anyway."""
    try:
        finish_erasing(database)
    except InsoleError as error:
        log.warning("an erasure is not finished: %s", error)


def _migrate(database: Database) -> None:
    """Bring the tables up to date; where that fails, no copy is left of what stays as it is."""
    try:
        migrate(database, keep=_keep)
    except BaseException:
        if database.is_sqlite and database.upgraded_from is not None:
            remove(database.place.database_file.with_name(database.upgraded_from))
        raise


def _keep(database: Database, connection: Connection, found: str) -> None:
    database.upgraded_from = keep_copy(database, connection, found)


def _make_file(path: Path) -> None:
    """Make an empty file that only its owner may read; another program may be as quick."""
    make_output_folder(path.parent)
    with output_errors(path):
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, PRIVATE_FILE))


def _why_read_only(place: RecordsPlace) -> Message | None:
    file = place.database_file
    if not place.is_local or (os.access(file, os.W_OK) and os.access(file.parent, os.W_OK)):
        return None
    return Message("{file} may only be read by you; ask for the right to write to it.", file=file)


def _why_server_read_only(database: Database) -> Message | None:
    """Ask a server whether it takes changes: one that stands by for another one does not."""
    with database.reading() as connection:
        is_read_only = connection.execute(_IS_READ_ONLY).scalar_one()
    if not is_read_only:
        return None
    return Message(
        "{place} takes no changes, as a server that stands by for another one; check the address "
        "of the database, or ask whoever looks after it.",
        place=database.place.name,
    )


def _check_tables(database: Database, tables: Sequence[Table]) -> None:
    """Check that the database has the tables of this program, and that some can be read."""
    name = database.place.name
    with database.reading() as connection:
        found = schema_of(connection)
        check_schema(found, name)
        if found != SCHEMA:
            raise RecordsError(
                "{place} comes from an older Insole Studio and cannot be brought up to date, since "
                "it may only be read; ask for the right to write to it.",
                place=name,
            )
        quote = connection.dialect.identifier_preparer.quote
        for table in tables:  # as text: to compile all these statements takes longer than to ask
            columns = ", ".join(map(quote, table.columns.keys()))
            connection.execute(text(f"SELECT {columns} FROM {quote(table.name)} LIMIT 1")).first()


def _content_store(database: Database) -> ContentStore:
    """Return the store that belongs to a database; the first time, take the one that is there."""
    with database.reading() as connection:
        identity = setting_of(connection, IDENTITY_VALUE)
    folder = database.place.contents
    if identity is None and not database.is_read_only:
        with database.writing() as connection:
            connection.execute(select(audit_head).with_for_update())  # one station after the other
            identity = setting_of(connection, IDENTITY_VALUE)
            if identity is None:
                identity = ContentStore(folder).identity()
                write_setting(connection, IDENTITY_VALUE, identity)
    return ContentStore(folder, identity)
