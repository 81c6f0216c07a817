"""An open record of the clinic."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from insole_core.messages import Message
from insole_core.records.accounts import Accounts
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author
from insole_core.records.captures import Captures
from insole_core.records.changes import ChangeFeed, Changes
from insole_core.records.clinic import ClinicSettings
from insole_core.records.content_store import ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.follow_ups import FollowUps
from insole_core.records.orders import Orders
from insole_core.records.persons import Persons
from insole_core.records.photos import Photos
from insole_core.records.place import RecordsPlace
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.presence import Presence
from insole_core.records.visits import Visits


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
