"""How long the record is kept, and what is erased when a patient asks for it (decision 0045).

The documentation of a custom-made device is kept for at least ten years (Regulation (EU) 2017/745,
Annex XIII, section 4), and so is a patient's record in most countries. While the law keeps it, a
request erases what the documentation does not need: all that says who the patient is, and free
text. The device stays documented under the pseudonym, which the annex allows. After that time
everything goes but the pseudonym's row, so that the audit log still tells that there was somebody.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from datetime import MAXYEAR, MINYEAR, UTC, date, datetime
from enum import StrEnum
from typing import Any, Final

from sqlalchemy import (
    Connection,
    Select,
    Table,
    and_,
    delete,
    exists,
    func,
    or_,
    select,
    update,
)

from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.errors import RecordsError, UsageError
from insole_core.records.audit import AuditLog
from insole_core.records.author import Author
from insole_core.records.bare_files import BareFiles
from insole_core.records.captures import SESSION
from insole_core.records.checked_values import day_of, highest
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.content_store import GRACE_S, SweptContents
from insole_core.records.context import RecordsContext
from insole_core.records.deleted_text import finish_erasing, note_erasing
from insole_core.records.erasure import Eraser, is_unused
from insole_core.records.person import new_pseudonym
from insole_core.records.rights import Right, require, require_signed_in
from insole_core.records.rows import id_of_pseudonym, ids_of_joined
from insole_core.records.schema import (
    captures,
    contents,
    follow_ups,
    is_of_person,
    order_events,
    orders,
    persons,
    prescription_versions,
    tables_of_persons,
    visits,
)
from insole_core.records.signing import ERASED, PRESCRIPTION
from insole_core.records.traces import Traces

YEARS_VALUE: Final = "retention_years"
"""Key of the clinic's settings."""
LEAST_YEARS: Final = 10
"""Annex XIII, section 4, for devices that are not implanted."""
MOST_YEARS: Final = 100


class ErasureReason(StrEnum):
    """Why somebody is erased; no other words, which might be about the patient."""

    REQUEST = "request"
    RETENTION_OVER = "retention over"
    SAMPLE = "sample"
    """The invented patient, of whom the law keeps nothing."""


@dataclass(frozen=True)
class Erasure:
    """What was erased.

    Parameters
    ----------
    kept_until
        Until when the law keeps the devices, now under the pseudonym; None when nothing is left.
    visits, prescriptions, captures, orders
        Numbers of rows that were removed.
    """

    person_id: str
    kept_until: date | None
    visits: int = 0
    prescriptions: int = 0
    captures: int = 0
    orders: int = 0


@dataclass(frozen=True)
class Erasable:
    """Somebody who may be erased, without a word on who they are.

    Parameters
    ----------
    visits, orders
        Numbers of what the record holds of them.
    kept_until
        Until when the law keeps their devices; these stay under the pseudonym if they are erased
        before that.
    """

    person_id: str
    pseudonym: str
    visits: int
    orders: int
    kept_until: date


