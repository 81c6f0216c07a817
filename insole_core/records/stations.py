"""What other stations do: which visit they have open, and what they have changed."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Final

from sqlalchemy import Connection, delete, func, select

from insole_core.records.author import TIME_FORMAT, utc_now
from insole_core.records.context import RecordsContext
from insole_core.records.database import upsert
from insole_core.records.rights import Right
from insole_core.records.schema import audit, audit_head, presence

STALE_S: Final = 90.0
"""A station that has not said so for so long has left, or was switched off.

The same holds for one that has said so in the future, before a clock was put back.
"""

_MOST: Final = 1000
_LOOKED_AT: Final = "seen"


@dataclass(frozen=True)
class Present:
    """Somebody who has a visit open.

    Parameters
    ----------
    since
        UTC.
    """

    visit_id: str
    author: str
    station: str
    since: str


class Presence:
    """Says and asks who has a visit open; it hinders nobody, and is not in the audit log."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def enter(self, visit_id: str) -> list[Present]:
        """Say that this station has a visit open; return who else has.

        Call it again at least every minute.
        """
        author = self._context.author
        with self._context.writing(Right.SEE) as connection:
            now = self._now(connection)
            row = {
                "visit_id": visit_id,
                "station": author.station,
                "author": author.name,
                "since": now,
                "seen_at": now,
            }
            upsert(connection, presence, row, ["seen_at"])
        return self.others(visit_id)

    def leave(self, visit_id: str) -> None:
        """Say that this station has closed a visit."""
        author = self._context.author
        with self._context.writing(Right.SEE) as connection:
            connection.execute(
                delete(presence).where(
                    presence.c.visit_id == visit_id,
                    presence.c.station == author.station,
                    presence.c.author == author.name,
                )
            )

    def others(self, visit_id: str) -> list[Present]:
        """Return who else has a visit open, the longest first."""
        with self._context.reading() as connection:
            return self.others_within(connection, visit_id)

    def others_within(self, connection: Connection, visit_id: str) -> list[Present]:
        """Do the same as `others` within a transaction."""
        author = self._context.author
        return [
            present
            for present in self._present(connection, visit_id)
            if (present.author, present.station) != (author.name, author.station)
        ]

    def _present(self, connection: Connection, visit_id: str) -> list[Present]:
        now = datetime.strptime(self._now(connection), TIME_FORMAT)
        first, last = (
            (now + timedelta(seconds=seconds)).strftime(TIME_FORMAT)
            for seconds in (-STALE_S, STALE_S)
        )
        is_recent = presence.c.seen_at.between(first, last)
        query = select(
            presence.c.visit_id, presence.c.author, presence.c.station, presence.c.since
        ).where(presence.c.visit_id == visit_id, is_recent)
        rows = connection.execute(query.order_by(presence.c.since)).all()
        return [Present(**row._mapping) for row in rows]

    def _now(self, connection: Connection) -> str:
        """Return the time by the one clock that all stations share: that of the server."""
        if self._context.database.is_sqlite:
            return utc_now()
        now: datetime = connection.execute(
            select(func.timezone("UTC", func.clock_timestamp()))
        ).scalar_one()
        return now.strftime(TIME_FORMAT)


@dataclass(frozen=True)
class Change:
    """One line of the audit log that tells of a change.

    Parameters
    ----------
    is_mine
        Whether this author has made it, at this station.
    """

    seq: int
    action: str
    subject_kind: str
    subject_id: str
    author: str
    station: str
    is_mine: bool


@dataclass(frozen=True)
class Changes:
    """Changes since a mark.

    Parameters
    ----------
    mark
        To ask for what comes after them.
    has_more
        Whether there are so many that lists should be read anew, and not be brought up to date.
    """

    mark: int
    changes: tuple[Change, ...]
    has_more: bool = False


class ChangeFeed:
    """Reads what has changed."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def mark(self) -> int:
        """Return the mark of now."""
        with self._context.database.reading() as connection:
            return int(connection.execute(select(audit_head.c.seq)).scalar_one())

    def since(self, mark: int) -> Changes:
        """Return what has changed since a mark, in the order in which it happened."""
        query = (
            select(
                audit.c.seq,
                audit.c.action,
                audit.c.subject_kind,
                audit.c.subject_id,
                audit.c.author,
                audit.c.station,
            )
            .where(audit.c.seq > mark)
            .order_by(audit.c.seq)
            .limit(_MOST)
        )
        with self._context.database.reading() as connection:
            head = connection.execute(select(audit_head.c.seq)).scalar_one()
            rows = connection.execute(query).all()
        me = (self._context.author.name, self._context.author.station)
        changes = tuple(
            Change(**row._mapping, is_mine=(row.author, row.station) == me)
            for row in rows
            if row.action != _LOOKED_AT
        )
        return Changes(head, changes, has_more=len(rows) == _MOST)
