"""A visit of a person, as a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from enum import StrEnum

from insole_core.cases.case_record import CaseRecord
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.records.field_checks import check_number, check_text, check_visit_day
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base


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
    visited_on: date
    reason: str = ""
    findings: str = ""
    weight_kg: float | None = None
    shoe_size_eu: float | None = None
    measures: Mapping[str, float] = field(default_factory=dict)
    capture_state: CaptureState = CaptureState.NONE
    id: str = field(default_factory=new_id)
    created_at: str = ""
    changed_at: str = ""
    revision: int = 0
    terms: OrderTerms = field(default_factory=OrderTerms)

    def checked(self, today: date) -> Visit:
        """Return the visit as it is stored.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        return replace(
            self,
            visited_on=check_visit_day(self.visited_on, today),
            reason=check_text(self.reason, "reason of the visit"),
            findings=check_text(self.findings, "findings"),
            weight_kg=check_number(self.weight_kg, "weight in kg", 1, 400),
            shoe_size_eu=check_number(self.shoe_size_eu, "shoe size", 10, 60),
        )


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