def find_erasable(context: RecordsContext, pseudonym: str) -> Erasable:
    """Return what erasing a person would mean.

    Parameters
    ----------
    pseudonym
        By which somebody who may not see patients can be asked to erase one.

    Raises
    ------
    NotAllowed
    RecordsError
        When nobody has the pseudonym, or they are erased already.
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.ERASE)
        query = select(persons.c.id).where(
            persons.c.id == id_of_pseudonym(connection, pseudonym), persons.c.merged_into.is_(None)
        )
        person_id = connection.execute(query).scalar()
        if person_id is None or not _has_entries(connection, person_id):
            raise RecordsError(
                "There is nobody to erase with the pseudonym {pseudonym}; it stands on the "
                "patient's page.",
                pseudonym=pseudonym,
            )
        return _erasable(connection, person_id)


def over_retention_named(context: RecordsContext, today: date, limit: int = 100) -> list[Erasable]:
    """Return those whose record need not be kept any longer, the oldest first.

    Raises
    ------
    NotAllowed
    """
    found = over_retention(context, today, limit)
    with context.database.reading() as connection:
        return [_erasable(connection, person_id) for person_id in found]


def _erasable(connection: Connection, person_id: str) -> Erasable:
    pseudonym = connection.execute(
        select(persons.c.pseudonym).where(persons.c.id == person_id)
    ).scalar_one()
    return Erasable(
        person_id,
        pseudonym,
        _count(connection, visits, person_id),
        _count(connection, orders, person_id),
        kept_until(connection, person_id),
    )


def _is_sample(connection: Connection, person_id: str) -> bool:
    pseudonym = select(persons.c.pseudonym).where(persons.c.id == person_id)
    return connection.execute(pseudonym).scalar() == SAMPLE_PSEUDONYM


def _count(connection: Connection, table: Table, person_id: str) -> int:
    query = select(func.count()).select_from(table).where(table.c.person_id == person_id)
    return int(connection.execute(query).scalar_one())


def retention_years(connection: Connection) -> int:
    """Return for how many years the clinic keeps its record.

    Never less than the law asks for, nor more than a calendar has: earlier programs stored any
    number.
    """
    return min(max(_stored_years(connection), LEAST_YEARS), MAXYEAR)


def _stored_years(connection: Connection) -> int:
    return int(setting_of(connection, YEARS_VALUE, LEAST_YEARS))


def years_of_keeping(context: RecordsContext) -> int:
    """Return the same, for whoever has no connection."""
    with context.database.reading() as connection:
        return retention_years(connection)


def keep_for(context: RecordsContext, years: int) -> None:
    """Set for how many years the clinic keeps its record.

    Raises
    ------
    NotAllowed
    UsageError
        When it is less than the law asks for, or more than `MOST_YEARS`.
    """
    if not LEAST_YEARS <= years <= MOST_YEARS:
        raise UsageError(
            "The record cannot be kept for {years} years: the law asks for at least {least} years, "
            "and {most} are the most; give a number between them.",
            years=years,
            least=LEAST_YEARS,
            most=MOST_YEARS,
        )
    with context.writing(Right.SET_UP) as connection:
        before = _stored_years(connection)
        write_setting(connection, YEARS_VALUE, years)
        context.log(connection, "changed", "clinic", YEARS_VALUE, years=years, years_before=before)


def kept_until(connection: Connection, person_id: str) -> date:
    """Return until when a person's record is kept: some years after the last entry.

    The sample patient's record need not be kept after that day.
    """
    last = max(_last_days(connection, person_id))
    if _is_sample(connection, person_id):
        return last
    return _years_later(last, retention_years(connection))


def over_retention(context: RecordsContext, today: date, limit: int = 100) -> list[str]:
    """Return the ids of persons whose record need not be kept any longer, the oldest first.

    Raises
    ------
    NotAllowed
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.ERASE)
        years = retention_years(connection)
        before = _years_later(today, -years)
        last_visit = func.max(visits.c.visited_on)
        # By visits first, which are indexed; other entries are looked at one by one.
        candidates = connection.execute(
            select(persons.c.id)
            .outerjoin(visits, visits.c.person_id == persons.c.id)
            .where(persons.c.merged_into.is_(None), persons.c.created_at < before.isoformat())
            .group_by(persons.c.id)
            .having(func.coalesce(last_visit, before) <= before)
            .order_by(last_visit, persons.c.id)
        ).scalars()
        found: list[str] = []
        for person_id in candidates.all():
            if len(found) == limit:
                break
            if _is_sample(connection, person_id):
                continue
            if _has_entries(connection, person_id) and kept_until(connection, person_id) <= today:
                found.append(person_id)
        return found


def are_erased(context: RecordsContext, person_ids: Sequence[str]) -> dict[str, bool]:
    """Return of those whom the record knows whether they are erased.

    Raises
    ------
    NotAllowed
        When nobody has signed in.
    """
    with context.database.reading() as connection:
        require_signed_in(connection, context.author)
        query = select(persons.c.id, persons.c.is_erased).where(persons.c.id.in_(person_ids))
        return {row.id: row.is_erased for row in connection.execute(query)}


