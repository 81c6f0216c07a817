"""Joining two persons that turned out to be one, and taking that back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, Table, func, insert, select, update

from insole_core.errors import RecordsError
from insole_core.records.audit import AuditLog
from insole_core.records.author import utc_now
from insole_core.records.context import RecordsContext
from insole_core.records.marks import Merged, mark_of
from insole_core.records.person import SUMMARISED, Person, PersonSummary, new_id
from insole_core.records.rights import Right
from insole_core.records.row_seals import ids_of_persons
from insole_core.records.rows import (
    locked_person,
    person_of,
    touch_person,
    write_search_text,
)
from insole_core.records.schema import empty_value, follow_ups, merges, orders, persons, visits

_MOVED: Final[Mapping[str, Table]] = {
    "visits": visits,
    "orders": orders,
    "follow_ups": follow_ups,
}
_FILLED: Final = tuple(c.name for c in persons.columns if mark_of(c).merged is Merged.FILLED)
_MERGE_COLUMNS: Final = (
    merges.c.id,
    merges.c.kept_id,
    merges.c.merged_id,
    merges.c.at,
    merges.c.author,
)


@dataclass(frozen=True)
class Merge:
    """Two persons that were joined.

    Parameters
    ----------
    undone_at
        None while they are one.
    """

    id: str
    kept_id: str
    merged_id: str
    at: str
    author: str
    undone_at: str | None = None


@dataclass(frozen=True)
class MergePreview:
    """What a merge would do.

    Parameters
    ----------
    visits, orders, follow_ups
        Numbers of entries that move.
    filled
        Names of the fields that are empty of who is kept, and come from the other one.
    """

    visits: int
    orders: int
    follow_ups: int
    filled: tuple[str, ...]


@dataclass(frozen=True)
class NamedMerge:
    """A merge, and who both persons are: namesakes are told apart by the rest."""

    merge: Merge
    kept: PersonSummary
    merged: PersonSummary


def preview_merge(context: RecordsContext, keep_id: str, merge_id: str) -> MergePreview:
    """Return what `merge_persons` would do; nothing is changed.

    Raises
    ------
    RecordsError
        When there is no such person.
    """
    with context.reading() as connection:
        counts = {
            name: connection.execute(
                select(func.count()).select_from(table).where(table.c.person_id == merge_id)
            ).scalar_one()
            for name, table in _MOVED.items()
        }
        kept, merged = person_of(connection, keep_id), person_of(connection, merge_id)
    return MergePreview(**counts, filled=tuple(_fillable(kept, merged)))


def latest_merges(context: RecordsContext, limit: int = 100) -> list[NamedMerge]:
    """Return the merges that are not undone, the latest first."""
    kept, merged = persons.alias(), persons.alias()
    summarised = (person.c[name] for person in (kept, merged) for name in SUMMARISED)
    query = (
        select(*_MERGE_COLUMNS, *summarised)
        .join(kept, kept.c.id == merges.c.kept_id)
        .join(merged, merged.c.id == merges.c.merged_id)
        .where(merges.c.undone_at.is_(None))
        .order_by(merges.c.at.desc())
        .limit(limit)
    )
    first = len(_MERGE_COLUMNS)
    second = first + len(SUMMARISED)
    with context.reading() as connection:
        return [
            NamedMerge(
                Merge(*row[:first]),
                PersonSummary(*row[first:second]),
                PersonSummary(*row[second:]),
            )
            for row in connection.execute(query)
        ]


def merge_persons(context: RecordsContext, keep_id: str, merge_id: str) -> Merge:
    """Move all that one person has to another one, whose empty fields are filled.

    Raises
    ------
    RecordsError
        When they are the same, or one of them was merged or erased already.
    """
    if keep_id == merge_id:
        raise RecordsError("This is the same person twice; choose another one to merge with.")
    with context.writing(Right.MERGE) as connection:
        found = {id_: locked_person(connection, id_) for id_ in sorted((keep_id, merge_id))}
        kept, merged = found[keep_id], found[merge_id]
        if kept.is_sample or merged.is_sample:
            raise RecordsError("The sample patient cannot be merged with anybody; remove it.")
        changed = ids_of_persons(connection, [merge_id])
        moved = {
            name: _move(connection, table, _ids(connection, table, merge_id), keep_id)
            for name, table in _MOVED.items()
        }
        filled = _fill(connection, kept, merged)
        merge = Merge(new_id(), keep_id, merge_id, utc_now(), context.author.name)
        content = json.dumps({**moved, "filled": filled})
        connection.execute(insert(merges).values(**vars(merge), moved=content))
        row = update(persons).where(persons.c.id == merge_id)
        connection.execute(row.values(merged_into=keep_id, revision=merged.revision + 1))
        touch_person(connection, keep_id)
        write_search_text(connection, keep_id)
        _seal(connection, context, changed)
        context.log(connection, "merged", "person", keep_id, merged=merge_id, merge=merge.id)
    return merge


def undo_merge(context: RecordsContext, merge: Merge) -> None:
    """Take two persons apart again; what was added since stays with the one that was kept.

    Raises
    ------
    RecordsError
        When that has been done already, or a later merge has to be undone first.
    """
    with context.writing(Right.MERGE) as connection:
        ids = sorted((merge.kept_id, merge.merged_id))
        query = select(persons).where(persons.c.id.in_(ids)).order_by(persons.c.id)
        rows = {row.id: row for row in connection.execute(query.with_for_update())}
        stored = connection.execute(select(merges).where(merges.c.id == merge.id)).one_or_none()
        content = _undoable(merge, stored, rows)
        for name, table in _MOVED.items():
            # Only what is still there: a later merge may have moved it on.
            still = set(_ids(connection, table, merge.kept_id)).intersection(content[name])
            _move(connection, table, sorted(still), merge.merged_id)
        _empty(connection, rows[merge.kept_id], rows[merge.merged_id], content["filled"])
        row = update(persons).where(persons.c.id == merge.merged_id)
        revision = rows[merge.merged_id].revision + 1
        connection.execute(row.values(merged_into=None, revision=revision))
        row = update(merges).where(merges.c.id == merge.id)
        connection.execute(row.values(undone_at=utc_now()))
        touch_person(connection, merge.merged_id)
        for id_ in ids:
            write_search_text(connection, id_)
        _seal(connection, context, ids_of_persons(connection, [merge.merged_id]))
        context.log(
            connection, "unmerged", "person", merge.kept_id, merged=merge.merged_id, merge=merge.id
        )


def _seal(
    connection: Connection, context: RecordsContext, changed: Mapping[str, list[str]]
) -> None:
    """Note in the log that rows belong to another person now."""
    for kind, ids in changed.items():
        AuditLog.seal(connection, context.author, kind, ids)


def _undoable(merge: Merge, stored: Any, rows: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return what a merge has moved and filled, or raise why it cannot be undone."""
    merged = rows.get(merge.merged_id)
    if stored is None or stored.undone_at is not None or merged is None:
        raise RecordsError("This merge has been undone already; look at the persons again.")
    if merged.merged_into != merge.kept_id or rows[merge.kept_id].merged_into is not None:
        raise RecordsError(
            "The person was merged with another one since then; undo that later merge first."
        )
    if merged.is_erased or rows[merge.kept_id].is_erased:
        raise RecordsError("The data of this person were erased; the merge cannot be undone.")
    content: Mapping[str, Any] = json.loads(stored.moved)
    return content


