"""Rows of orders, read within a transaction."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from sqlalchemy import ColumnElement, Connection, Row, Select, case, func, or_, select

from insole_core.cases.order_note import OrderNote
from insole_core.errors import RecordsError
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
from insole_core.records.schema import order_events, order_feet, order_files, orders, persons
from insole_core.records.search_text import search_words
from insole_core.records.visit import Visit

_SORT_COLUMNS: Final[dict[str, ColumnElement[Any]]] = {
    "person_name": persons.c.sort_key,
    "ordered_on": orders.c.created_at,
    "shop": func.nullif(orders.c.shop, ""),
    "state": case({str(state): n for n, state in enumerate(OrderState)}, value=orders.c.state),
}
"""What an order is sorted by in place of the column of the same name."""


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