def erase_person(
    context: RecordsContext,
    person_id: str,
    reason: ErasureReason,
    today: date,
    *,
    note: Callable[[Traces], object] | None = None,
) -> Erasure:
    """Erase a person, on request or after the time of keeping.

    The audit log keeps that it was done, when and by whom. Large files that nothing refers to any
    more leave the disk with the next sweeps. Backups of before hold the person until they are
    removed; restoring one of them erases the person again. Copies from before an upgrade go.
    Where the program is stopped once the person is erased, the next opening goes on.

    Parameters
    ----------
    note
        Called before anything is erased, with by what leftovers on this computer are known: these
        are to be removed next.

    Raises
    ------
    NotAllowed
    RecordsError
        When there is no such person, or the person was merged into another one.
    """
    with context.database.reading() as connection:
        require(connection, context.author, Right.ERASE)
        eraser = Eraser(connection, context.contents, person_id)
        bare, files, traces = eraser.prepared(), eraser.files(), eraser.traces()
    if note is not None:
        note(traces)
    with context.database.writing() as connection:
        require(connection, context.author, Right.ERASE)
        erasure = erase_in(connection, context, person_id, reason, today, bare=bare)
        note_erasing(connection, person_id)
    with context.database.reading() as connection:
        files.difference_update(connection.execute(select(contents.c.sha256)).scalars())
    context.contents.discard(files)
    finish_erasing(context.database)
    return erasure


def erase_in(
    connection: Connection,
    context: RecordsContext,
    person_id: str,
    reason: ErasureReason,
    today: date,
    *,
    bare: BareFiles | None = None,
) -> Erasure:
    """Do the same in a transaction of the caller, who has the right to it.

    Parameters
    ----------
    bare
        With the files of the person, from `Eraser.prepared`.
    """
    author = context.author
    _lock(connection, person_id)
    until = kept_until(connection, person_id)
    is_sample = _is_sample(connection, person_id)
    if is_sample:  # so that it can come back
        row = update(persons).where(persons.c.id == person_id)
        connection.execute(row.values(pseudonym=new_pseudonym()))
    eraser = Eraser(connection, context.contents, person_id, bare)
    files, rows = eraser.files(), eraser.sealed_rows()
    eraser.erase_persons()
    if until > today and not is_sample:
        erasure = Erasure(person_id, until)
        captured = _unused_captures(connection, person_id)
        eraser.erase_rows(author)
    else:
        erasure = _remove_all(connection, author, person_id)
        captured = 0
    connection.execute(delete(contents).where(contents.c.sha256.in_(files), is_unused()))
    for kind, ids in rows.items():
        AuditLog.seal(connection, author, kind, ids)
    AuditLog.append(
        connection,
        author,
        ERASED,
        "person",
        person_id,
        reason=str(reason),
        kept_until=None if erasure.kept_until is None else erasure.kept_until.isoformat(),
        visits=erasure.visits,
        prescriptions=erasure.prescriptions,
        captures=erasure.captures + captured,
        orders=erasure.orders,
    )
    return erasure


def sweep_contents(
    context: RecordsContext, now: datetime | None = None, grace_s: float = GRACE_S
) -> SweptContents:
    """Let large files go that nothing refers to any more, as after an erasure; every account may.

    Raises
    ------
    NotAllowed
        When nobody has signed in.
    RecordsError
        When somebody refers to one of them at the same moment: the next sweep is in time.
    """
    now = datetime.now(UTC) if now is None else now
    before = datetime.fromtimestamp(now.timestamp() - grace_s, UTC).isoformat()
    with context.database.writing() as connection:
        require_signed_in(connection, context.author)
        old = contents.c.created_at < before
        removed = connection.execute(delete(contents).where(is_unused(), old)).rowcount
        if removed:
            AuditLog.append(connection, context.author, "swept", "contents", "all", files=removed)
        used: Collection[str] = set(connection.execute(select(contents.c.sha256)).scalars())
    return context.contents.sweep(used, now.timestamp(), grace_s)


