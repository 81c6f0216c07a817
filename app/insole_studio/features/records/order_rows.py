"""Orders as rows of a list, and the names of their states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date
from typing import Final

from insole_core.records.order import (
    Order,
    OrderEvent,
    OrderKey,
    OrderSearch,
    OrderState,
    OrderSummary,
)
from insole_studio.features.records.record_texts import day_text
from insole_studio.texts import moment_text, tr
from insole_studio.widgets.row_table import Sorting, TableRow

COLUMNS: Final[tuple[OrderKey, ...]] = (
    "person_name", "number", "release", "state", "due_on", "shop", "ordered_on",
)  # fmt: skip
"""What the columns of the list of orders show, and are sorted by."""


def state_text(state: OrderState) -> str:
    """Return the name of a state."""
    return {
        OrderState.DESIGNED: tr("Designed"),
        OrderState.CHECKED: tr("Checked"),
        OrderState.SENT: tr("Sent"),
        OrderState.IN_PRODUCTION: tr("In production"),
        OrderState.DELIVERED: tr("Delivered"),
        OrderState.ADJUSTED: tr("Adjusted"),
        OrderState.RETURNED: tr("Returned"),
        OrderState.CANCELLED: tr("Cancelled"),
    }[state]


def order_rows(
    orders: Sequence[OrderSummary], today: date, columns: Sequence[OrderKey] = COLUMNS
) -> list[TableRow]:
    """Return the rows of orders, a cell for each column; what is late is marked."""
    return [
        TableRow(
            order.id,
            tuple(_cell(order, column, today) for column in columns),
            attention=order.is_overdue(today),
        )
        for order in orders
    ]


def _cell(order: OrderSummary, column: OrderKey, today: date) -> str:
    if column == "state":
        return state_text(order.state)
    if column == "due_on":
        return due_text(order, today)
    if column == "ordered_on":
        return day_text(order.ordered_on)
    return str(getattr(order, column))


def sorted_as(
    search: OrderSearch, columns: Sequence[OrderKey], sorting: Sorting | None
) -> OrderSearch:
    """Return a search sorted by one of the columns; for None, what is due first comes first."""
    sorting = sorting or Sorting(columns.index("due_on"))
    key = columns[sorting.column]
    return replace(search, sorted_by=key, is_descending=sorting.is_descending)


def with_revision(text: str, release: int) -> str:
    """Return a text with the revision that it is about; the first one is not said."""
    if release <= 1:
        return text
    return tr("{number}, revision {revision}").format(number=text, revision=release)


def name_of(order: Order | OrderSummary) -> str:
    """Return what an order is called in a sentence: by its number and a later revision."""
    return with_revision(tr("Order {number}").format(number=order.number), order.release)


def event_text(event: OrderEvent) -> str:
    """Return a step of an order: when, what became of it, who did it."""
    state = with_revision(state_text(event.to_state), event.release)
    return f"{moment_text(event.at)}  {state}, {event.author}"


def order_text(order: OrderSummary, today: date) -> str:
    """Return an order as a line of its visit: number, state, due date."""
    parts = (
        name_of(order),
        state_text(order.state),
        tr("due {day}").format(day=due_text(order, today)) if order.due_on else "",
    )
    return ", ".join(filter(None, parts))


def due_text(order: OrderSummary, today: date) -> str:
    """Return when an order is due, and whether it is late."""
    day = day_text(order.due_on)
    return tr("{day}, overdue").format(day=day) if order.is_overdue(today) else day
