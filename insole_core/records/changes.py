"""What other stations have changed; a window asks once a second."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from sqlalchemy import select

from insole_core.records.context import RecordsContext
from insole_core.records.schema import audit, audit_head

_MOST: Final = 1000
_LOOKED_AT: Final = "seen"


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