def _lock(connection: Connection, person_id: str) -> None:
    query = select(persons.c.merged_into).where(persons.c.id == person_id).with_for_update()
    row = connection.execute(query).one_or_none()
    if row is None:
        raise RecordsError("This person is no longer in the record; search for them again.")
    if row.merged_into is not None:
        raise RecordsError("This person was merged with another one; erase the other one.")


def _last_days(connection: Connection, person_id: str) -> list[date]:
    """Return the days of the last entries of each kind about a person."""
    own_visits = _ids(visits, person_id)
    queries = (
        select(persons.c.created_at).where(persons.c.id == person_id),
        select(highest(visits.c.visited_on)).where(visits.c.person_id == person_id),
        select(highest(follow_ups.c.on_date)).where(follow_ups.c.person_id == person_id),
        select(highest(prescription_versions.c.created_at)).where(
            prescription_versions.c.visit_id.in_(own_visits)
        ),
        select(highest(order_events.c.at)).where(
            order_events.c.order_id.in_(_ids(orders, person_id))
        ),
    )
    values = [connection.execute(query).scalar() for query in queries]
    return [_day(value) for value in values if value is not None]


def _has_entries(connection: Connection, person_id: str) -> bool:
    """Return whether there is still something of a person to erase."""
    row = connection.execute(select(persons.c.is_erased).where(persons.c.id == person_id)).one()
    some_visit = select(visits.c.id).where(visits.c.person_id == person_id).limit(1)
    return not row.is_erased or connection.execute(some_visit).first() is not None


def _unused_captures(connection: Connection, person_id: str) -> int:
    """Remove captures that no prescription was made from: they document no device.

    Of one that was corrected where it was recorded both forms stay: its correction may say which
    foot it shows. Where a copy from the record was corrected, the correction holds all of that.
    """
    used = captures.alias()
    is_correction = and_(
        captures.c.kind == SESSION,
        captures.c.source_sha256 != "",
        captures.c.visit_id == used.c.visit_id,
        captures.c.source_sha256.in_((used.c.source_sha256, used.c.content_sha256)),
    )
    row = delete(captures).where(
        captures.c.visit_id.in_(_ids(visits, person_id)),
        ~exists().where(
            prescription_versions.c.capture_id == used.c.id,
            or_(used.c.id == captures.c.id, is_correction),
        ),
    )
    return connection.execute(row).rowcount


def _remove_all(connection: Connection, author: Author, person_id: str) -> Erasure:
    of_visits = _ids(visits, person_id)
    versions = prescription_versions.c
    signed = connection.execute(
        select(versions.id).where(versions.visit_id.in_(of_visits), versions.signed_at.is_not(None))
    ).scalars()
    signed_ids = signed.all()
    ids = list(connection.execute(ids_of_joined(person_id)).scalars())
    counts = {
        table.name: connection.execute(delete(table).where(is_of_person(table, ids))).rowcount
        for table in reversed(tables_of_persons())
    }
    for version_id in signed_ids:
        AuditLog.append(connection, author, ERASED, PRESCRIPTION, version_id)
    return Erasure(
        person_id,
        None,
        counts[visits.name],
        counts[prescription_versions.name],
        counts[captures.name],
        counts[orders.name],
    )


def _ids(table: Table, person_id: str) -> Select[Any]:
    return select(table.c.id).where(table.c.person_id == person_id)


def _day(value: str | date) -> date:
    return value if isinstance(value, date) else day_of(value)


def _years_later(day: date, years: int) -> date:
    year = day.year + years
    if not MINYEAR <= year <= MAXYEAR:
        return date.max if years > 0 else date.min
    try:
        return day.replace(year=year)
    except ValueError:  # the 29th of February
        return date(year, 3, 1)
