"""What became of a visit or an order, as a value."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import date

from insole_core.records.person import new_id


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
    on_date: date
    outcome: str
    notes: str = ""
    order_id: str | None = None
    visit_id: str | None = None
    id: str = field(default_factory=new_id)
    author: str = ""
    created_at: str = ""
