"""What became of a visit or an order, as a value."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import date
from typing import Annotated

from insole_core.records.marks import EMPTIED, WHEN
from insole_core.records.person import new_id
from insole_core.records.record_field import Day, Line, Lines


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
