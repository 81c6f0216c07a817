"""A person of the record, as a value."""

from __future__ import annotations

import secrets
import uuid
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Final, Literal, TypeAlias

from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.records.field_checks import (
    check_birth_date,
    check_day,
    check_line,
    check_name,
    check_text,
)
from insole_core.records.personal_numbers import check_personal_number

_LETTERS: Final = "23456789CDFGHJKMNPQRTVWXY"  # no vowels, and nothing that looks like another
_PSEUDONYM_LENGTH: Final = 8


def new_id() -> str:
    """Draw the key of a new row."""
    return str(uuid.uuid4())


def new_pseudonym() -> str:
    """Draw what a person is called outside the clinic; it tells nothing of them."""
    drawn = "".join(secrets.choice(_LETTERS) for _ in range(_PSEUDONYM_LENGTH))
    return f"P-{drawn}"


@dataclass(frozen=True)
class Person:
    """Somebody who comes to the clinic.

    Parameters
    ----------
    personal_number, number_kind
        Of a kind in `personal_numbers.KINDS`.
    consent_on
        When they agreed that their data are kept; None when they have not.
    pseudonym
        Stands for the name in all that leaves for the shop; unique.
    merged_into
        The person that this one turned out to be.
    revision
        Grows with every change; 0 for a person that is not in the record yet.
    """

    name: str
    birth_date: date | None = None
    personal_number: str = ""
    number_kind: str = ""
    contact: str = ""
    notes: str = ""
    consent_on: date | None = None
    pseudonym: str = field(default_factory=new_pseudonym)
    id: str = field(default_factory=new_id)
    is_erased: bool = False
    merged_into: str | None = None
    created_at: str = ""
    changed_at: str = ""
    revision: int = 0

    @property
    def is_sample(self) -> bool:
        """Whether this is the invented patient to try the program with (`sample_patient`)."""
        return self.pseudonym == SAMPLE_PSEUDONYM

    def checked(self, today: date) -> Person:
        """Return the person as it is stored.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        return replace(
            self,
            name=check_name(self.name),
            birth_date=check_birth_date(self.birth_date, today),
            personal_number=check_personal_number(self.personal_number, self.number_kind),
            contact=check_text(self.contact, "contact"),
            notes=check_text(self.notes, "notes"),
            consent_on=check_day(self.consent_on, "date of the consent", today),
            pseudonym=check_line(self.pseudonym, "pseudonym", 60) or new_pseudonym(),
        )


@dataclass(frozen=True)
class PersonSummary:
    """A person in a list.

    Parameters
    ----------
    last_visit
        None before the first one.
    """

    id: str
    name: str
    birth_date: date | None
    personal_number: str
    pseudonym: str
    last_visit: date | None = None


PersonKey: TypeAlias = Literal["name", "birth_date", "personal_number", "last_visit"]
"""What a list of persons can be sorted by."""
