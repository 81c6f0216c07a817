"""An order of a visit's insoles, as a value."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from enum import StrEnum
from typing import Final


class OrderState(StrEnum):
    """How far an order has come."""

    DESIGNED = "designed"
    CHECKED = "checked"
    SENT = "sent"
    IN_PRODUCTION = "in production"
    DELIVERED = "delivered"
    ADJUSTED = "adjusted"
    RETURNED = "returned"


OPEN_STATES: Final = (
    OrderState.DESIGNED,
    OrderState.CHECKED,
    OrderState.SENT,
    OrderState.IN_PRODUCTION,
    OrderState.RETURNED,
)
"""States in which somebody still has something to do."""
USUAL_DAYS_UNTIL_DUE: Final = 14
MOST_DAYS_UNTIL_DUE: Final = 365


@dataclass(frozen=True)
class OrderFile:
    """A file that was made for the shop, stored with the order.

    Parameters
    ----------
    size
        Bytes.
    """

    name: str
    content_sha256: str
    size: int


@dataclass(frozen=True)
class OrderEvent:
    """A step of an order; `from_state` is None for the first one."""

    seq: int
    at: str
    author: str
    from_state: OrderState | None
    to_state: OrderState
    remarks: str


@dataclass(frozen=True)
class Order:
    """What is made from versions of prescriptions.

    Parameters
    ----------
    number
        Unique; what the shop knows the patient by.
    version_ids
        Of the prescriptions, which are closed.
    """

    id: str
    number: str
    visit_id: str
    person_id: str
    state: OrderState
    shop: str
    due_on: date | None
    remarks: str
    version_ids: tuple[str, ...]
    files: tuple[OrderFile, ...]
    events: tuple[OrderEvent, ...]
    created_at: str
    changed_at: str
    revision: int


@dataclass(frozen=True)
class OrderSummary:
    """An order in a list of several persons."""

    id: str
    number: str
    person_id: str
    person_name: str
    visit_id: str
    state: OrderState
    shop: str
    due_on: date | None
    revision: int

    def is_overdue(self, today: date) -> bool:
        """Return whether it should have been delivered by now."""
        return self.state in OPEN_STATES and self.due_on is not None and self.due_on < today
