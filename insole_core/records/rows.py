"""Rows of persons, visits and orders, read and locked within a transaction."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any, Final

from sqlalchemy import ColumnElement, Connection, Row, Select, case, func, or_, select, update

from insole_core.cases.order_note import OrderNote
from insole_core.errors import PersonErased, RecordsError
from insole_core.export.shop_order import OrderTerms, terms_from_json, terms_to_json
from insole_core.json_object import JsonObject
from insole_core.records.checked_values import day_of, word_of
from insole_core.records.order import (
    OPEN_STATES,
    Order,
    OrderEvent,
    OrderFile,
    OrderSearch,
    OrderState,
    OrderSummary,
)
from insole_core.records.person import Person
from insole_core.records.person_matching import (
    MOST_KEY,
    name_key_of,
    search_text_of,
    search_words,
    sort_key_of,
)
from insole_core.records.schema import (
    audit_head,
    order_events,
    order_feet,
    order_files,
    orders,
    persons,
    visits,
)
from insole_core.records.visit import CaptureState, Visit

_SORT_COLUMNS: Final[dict[str, ColumnElement[Any]]] = {
    "person_name": persons.c.sort_key,
    "ordered_on": orders.c.created_at,
    "shop": func.nullif(orders.c.shop, ""),
    "state": case({str(state): n for n, state in enumerate(OrderState)}, value=orders.c.state),
}
"""What an order is sorted by in place of the column of the same name."""

PERSON_FIELDS: Final = tuple(field.name for field in fields(Person))

_VISIT_FIELDS: Final = tuple(field.name for field in fields(Visit))


def order_of(connection: Connection, order_id: str) -> Order:
    """Return an order with its files and events.

    Raises
    ------
    RecordsError
        When there is none.
    """
    row = connection.execute(select(orders).where(orders.c.id == order_id)).one_or_none()
    if row is None:
        raise order_is_gone()
    feet = select(order_feet.c.prescription_version_id)
    feet = feet.where(order_feet.c.order_id == order_id, order_feet.c.release == row.release)
    names = ("name", "content_sha256", "size", "release")
    files = select(*(order_files.c[name] for name in names))
    files = files.where(order_files.c.order_id == order_id)
    files = files.order_by(order_files.c.release.desc(), order_files.c.name)
    events = select(order_events).where(order_events.c.order_id == order_id)
    events = events.order_by(order_events.c.seq)
    values: dict[str, Any] = {**row._mapping, "state": word_of(OrderState, row.state)}
    return Order(
        **values,
        version_ids=tuple(connection.execute(feet).scalars()),
        files=tuple(OrderFile(*file) for file in connection.execute(files)),
        events=tuple(_event(event) for event in connection.execute(events)),
    )


def note_of_visit(connection: Connection, visit: Visit) -> OrderNote:
    """Return the order of a visit that the next export revises, and the terms of the visit.

    It is the latest one with which somebody still has something to do: what was delivered or
    cancelled is followed by a new order.
    """
    query = select(orders.c.number, orders.c.release).where(
        orders.c.visit_id == visit.id, orders.c.state.in_(OPEN_STATES)
    )
    row = connection.execute(query.order_by(orders.c.created_at.desc()).limit(1)).one_or_none()
    number, release = ("", 0) if row is None else row
    return OrderNote(number, release, visit.terms)


def searched(search: OrderSearch) -> Select[Any]:
    """Return the query of the orders that are wanted."""
    return listed_orders().where(*_conditions(search)).order_by(*_sorting(search))


def listed_orders() -> Select[Any]:
    """Return the query of the summaries of all orders."""
    names = ("id", "number", "person_id", "visit_id", "state", "shop", "due_on", "release")
    return select(
        *(orders.c[name] for name in names),
        orders.c.created_at,
        orders.c.revision,
        persons.c.name.label("person_name"),
    ).join(persons, persons.c.id == orders.c.person_id)


def summary_of_order(row: Row[Any]) -> OrderSummary:
    """Return the summary of a row of `listed_orders`."""
    values = dict(row._mapping)
    ordered_on = day_of(values.pop("created_at"))
    return OrderSummary(
        **values | {"state": word_of(OrderState, row.state), "ordered_on": ordered_on}
    )


def order_is_gone() -> RecordsError:
    """Return the error that an order is not in the record, for the caller to raise."""
    return RecordsError("This order is no longer in the record; look at the list again.")


def _event(row: Row[Any]) -> OrderEvent:
    before = None if row.from_state is None else word_of(OrderState, row.from_state)
    after = word_of(OrderState, row.to_state)
    return OrderEvent(row.seq, row.at, row.author, before, after, row.remarks, row.release)


def _conditions(search: OrderSearch) -> Iterator[ColumnElement[bool]]:
    if search.states:
        yield orders.c.state.in_(search.states)
    if search.person_id:
        yield orders.c.person_id == search.person_id
    for word in search_words(search.typed):
        yield or_(
            persons.c.search_text.contains(f" {word}", autoescape=True),
            orders.c.number.icontains(word, autoescape=True),
            orders.c.shop.icontains(word, autoescape=True),
        )


def _sorting(search: OrderSearch) -> Iterator[ColumnElement[Any]]:
    """Yield what to sort by: what is empty comes last, and equal ones always in the same order."""
    key = search.sorted_by
    column = _SORT_COLUMNS[key] if key in _SORT_COLUMNS else orders.c[key]
    yield (column.desc() if search.is_descending else column.asc()).nulls_last()
    yield orders.c.number


def id_of_pseudonym(connection: Connection, typed: str) -> str | None:
    """Return the id of the person with a pseudonym, as somebody types it from a paper.

    Small and capital letters count only where two pseudonyms differ by nothing else.

    Returns
    -------
    str or None
        None where nobody has it, or several have it and none as it is typed.
    """
    name = typed.strip()
    query = select(persons.c.id, persons.c.pseudonym)
    query = query.where(func.lower(persons.c.pseudonym) == func.lower(name))
    found = {row.pseudonym: row.id for row in connection.execute(query)}
    alike = next(iter(found.values())) if len(found) == 1 else None
    return found.get(name, alike)


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


def visit_of(connection: Connection, visit_id: str, *, locked: bool = False) -> Visit:
    """Return a visit, on demand with its row locked until the transaction ends.

    Raises
    ------
    RecordsError
        When there is none.
    """
    query = all_visits().where(visits.c.id == visit_id)
    row = connection.execute(query.with_for_update() if locked else query).one_or_none()
    if row is None:
        raise RecordsError("This visit is no longer in the record; open the person again.")
    return visit_from(row)


def all_visits() -> Select[Any]:
    """Return the query of all visits."""
    return select(*(visits.c[name] for name in _VISIT_FIELDS))


def visit_from(row: Row[Any]) -> Visit:
    """Return the visit of a row of `all_visits`."""
    values = dict(zip(_VISIT_FIELDS, row, strict=True))
    values["measures"] = json.loads(values["measures"])
    values["capture_state"] = word_of(CaptureState, values["capture_state"])
    values["terms"] = _terms(values["terms"])
    return Visit(**values)


def visit_values(visit: Visit, names: Iterable[str] = _VISIT_FIELDS) -> dict[str, Any]:
    """Return fields of a visit as the columns of its row; the inverse of `visit_from`."""
    values = {name: getattr(visit, name) for name in names}
    if "measures" in values:
        values["measures"] = json.dumps(dict(visit.measures))
    if "terms" in values:
        said = terms_to_json(visit.terms) if visit.terms != OrderTerms() else {}
        values["terms"] = json.dumps(said, ensure_ascii=False)
    return values


def _terms(text: str) -> OrderTerms:
    said = JsonObject.parse("terms of the order", text.encode())
    return terms_from_json(said) if said.values else OrderTerms()
