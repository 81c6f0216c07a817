"""What the pages of the record show, as plain values, and how they write days, states, authors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import Final

from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import corrections_in_words
from insole_core.messages import Message
from insole_core.records.capture import Capture
from insole_core.records.order import (
    Order,
    OrderEvent,
    OrderKey,
    OrderSearch,
    OrderState,
    OrderSummary,
)
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import Lines, listed_fields, told_fields
from insole_core.records.visit import CaptureState, Visit, VisitSummary
from insole_studio.services.person_list import begun_text
from insole_studio.texts import localised, moment_text, tr, translate_core_message
from insole_studio.widgets.row_table import Sorting, TableRow

COLUMNS: Final[tuple[OrderKey, ...]] = (
    "person_name", "number", "release", "state", "due_on", "shop", "ordered_on",
)  # fmt: skip
"""What the columns of the list of orders show, and are sorted by."""

_MOST_LETTERS = 200
"""Of a long text on the card of a visit."""


def day_text(day: date | None) -> str:
    """Return a day as ISO 8601; empty where it is unknown."""
    return "" if day is None else day.isoformat()


def capture_text(state: CaptureState) -> str:
    """Return what the capture room has to do for a visit."""
    return {
        CaptureState.NONE: "",
        CaptureState.WANTED: tr("Waiting"),
        CaptureState.DONE: tr("Captured"),
    }[state]


def scan_text(capture: Capture, sides: Sequence[Side]) -> str:
    """Return when feet were scanned, and when the sensors that did it were calibrated.

    Parameters
    ----------
    sides
        Of the feet that were made of it; none where none was made yet.
    """
    facts = capture.facts
    foot = {Side.LEFT: tr("left foot"), Side.RIGHT: tr("right foot")}
    moment = moment_text(facts.recorded_at or capture.created_at)
    time = ", ".join([moment, *(foot[side] for side in sides)])
    if not facts.sensor_serials:
        return tr("Scan {name}, {time}").format(name=capture.file_name, time=time)
    if not facts.calibrated_on:
        return tr("Captured {time}; calibration of the sensors not recorded").format(time=time)
    day = facts.calibrated_on[:10]
    return tr("Captured {time}; sensors calibrated {day}").format(time=time, day=day)


def reused_scan_text(day: str) -> str:
    """Return that a visit has the scan of an earlier one."""
    return tr("Scan of the visit of {day}, used once more").format(day=day)


def mirrored_text(side: Side) -> str:
    """Return that a foot was not scanned."""
    if side is Side.LEFT:
        return tr("Left foot not scanned: mirrored from the right")
    return tr("Right foot not scanned: mirrored from the left")


def visit_heading(visit: Visit) -> str:
    """Return what is said of a visit beside its day."""
    listed = listed_fields(Visit).items()
    said = (shown_message(field.said(getattr(visit, name))) for name, field in listed)
    return "   ".join(filter(None, said))


def visit_texts(visit: Visit) -> list[str]:
    """Return what was found on a visit: a line for each long text, one for all else."""
    short: list[str] = []
    long: list[str] = []
    for field, said in told_fields(visit):
        if not field.is_listed:
            line = f"{translate_core_message(field.label)}: {shown_message(said)}"
            (long if isinstance(field, Lines) else short).append(line)
    texts = [", ".join(short), *(" ".join(line.split())[:_MOST_LETTERS] for line in long)]
    return [text for text in texts if text]


def shown_message(said: str) -> str:
    """Return what a field says in the language of the window; what was typed is as it is."""
    return translate_core_message(said) if isinstance(said, Message) else said


def prescribed_text(design: InsoleDesign | None) -> str:
    """Return device and corrections of a prescription; empty where it cannot be read."""
    if design is None:
        return ""
    corrections = [translate_core_message(words) for words in corrections_in_words(design)]
    device = translate_core_message(design.device)
    return "; ".join([*filter(None, [device]), *(corrections or [tr("no corrections")])])


def version_text(version: VersionSummary) -> str:
    """Return whose version it is, where it was made, and when it was changed last."""
    parts = [version.author, version.station, moment_text(version.changed_at)]
    if version.signed_by is not None:
        parts.append(tr("signed by {name}").format(name=version.signed_by))
    return ", ".join(parts)


def visit_headings() -> tuple[str, ...]:
    """Return the headings of a list of visits of one day."""
    labels = (translate_core_message(field.label) for field in listed_fields(Visit).values())
    return (tr("Name"), *labels, tr("Capture"), tr("Begun"))


def visit_rows(visits: Sequence[VisitSummary]) -> list[TableRow]:
    """Return the rows of the visits of one day; somebody may have two."""
    return [
        TableRow(
            visit.id,
            (
                visit.person_name,
                *(str(getattr(visit, name)) for name in listed_fields(Visit)),
                capture_text(visit.capture_state),
                begun_text(visit),
            ),
            tip=f"{tr('Begun')} {moment_text(visit.created_at)}",
        )
        for visit in visits
    ]


@dataclass(frozen=True)
class FootLine:
    """What a visit holds of one foot.

    Parameters
    ----------
    text
        Device and corrections of the newest version.
    version
        Its number and author.
    is_signed
        Whether that version is signed.
    """

    side: Side
    text: str
    version: str = ""
    is_signed: bool = False


@dataclass(frozen=True)
class VisitRow:
    """One visit of the time line.

    Parameters
    ----------
    day
        With the time at which it was begun, where that is known: there may be two on one day.
    notes
        A line each: a capture that is waited for, who has it open; what was found; orders.
    photos
        Number of them.
    scan, scan_details
        When it was scanned, and when the sensors were calibrated; and what each step left.
    """

    id: str
    day: str
    reason: str
    feet: tuple[FootLine, ...] = ()
    notes: tuple[str, ...] = ()
    photos: int = 0
    scan: tuple[str, ...] = ()
    scan_details: tuple[str, ...] = ()


@dataclass(frozen=True)
class PictureKey:
    """Which small picture: of a visit, a side, and the foot or its insole."""

    visit: str
    side: Side
    kind: str


@dataclass(frozen=True)
class Trend:
    """A measure over time: its name with the unit, and a value for each of its days, ISO 8601.

    `limits` are half of the 95 % limits of each value; none where they are not known.
    """

    name: str
    days: tuple[str, ...]
    values: tuple[float, ...]
    side: Side | None = None
    limits: tuple[float | None, ...] = ()

    @property
    def change(self) -> float:
        """The last value minus the first one."""
        return self.values[-1] - self.values[0]

    @property
    def change_limit(self) -> float | None:
        """How far the change may be off; None where not known."""
        ends = (self.limits[0], self.limits[-1]) if self.limits else (None, None)
        return None if None in ends else math.hypot(*(limit or 0.0 for limit in ends))

    @property
    def is_within_error(self) -> bool:
        """Whether the change is no larger than its known error."""
        return self.change_limit is not None and abs(self.change) <= self.change_limit

    @property
    def change_text(self) -> str:
        """The change from the first to the last visit, with its ±."""
        change = localised(self.change, "+z.1f")
        if self.change_limit is not None:
            change = f"{change} ± {localised(self.change_limit)}"
        if self.is_within_error:
            change = tr("{change}: within the error").format(change=change)
        return f"{self.side_text} {change}".strip()

    @property
    def side_text(self) -> str:
        """The side; empty for what both feet have in common."""
        return "" if self.side is None else tr("LEFT") if self.side is Side.LEFT else tr("RIGHT")


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
        return _due_text(order, today)
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


def _with_revision(text: str, release: int) -> str:
    """Return a text with the revision that it is about; the first one is not said."""
    if release <= 1:
        return text
    return tr("{number}, revision {revision}").format(number=text, revision=release)


def name_of(order: Order | OrderSummary) -> str:
    """Return what an order is called in a sentence: by its number and a later revision."""
    return _with_revision(tr("Order {number}").format(number=order.number), order.release)


def event_text(event: OrderEvent) -> str:
    """Return a step of an order: when, what became of it, who did it."""
    state = _with_revision(state_text(event.to_state), event.release)
    return f"{moment_text(event.at)}  {state}, {event.author}"


def order_text(order: OrderSummary, today: date) -> str:
    """Return an order as a line of its visit: number, state, due date."""
    parts = (
        name_of(order),
        state_text(order.state),
        tr("due {day}").format(day=_due_text(order, today)) if order.due_on else "",
    )
    return ", ".join(filter(None, parts))


def _due_text(order: OrderSummary, today: date) -> str:
    """Return when an order is due, and whether it is late."""
    day = day_text(order.due_on)
    return tr("{day}, overdue").format(day=day) if order.is_overdue(today) else day
