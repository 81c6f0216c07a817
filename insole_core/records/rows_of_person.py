"""Which rows of which tables belong to a person: as the keys of the schema say."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from sqlalchemy import Column, ColumnElement, Table, select

from insole_core.records.schema import metadata, orders, persons, visits

_OWNERS: Final[dict[str, Table]] = {"person_id": persons, "visit_id": visits, "order_id": orders}
"""By which column a row belongs to which other one; the first that a table has counts."""


def tables_of_persons() -> tuple[Table, ...]:
    """Return all tables whose rows belong to a person, those referred to first."""
    return tuple(table for table in metadata.sorted_tables if owner_of(table) is not None)


def owner_of(table: Table) -> Column[Any] | None:
    """Return the column by which the rows of a table belong to a person, directly or not."""
    return next((table.c[name] for name in _OWNERS if name in table.c), None)


def is_of_person(table: Table, ids: Sequence[str]) -> ColumnElement[bool]:
    """Return the condition under which a row is of one of some persons, by their ids."""
    if table is persons:
        return persons.c.id.in_(ids)
    key = owner_of(table)
    assert key is not None, f"{table.name} is about no person"
    owner = _OWNERS[key.name]
    if owner is persons:
        return key.in_(ids)
    return key.in_(select(owner.c.id).where(is_of_person(owner, ids)))
