"""A visit of a person, and what became of it or of its order, as values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from enum import StrEnum
from typing import Annotated

from insole_core.cases.case_record import CaseRecord
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.records.field_checks import MOST_TEXT
from insole_core.records.marks import DEVICE, EMPTIED, STATE, WHEN, unsealed
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base
from insole_core.records.record_field import (
    Day,
    Line,
    Lines,
    Made,
    Number,
    Typed,
    VisitDay,
    check_fields,
    typed_fields,
)


class CaptureState(StrEnum):
    """Whether the capture room has something to do for a visit."""

    NONE = "none"
    WANTED = "wanted"
    DONE = "done"


@dataclass(frozen=True)
class Visit:
    """What was found and measured on one day.

    Parameters
    ----------
    measures
        By name, in the unit that the name ends with, such as ``{"left_length_mm": 251.0}``.
    revision
        Grows with every change; 0 for a visit that is not in the record yet.
    terms
        What the shop is to be told of its order.
    """

    person_id: str
    visited_on: Annotated[date, VisitDay(
        "day of the visit", WHEN, label="Day", is_needed=True, is_told=False, stated="visit",
    )]  # fmt: skip
    reason: Annotated[str, Line(
        "reason", EMPTIED, label="Reason", most=MOST_TEXT, has_breaks=True, is_listed=True,
        fhir="reasonCode",
    )] = ""  # fmt: skip
    findings: Annotated[str, Lines(
        "findings", EMPTIED, label="Findings", fhir="reasonCode",
    )] = ""  # fmt: skip
    weight_kg: Annotated[float | None, Number(
        "weight in kg", EMPTIED, label="Weight (kg)", least=1, most=400,
    )] = None  # fmt: skip
    shoe_size_eu: Annotated[float | None, Number(
        "shoe size", DEVICE, label="Shoe size EU", least=10, most=60,
    )] = None  # fmt: skip
    measures: Annotated[Mapping[str, float], Made(
        "measures", EMPTIED, stored="{}",
    )] = field(default_factory=dict)  # fmt: skip
    capture_state: Annotated[CaptureState, Made(
        "state of the capture", unsealed(STATE), stored=CaptureState.NONE,
    )] = CaptureState.NONE  # fmt: skip
    terms: Annotated[OrderTerms, Made(
        "terms of the order", EMPTIED, stored="{}",
    )] = field(default_factory=OrderTerms)  # fmt: skip
    id: str = field(default_factory=new_id)
    created_at: str = ""
    changed_at: str = ""
    revision: int = 0

    def checked(self, today: date) -> Visit:
        """Return the visit as it is stored.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        return check_fields(self, today)


def fields_of_patient() -> dict[str, Typed]:
    """Return what the fields of a case's patient are, see `visits.patient_of`."""
    person, visit = typed_fields(Person), typed_fields(Visit)
    return {
        "name": person["name"],
        "born": person["birth_date"],
        "visit": visit["visited_on"],
        "notes": person["notes"],
        "pseudonym": person["pseudonym"],
    }


@dataclass(frozen=True)
class VisitSummary:
    """A visit in a list of several persons, such as those of today."""

    id: str
    person_id: str
    person_name: str
    birth_date: date | None
    visited_on: date
    reason: str
    capture_state: CaptureState
    created_at: str


@dataclass(frozen=True, eq=False)
class OpenedCase:
    """A visit as the case that the window works on.

    Parameters
    ----------
    bases
        For each side that has a prescription, the version that it was read from.
    """

    record: CaseRecord
    bases: Mapping[Side, Base]
    person: Person
    visit: Visit


@dataclass(frozen=True)
class FollowUp:
    """What a person said or showed later on.

    Parameters
    ----------
    order_id, visit_id
        What it is about, if it is about one of them.
    outcome
        In a word or two, such as "better"; `notes` say more.
    """

    person_id: str
    on_date: Annotated[date, Day("date of the follow-up", WHEN, label="Day", is_needed=True)]
    outcome: Annotated[str, Line("outcome", EMPTIED, label="Outcome", is_needed=True)]
    notes: Annotated[str, Lines("notes", EMPTIED, label="Notes")] = ""
    order_id: str | None = None
    visit_id: str | None = None
    id: str = field(default_factory=new_id)
    author: str = ""
    created_at: str = ""
