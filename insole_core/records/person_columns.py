"""Which column of a table holds what of a person: chosen by hand, proposed by the headings."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from insole_core.cases.written_dates import DateOrder, needs_order, order_of
from insole_core.errors import InputError
from insole_core.folded_text import fold
from insole_core.records.personal_numbers import KINDS
from insole_core.records.text_table import TextTable


class PersonField(StrEnum):
    """What a column can hold."""

    NAME = "name"
    GIVEN_NAME = "given name"
    FAMILY_NAME = "family name"
    BIRTH_DATE = "birth date"
    PERSONAL_NUMBER = "personal number"
    CONTACT = "contact"
    NOTES = "notes"
    CONSENT_ON = "date of consent"
    PSEUDONYM = "pseudonym"


SHARED: Final = frozenset({PersonField.CONTACT, PersonField.NOTES})
"""Several columns may hold these, such as street and town; each becomes a line."""
DATES: Final = (PersonField.BIRTH_DATE, PersonField.CONSENT_ON)

_HEADINGS: Final = {
    PersonField.NAME: (
        "name",
        "full name",
        "patient",
        "patient name",
        "person",
        "namn",
        "patientnamn",
        "kund",
    ),
    PersonField.GIVEN_NAME: (
        "first name",
        "given name",
        "forename",
        "förnamn",
        "tilltalsnamn",
        "vorname",
    ),
    PersonField.FAMILY_NAME: (
        "last name",
        "family name",
        "surname",
        "efternamn",
        "nachname",
        "familienname",
    ),
    PersonField.BIRTH_DATE: (
        "birth date",
        "date of birth",
        "birthday",
        "born",
        "dob",
        "födelsedatum",
        "född",
        "födelsedag",
        "geburtsdatum",
        "geboren",
        "geb",
        "geb datum",
    ),
    PersonField.PERSONAL_NUMBER: (
        "personal number",
        "personal id",
        "identity number",
        "national id",
        "ssn",
        "personnummer",
        "pnr",
        "versichertennummer",
        "personennummer",
    ),
    PersonField.CONTACT: (
        "contact",
        "phone",
        "telephone",
        "mobile",
        "email",
        "mail",
        "address",
        "street",
        "city",
        "town",
        "zip",
        "postcode",
        "postal code",
        "telefon",
        "tel",
        "mobil",
        "telefonnummer",
        "mobilnummer",
        "epost",
        "adress",
        "gata",
        "gatuadress",
        "ort",
        "postort",
        "postnummer",
        "kontakt",
        "adresse",
        "strasse",
        "plz",
        "handy",
        "stadt",
        "wohnort",
    ),
    PersonField.NOTES: (
        "notes",
        "note",
        "remarks",
        "comment",
        "comments",
        "anteckningar",
        "anteckning",
        "anmärkning",
        "kommentar",
        "notizen",
        "notiz",
        "bemerkung",
        "bemerkungen",
    ),
    PersonField.CONSENT_ON: (
        "consent",
        "consent date",
        "date of consent",
        "samtycke",
        "samtyckesdatum",
        "einwilligung",
    ),
    PersonField.PSEUDONYM: (
        "pseudonym",
        "patient code",
        "patientkod",
    ),
}
"""Usual headings in English, Swedish and German."""


@dataclass(frozen=True)
class ColumnMapping:
    """What each column of a table holds.

    Parameters
    ----------
    fields
        One for each column; None for a column that is not imported.
    date_order
        Of dates that have two readings; None where the table has none, or nobody has said it.
    number_kind
        Of the personal numbers: a key of `personal_numbers.KINDS`.
    """

    fields: tuple[PersonField | None, ...]
    date_order: DateOrder | None = None
    number_kind: str = ""

    def columns(self, *fields: PersonField) -> list[int]:
        """Return the columns that hold one of some fields, from the left."""
        return [number for number, field in enumerate(self.fields) if field in fields]

    def check(self) -> None:
        """Check that persons can be read.

        Raises
        ------
        InputError
            When no column holds a name, or two hold what a person has once.
        """
        names = (PersonField.NAME, PersonField.GIVEN_NAME, PersonField.FAMILY_NAME)
        if not self.columns(*names):
            raise InputError("No column holds the names; say which one does.")
        if self.columns(PersonField.NAME) and self.columns(*names[1:]):
            raise InputError(
                "One column holds the whole name, and another a part of it; choose either the "
                "whole name, or given name and family name."
            )
        for field in PersonField:
            if field not in SHARED and len(self.columns(field)) > 1:
                raise InputError(
                    "Two columns hold the {field}; choose one of them.", field=str(field)
                )


def propose_mapping(table: TextTable) -> ColumnMapping:
    """Return what the headings say; columns with other headings are left out."""
    fields: list[PersonField | None] = []
    for heading in table.headings:
        field = field_of(heading)
        fields.append(None if field in fields and field not in SHARED else field)
    if PersonField.GIVEN_NAME in fields or PersonField.FAMILY_NAME in fields:
        # Where parts are named, "Patient" or "Name" beside them is one of them, or a number.
        fields = [None if field is PersonField.NAME else field for field in fields]
    mapping = ColumnMapping(tuple(fields))
    numbers = _cells(table, mapping, (PersonField.PERSONAL_NUMBER,))
    return ColumnMapping(mapping.fields, order_of(_cells(table, mapping, DATES)), _kind_of(numbers))


def asks_date_order(table: TextTable, mapping: ColumnMapping) -> bool:
    """Return whether some dates have two readings, so that somebody has to say their order."""
    return needs_order(_cells(table, mapping, DATES))


def field_of(heading: str) -> PersonField | None:
    """Return the field that a heading names; None for an unknown one."""
    return _FIELD_OF.get(_plain(heading))


def _plain(heading: str) -> str:
    """Return a heading as letters only: "E-mail", "e_mail" and "EMAIL" are one."""
    return re.sub(r"[\W\d_]+", "", fold(heading))


_FIELD_OF: Final = {
    _plain(heading): field for field, headings in _HEADINGS.items() for heading in headings
}


def _cells(table: TextTable, mapping: ColumnMapping, fields: Iterable[PersonField]) -> list[str]:
    return [cell for number in mapping.columns(*fields) for cell in table.column(number)]


def _kind_of(numbers: list[str]) -> str:
    """Return the kind of personal number that nearly all of some texts are; "" for any."""
    for key, kind in KINDS.items():
        if key and numbers and sum(_fits(kind.check, n) for n in numbers) > 0.9 * len(numbers):
            return key
    return ""


def _fits(check: Callable[[str], str], number: str) -> bool:
    try:
        check(number)
    except InputError:
        return False
    return True
