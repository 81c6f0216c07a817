"""Digests of rows, which the audit log keeps: whoever changes a row behind its back is found.

A line about a change holds the digest of the row as it was left. It is salted with a text that is
erased with the person, so that no digest tells what an erased row held. A value that is empty is
not part of it: a column that is added later changes no digest.
"""

from __future__ import annotations

import hashlib
import json
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from datetime import date
from types import MappingProxyType
from typing import Any, Final

from sqlalchemy import Column, Connection, Row, Select, Table, literal, select

from insole_core.records.marks import mark_of
from insole_core.records.schema import (
    accounts,
    captures,
    clinic,
    empty_value,
    follow_ups,
    is_of_person,
    order_events,
    order_feet,
    order_files,
    orders,
    owner_of,
    persons,
    prescription_versions,
    visit_photos,
    visits,
)

SEALED: Final[Mapping[str, Table]] = MappingProxyType(
    {
        "person": persons,
        "visit": visits,
        "capture": captures,
        "photo": visit_photos,
        "prescription": prescription_versions,
        "order": orders,
        "follow up": follow_ups,
        "account": accounts,
        "clinic": clinic,
    }
)
"""Tables by what the lines of the audit log call a row."""
ROW: Final = "row"
"""Detail of a line: the digest of its row."""
_PARTS: Final[Mapping[Table, tuple[Table, ...]]] = MappingProxyType(
    {orders: (order_feet, order_files, order_events)}
)
"""Rows that belong to another one, and are part of its digest."""
_LENGTH: Final = 32
_BATCH: Final = 500
_ENCODER: Final = json.JSONEncoder(sort_keys=True, separators=(",", ":"), default=date.isoformat)


def digests_of(connection: Connection, table: Table, ids: Sequence[str]) -> dict[str, str]:
    """Return the digests of rows by their ids; none for those that are not there."""
    (key,) = table.primary_key.columns
    found: dict[str, str] = {}
    for start in range(0, len(ids), _BATCH):
        found |= _digests(connection, table, _salted(table).where(key.in_(ids[start:][:_BATCH])))
    return found


def all_digests(connection: Connection, table: Table) -> Iterator[tuple[str, str]]:
    """Yield id and digest of every row of a table."""
    (key,) = table.primary_key.columns
    last = ""
    while True:
        query = _salted(table).where(key > last).order_by(key).limit(_BATCH)
        found = _digests(connection, table, query)
        if not found:
            return
        yield from found.items()
        last = max(found)


def ids_of_persons(connection: Connection, person_ids: Sequence[str]) -> dict[str, list[str]]:
    """Return the ids of all sealed rows of some persons, by what lines call them."""
    found = {}
    for kind, table in SEALED.items():
        if table is persons or owner_of(table) is not None:
            (key,) = table.primary_key.columns
            query = select(key).where(is_of_person(table, person_ids)).order_by(key)
            found[kind] = list(connection.execute(query).scalars())
    return found


def _digests(connection: Connection, table: Table, query: Select[Any]) -> dict[str, str]:
    (key,) = table.primary_key.columns
    rows = {row._mapping[key.name]: row for row in connection.execute(query)}
    parts: dict[str, dict[str, list[str]]] = defaultdict(dict)
    for part in _PARTS.get(table, ()):
        owner = owner_of(part)
        assert owner is not None, f"{part.name} is no part of another table"
        for row in connection.execute(select(part).where(owner.in_(rows))):
            id_ = row._mapping[owner.name]
            parts[id_].setdefault(part.name, []).append(_ENCODER.encode(_values(part, row)))
    return {
        id_: _digest(
            table.name,
            row._mapping[_SALT],
            _values(table, row),
            {name: sorted(lines) for name, lines in parts[id_].items()},
        )
        for id_, row in rows.items()
    }


_SALT: Final = "salt_of_person"


def _salted(table: Table) -> Select[Any]:
    """Return the query of the rows of a table, each with the salt of its person."""
    if table is persons:
        return select(table, persons.c.salt.label(_SALT))
    owner = owner_of(table)
    if owner is None:
        return select(table, literal("").label(_SALT))
    if owner.name == "person_id":
        query = select(table, persons.c.salt.label(_SALT))
        return query.join(persons, persons.c.id == owner)
    query = select(table, persons.c.salt.label(_SALT)).join(visits, visits.c.id == owner)
    return query.join(persons, persons.c.id == visits.c.person_id)


def _values(table: Table, row: Row[Any]) -> dict[str, Any]:
    sealed = (column for column in table.columns if mark_of(column).is_sealed)
    values = {column: row._mapping[column.name] for column in sealed}
    return {column.name: v for column, v in values.items() if not _is_empty(column, v)}


def _is_empty(column: Column[Any], value: Any) -> bool:
    return value is None or value is False or str(value) in ("", str(empty_value(column)))


def _digest(*content: Any) -> str:
    return hashlib.sha256(_ENCODER.encode(content).encode("ascii")).hexdigest()[:_LENGTH]
