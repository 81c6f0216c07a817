"""Looking into the audit log: who did what with whom, and when."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta
from typing import Any, Final

from sqlalchemy import CompoundSelect, Connection, Select, func, select, union_all

from insole_core.errors import RecordsError
from insole_core.progress import SILENT, Progress
from insole_core.records.audit import (
    SEALED_ROWS,
    AuditLine,
    AuditLog,
    AuditReport,
    compared_with_note,
)
from insole_core.records.author import TIME_FORMAT
from insole_core.records.context import RecordsContext
from insole_core.records.rights import Right, require
from insole_core.records.row_seals import ROW
from insole_core.records.rows import id_of_pseudonym, ids_of_joined
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

_ID: Final = re.compile(r"[0-9a-f]{8}-[0-9a-f-]{27}|[0-9a-f]{64}|age1\w{58}")
"""Of a row, the SHA-256 of a file, or the public key of backups."""
_SHOWN_DIGITS: Final = 8


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
        The pseudonym of the person whose row it is, the name of an account, the number of an
        order; the beginning of an id that is not known any more.
    details
        Those of the line, with the same names.
    """

    line: AuditLine
    subject: str
    details: Mapping[str, str]


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
    lines = AuditLog(context.database, context.author).lines(
        about=about,
        author=wanted.author or None,
        times=_times(wanted.first_day, wanted.last_day),
        before=before,
        limit=limit,
    )
    details = [_details_of(line) for line in lines]
    told = {str(value) for values in details for value in values.values()}
    with context.database.reading() as connection:
        names = _names(connection, {line.subject_id for line in lines} | told)
    return [
        ShownLine(
            line,
            _named(line.subject_id, names),
            {key: _named(str(value), names) for key, value in values.items()},
        )
        for line, values in zip(lines, details, strict=True)
    ]


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
    """Verify the log, also against the last line noted beside the large files.

    Raises
    ------
    NotAllowed
    Cancelled
    """
    noted = context.database.witness.read()
    report = AuditLog(context.database, context.author).verify(noted, progress)
    return compared_with_note(report, noted)


def _person_id(connection: Connection, pseudonym: str) -> str:
    found = id_of_pseudonym(connection, pseudonym)
    if found is None:
        raise RecordsError(
            "Nobody has the pseudonym {pseudonym}; it stands on the patient's page and on papers "
            "for the shop.",
            pseudonym=pseudonym,
        )
    return found


def _all_of(person_id: str) -> Select[Any]:
    """Return the query of the ids of a person and of all that hangs on them."""
    of_visits = select(visits.c.id).where(visits.c.person_id == person_id)
    parts: CompoundSelect[Any] = union_all(
        ids_of_joined(person_id),
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


def _details_of(line: AuditLine) -> dict[str, Any]:
    """Return the details of a line, also of one that somebody has changed to what is no JSON."""
    try:
        values = json.loads(line.details)
    except ValueError:
        return {"?": line.details}
    if not isinstance(values, dict):
        return {"?": line.details}
    if line.action == SEALED_ROWS:
        return {"rows": len(values)}
    return {key: value for key, value in values.items() if key != ROW}


def _named(text: str, names: Mapping[str, str]) -> str:
    """Return what an id is called; the beginning of one that nothing has; other texts as is."""
    if text in names:
        return names[text]
    return text[:_SHOWN_DIGITS] if _ID.fullmatch(text) else text


def _names(connection: Connection, ids: set[str]) -> dict[str, str]:
    """Return pseudonyms of persons and of those whose row it is, names of accounts, by id."""
    of_visit = select(visits.c.id, persons.c.pseudonym).join(persons)
    queries = [
        select(persons.c.id, persons.c.pseudonym).where(persons.c.id.in_(ids)),
        select(accounts.c.id, accounts.c.name).where(accounts.c.id.in_(ids)),
        select(orders.c.id, orders.c.number).where(orders.c.id.in_(ids)),
        of_visit.where(visits.c.id.in_(ids)),
        *(
            select(table.c.id, persons.c.pseudonym)
            .join(visits, visits.c.id == table.c.visit_id)
            .join(persons, persons.c.id == visits.c.person_id)
            .where(table.c.id.in_(ids))
            for table in (captures, prescription_versions)
        ),
    ]
    return {row[0]: row[1] for query in queries for row in connection.execute(query)}