def _ids(connection: Connection, table: Table, person_id: str) -> list[str]:
    query = select(table.c.id).where(table.c.person_id == person_id).order_by(table.c.id)
    return list(connection.execute(query).scalars())


def _move(connection: Connection, table: Table, ids: list[str], person_id: str) -> list[str]:
    """Give rows to a person; return their ids."""
    if ids:
        row = update(table).where(table.c.id.in_(ids))
        connection.execute(row.values(person_id=person_id))
    return ids


def _fill(connection: Connection, kept: Person, merged: Person) -> list[str]:
    """Fill what is empty of a person from another one; return the names of the fields."""
    filled = _fillable(kept, merged)
    values = {name: getattr(merged, name) for name in filled}
    _write(connection, kept.id, kept.revision, values)
    return filled


def _fillable(kept: Person, merged: Person) -> list[str]:
    return [n for n in _FILLED if not getattr(kept, n) and getattr(merged, n)]


def _empty(connection: Connection, kept: Any, merged: Any, filled: list[str]) -> None:
    """Empty again what was filled, unless it was changed since."""
    still = [n for n in filled if kept._mapping[n] == merged._mapping[n]]
    values = {name: empty_value(persons.c[name]) for name in still}
    _write(connection, kept.id, kept.revision, values)


def _write(
    connection: Connection, person_id: str, revision: int, values: Mapping[str, Any]
) -> None:
    written = {**values, "changed_at": utc_now(), "revision": revision + 1}
    connection.execute(update(persons).where(persons.c.id == person_id).values(written))
