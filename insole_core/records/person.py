"""A person of the record, as a value."""

from __future__ import annotations

import secrets
import uuid
from dataclasses import dataclass, field, fields, replace
from datetime import date
from typing import Annotated, Final

from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.records.marks import PSEUDONYM, PSEUDONYM_STAYS, TAKEN_OVER
from insole_core.records.personal_numbers import KINDS, MOST_NUMBER, check_personal_number
from insole_core.records.record_field import (
    BirthDate,
    Choice,
    Day,
    Line,
    Lines,
    check_fields,
    typed_fields,
)

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

    name: Annotated[str, Line(
        "name", PSEUDONYM, label="Name", is_needed=True, is_listed=True, stated="name", fhir="name",
        headings=("name", "full name", "patient", "patient name", "person", "namn", "patientnamn",
                  "kund"),
    )]  # fmt: skip
    birth_date: Annotated[date | None, BirthDate(
        "birth date", TAKEN_OVER, label="Born", is_listed=True, stated="born", fhir="birthDate",
        headings=("birth date", "date of birth", "birthday", "born", "dob", "födelsedatum", "född",
                  "födelsedag", "geburtsdatum", "geboren", "geb", "geb datum"),
    )] = None  # fmt: skip
    personal_number: Annotated[str, Line(
        "personal number", TAKEN_OVER, label="Personal number", most=MOST_NUMBER, is_listed=True,
        headings=("personal number", "personal id", "identity number", "national id", "ssn",
                  "personnummer", "pnr", "versichertennummer", "personennummer"),
    )] = ""  # fmt: skip
    number_kind: Annotated[str, Choice(
        "kind of number", TAKEN_OVER, label="Kind of personal number", is_told=False,
        names={kind.key: kind.name for kind in KINDS.values()},
    )] = ""  # fmt: skip
    contact: Annotated[str, Lines(
        "contact", TAKEN_OVER, label="Address, phone", is_low=True, fhir="telecom",
        headings=("contact", "phone", "telephone", "mobile", "email", "mail", "address", "street",
                  "city", "town", "zip", "postcode", "postal code", "telefon", "tel", "mobil",
                  "telefonnummer", "mobilnummer", "epost", "adress", "gata", "gatuadress", "ort",
                  "postort", "postnummer", "kontakt", "adresse", "strasse", "plz", "handy", "stadt",
                  "wohnort"),
    )] = ""  # fmt: skip
    occupation: Annotated[str, Line(
        "occupation", TAKEN_OVER, label="Occupation",
        headings=("occupation", "profession", "job", "work", "yrke", "sysselsättning", "arbete",
                  "beruf", "tätigkeit"),
    )] = ""  # fmt: skip
    consent_on: Annotated[date | None, Day(
        "date of consent", TAKEN_OVER, label="Consent on",
        headings=("consent", "consent date", "date of consent", "samtycke", "samtyckesdatum",
                  "einwilligung"),
    )] = None  # fmt: skip
    pseudonym: Annotated[str, Line(
        "pseudonym", PSEUDONYM_STAYS, label="Pseudonym", most=60, is_needed=True,
        headings=("pseudonym", "patient code", "patientkod"),
    )] = field(default_factory=new_pseudonym)  # fmt: skip
    notes: Annotated[str, Lines(
        "notes", TAKEN_OVER, label="Notes", keeps_headings=True,
        headings=("notes", "note", "remarks", "comment", "comments", "anteckningar", "anteckning",
                  "anmärkning", "kommentar", "notizen", "notiz", "bemerkung", "bemerkungen"),
    )] = ""  # fmt: skip
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
        named = replace(self, pseudonym=self.pseudonym.strip() or new_pseudonym())
        return check_fields(named, today)._with_checked_number()

    def with_typed(self, name: str, text: str, today: date) -> Person:
        """Return the person with a field as it was typed.

        Raises
        ------
        InputError
            When it cannot be right.
        """
        typed = typed_fields(Person)[name].read(text, today)
        changed = replace(self, **{name: typed})
        is_number = name in ("personal_number", "number_kind")
        return changed._with_checked_number() if is_number else changed

    def _with_checked_number(self) -> Person:
        """Return the person with the number as its kind is written."""
        number = check_personal_number(self.personal_number, self.number_kind)
        return replace(self, personal_number=number)


@dataclass(frozen=True)
class PersonSummary:
    """A person in a list: whatever of `Person` is listed, and what tells persons apart.

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


SUMMARISED: Final = tuple(one.name for one in fields(PersonSummary) if one.name != "last_visit")
"""Columns of a person that a `PersonSummary` begins with."""
