"""Looking into the audit log: who did what with whom, and when."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta
from typing import Any

from sqlalchemy import CompoundSelect, Connection, Select, func, select, union_all

from insole_core.errors import RecordsError
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import AuditLine, AuditLog, AuditReport
from insole_core.records.context import RecordsContext
from insole_core.records.rights import Right, require
from insole_core.records.schema import (
    accounts,
    audit,
    captures,
    follow_ups,
    orders,
    persons,
    prescription_versions,
    visits,
)
from insole_core.records.times import TIME_FORMAT


@dataclass(frozen=True)
class AuditFilter:
    """Which lines to show.

    Parameters
    ----------
    pseudonym
        Of the person that lines are about, also those about their visits, prescriptions and
        orders; empty for all persons.
    author
        Name of an account or user; empty for all.
    first_day, last_day
        By the clock of this computer; None for no limit.
    """

    pseudonym: str = ""
    author: str = ""
    first_day: date | None = None
    last_day: date | None = None


@dataclass(frozen=True)
class ShownLine:
    """A line of the log, with what its subject is called where nobody is named.

    Parameters
    ----------
    subject
        The pseudonym of a person, the name of an account; else the beginning of the id.
    """

    line: AuditLine
    subject: str


def search_audit(
    context: RecordsContext, wanted: AuditFilter, before: int | None = None, limit: int = 200
) -> list[ShownLine]:
    """Return the latest lines that pass a filter, newest first.

    Parameters
    ----------
    before
        Only lines with a smaller number: the next page.

    Raises
    ------
    NotAllowed
    RecordsError
        When nobody has the pseudonym.
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.READ_AUDIT)
        about = None
        if wanted.pseudonym:
            about = _all_of(_person_id(connection, wanted.pseudonym))
    lines = AuditLog(context.database).lines(
        about=about,
        author=wanted.author or None,
        times=_times(wanted.first_day, wanted.last_day),
        before=before,
        limit=limit,
    )
    with context.database.reading() as connection:
        names = _names(connection, {line.subject_id for line in lines})
    return [ShownLine(line, names.get(line.subject_id, line.subject_id[:8])) for line in lines]


def authors_of_audit(context: RecordsContext) -> list[str]:
    """Return everybody who has written a line, by name.

    Raises
    ------
    NotAllowed
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.READ_AUDIT)
        return _authors(connection)


def _authors(connection: Connection) -> list[str]:
    """Go from each author to the next one by the index: reading a million lines takes longer."""
    first = select(func.min(audit.c.author).label("author")).cte("authors", recursive=True)
    later = select(func.min(audit.c.author)).where(audit.c.author > first.c.author)
    found = first.union_all(select(later.scalar_subquery()).where(first.c.author.is_not(None)))
    query = select(found.c.author).where(found.c.author.is_not(None))
    return list(connection.execute(query).scalars())


def verify_audit(context: RecordsContext, progress: Progress = SILENT) -> AuditReport:
    """Verify the chain of the log for somebody who may read it.

    Raises
    ------
    NotAllowed
    Cancelled
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.READ_AUDIT)
    return AuditLog(context.database).verify(progress=progress)


def _person_id(connection: Connection, pseudonym: str) -> str:
    query = select(persons.c.id).where(persons.c.pseudonym == pseudonym.strip())
    found = connection.execute(query).scalar()
    if found is None:
        raise RecordsError(
            "Nobody has the pseudonym {pseudonym}; it stands on the patient's page and on papers "
            "for the shop.",
            pseudonym=pseudonym,
        )
    return str(found)


def _all_of(person_id: str) -> Select[Any]:
    """Return the query of the ids of a person and of all that hangs on them."""
    of_visits = select(visits.c.id).where(visits.c.person_id == person_id)
    parts: CompoundSelect[Any] = union_all(
        select(persons.c.id).where(
            (persons.c.id == person_id) | (persons.c.merged_into == person_id)
        ),
        of_visits,
        *(
            select(table.c.id).where(table.c.visit_id.in_(of_visits))
            for table in (captures, prescription_versions)
        ),
        *(
            select(table.c.id).where(table.c.person_id == person_id)
            for table in (orders, follow_ups)
        ),
    )
    return select(parts.subquery().c.id)


def _times(first_day: date | None, last_day: date | None) -> tuple[str, str] | None:
    """Return when the first day begins and the last one ends, as lines have it."""
    if first_day is None and last_day is None:
        return None
    ends = date.max if last_day is None or last_day >= date.max else last_day + timedelta(days=1)
    return (_begin(first_day or date.min), _begin(ends))


def _begin(day: date) -> str:
    try:
        moment = datetime.combine(day, time()).astimezone(UTC)
    except (OverflowError, ValueError, OSError):  # the first and last days that there are
        moment = datetime.combine(day, time(), UTC)
    return moment.strftime(TIME_FORMAT)


def _names(connection: Connection, ids: set[str]) -> dict[str, str]:
    """Return pseudonyms of persons and names of accounts by id."""
    found: dict[str, str] = {}
    for key, name in ((persons.c.id, persons.c.pseudonym), (accounts.c.id, accounts.c.name)):
        rows = connection.execute(select(key, name).where(key.in_(ids)))
        found |= {row[0]: row[1] for row in rows}
    return found
