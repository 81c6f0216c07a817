"""An order of a visit's insoles, as a value."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from enum import StrEnum
from typing import Annotated, Final, Literal, TypeAlias

from insole_core.records.marks import EMPTIED, MAKER, WHEN
from insole_core.records.record_field import Day, Line, Lines, MadeLine


class OrderState(StrEnum):
    """How far an order has come."""

    DESIGNED = "designed"
    CHECKED = "checked"
    SENT = "sent"
    IN_PRODUCTION = "in production"
    DELIVERED = "delivered"
    ADJUSTED = "adjusted"
    RETURNED = "returned"
    CANCELLED = "cancelled"


OPEN_STATES: Final = (
    OrderState.DESIGNED,
    OrderState.CHECKED,
    OrderState.SENT,
    OrderState.IN_PRODUCTION,
    OrderState.RETURNED,
)
"""States in which somebody still has something to do."""
OrderKey: TypeAlias = Literal[
    "person_name", "number", "release", "state", "due_on", "shop", "ordered_on"
]
USUAL_DAYS_UNTIL_DUE: Final = 14
MOST_DAYS_UNTIL_DUE: Final = 365


@dataclass(frozen=True)
class OrderFile:
    """A file that was made for the shop, stored with the order.

    Parameters
    ----------
    size
        Bytes.
    release
        Of the revision of the order that it belongs to.
    """

    name: str
    content_sha256: str
    size: int
    release: int = 1


@dataclass(frozen=True)
class OrderEvent:
    """A step of an order: another state, or another revision of its papers.

    Parameters
    ----------
    from_state
        None for the first one.
    release
        Number of the revision from then on.
    """

    seq: int
    at: str
    author: str
    from_state: OrderState | None
    to_state: OrderState
    remarks: str
    release: int = 1


@dataclass(frozen=True)
class Order:
    """What is made from versions of prescriptions.

    Parameters
    ----------
    number
        Unique; what the shop knows the patient by.
    release
        Number of the newest revision.
    place
        Folder that its files were written to, on some computer; empty where that is unknown.
    version_ids
        Of the prescriptions of the newest revision, which are closed.
    files
        Of all revisions, the newest first.
    """

    id: str
    number: str
    visit_id: str
    person_id: str
    state: OrderState
    shop: Annotated[str, Line("name of the shop", MAKER, label="Shop")]
    due_on: Annotated[date | None, Day("date that it is due", WHEN, label="Due")]
    remarks: Annotated[str, Lines("remarks", EMPTIED, label="Remarks")]
    release: int
    place: Annotated[str, MadeLine("folder of the order", EMPTIED, most=1000)]
    version_ids: tuple[str, ...]
    files: tuple[OrderFile, ...]
    events: tuple[OrderEvent, ...]
    created_at: str
    changed_at: str
    revision: int

    @property
    def newest_files(self) -> tuple[OrderFile, ...]:
        """The files of the newest revision."""
        return tuple(file for file in self.files if file.release == self.release)


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
    release: int
    ordered_on: date
    revision: int

    def is_overdue(self, today: date) -> bool:
        """Return whether it should have been delivered by now."""
        return self.state in OPEN_STATES and self.due_on is not None and self.due_on < today


@dataclass(frozen=True)
class OrderSearch:
    """Which orders are wanted, and in which order.

    Parameters
    ----------
    states
        All of them for none.
    typed
        Every word must be in the number, the name or number of the person, or the shop.
    person_id
        Whose; empty for everybody's.
    sorted_by
        A field of an `OrderSummary`; what is empty in it comes last.
    """

    states: tuple[OrderState, ...] = ()
    typed: str = ""
    person_id: str = ""
    sorted_by: OrderKey = "due_on"
    is_descending: bool = False
