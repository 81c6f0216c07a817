"""Rows of persons, read and locked within a transaction."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from typing import Any, Final

from sqlalchemy import Connection, Select, select, update

from insole_core.errors import PersonErased, RecordsError
from insole_core.records.person import Person
from insole_core.records.schema import audit_head, orders, persons
from insole_core.records.search_text import MOST_KEY, name_key_of, search_text_of, sort_key_of

PERSON_FIELDS: Final = tuple(field.name for field in fields(Person))


def person_of(connection: Connection, person_id: str) -> Person:
    """Return a person, or the one that this person was merged into.

    Raises
    ------
    RecordsError
        When there is none.
    """
    while True:
        person = _one(connection, person_id)
        if person.merged_into is None:
            return person
        person_id = person.merged_into


def locked_person(connection: Connection, person_id: str) -> Person:
    """Return a person whose row no other station changes until the transaction ends.

    Raises
    ------
    RecordsError
        When there is none, or the person was merged or erased.
    """
    person = _one(connection, person_id, locked=True)
    if person.merged_into is not None:
        raise RecordsError("This person was merged with another one meanwhile; open the other one.")
    if person.is_erased:
        raise PersonErased("The data of this person were erased; nothing can be added to them.")
    return person


def ids_of_joined(person_id: str) -> Select[Any]:
    """Return the query of the ids of a person and of all merged into them, also through others."""
    joined = select(persons.c.id).where(persons.c.id == person_id).cte("joined", recursive=True)
    merged = select(persons.c.id).join(joined, persons.c.merged_into == joined.c.id)
    return select(joined.union(merged).c.id)


def write_search_text(connection: Connection, person_id: str) -> None:
    """Write anew what a person is found by, after a change of the person or of the orders."""
    person = _one(connection, person_id)
    numbers = connection.execute(
        select(orders.c.number).where(orders.c.person_id == person_id).order_by(orders.c.number)
    ).scalars()
    row = update(persons).where(persons.c.id == person_id)
    connection.execute(row.values(found_by(person, numbers)))


def found_by(person: Person, numbers: Iterable[str] = ()) -> dict[str, str]:
    """Return the columns that a person is found and sorted by.

    Parameters
    ----------
    numbers
        Of the person's orders.
    """
    return {
        "search_text": search_text_of(
            person.name, person.birth_date, person.personal_number, [person.pseudonym, *numbers]
        ),
        "sort_key": sort_key_of(person.name),
        "name_key": name_key_of(person.name)[:MOST_KEY],
    }


def _one(connection: Connection, person_id: str, *, locked: bool = False) -> Person:
    query = select(*(persons.c[name] for name in PERSON_FIELDS)).where(persons.c.id == person_id)
    row = connection.execute(query.with_for_update() if locked else query).one_or_none()
    if row is None:
        raise RecordsError("This person is no longer in the record; search for them again.")
    return Person(*row)


def touch_person(connection: Connection, person_id: str) -> None:
    """Lock a person's row, and make them the one who was worked on last."""
    # Not the number of the line to come, but near enough for the order of recent ones: the head of
    # the log is locked last.
    coming = select(audit_head.c.seq + 1).scalar_subquery()
    row = update(persons).where(persons.c.id == person_id)
    connection.execute(row.values(last_seq=coming))
