"""From the rows of a table to persons."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import date

from insole_core.cases.written_dates import read_date
from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.records.person import Person, new_pseudonym
from insole_core.records.person_columns import ColumnMapping, PersonField
from insole_core.records.personal_numbers import KINDS, check_personal_number
from insole_core.records.text_table import TableRow, TextTable


@dataclass(frozen=True)
class PersonRow:
    """A row of which a person can be made.

    Parameters
    ----------
    line
        Of the file, from 1.
    """

    line: int
    person: Person


@dataclass(frozen=True)
class RefusedRow:
    """A row of which no person can be made, and why."""

    line: int
    reason: Message


@dataclass(frozen=True)
class PersonRows:
    """All rows of a table, in their order."""

    accepted: tuple[PersonRow, ...]
    refused: tuple[RefusedRow, ...]


def read_persons(table: TextTable, mapping: ColumnMapping, today: date) -> PersonRows:
    """Read each row as a person that is not in the record yet.

    Raises
    ------
    InputError
        When the mapping is that of another table, or says nothing of the names.
    """
    mapping.check()
    if len(mapping.fields) != len(table.headings):
        raise InputError(
            "The table has {count} columns, and {mapped} are chosen; choose the columns anew.",
            count=len(table.headings),
            mapped=len(mapping.fields),
        )
    accepted, refused = [], []
    for row in table.rows:
        try:
            accepted.append(PersonRow(row.line, _person(table, row, mapping, today)))
        except InputError as error:
            refused.append(RefusedRow(row.line, error.message))
    return PersonRows(tuple(accepted), tuple(refused))


def _person(table: TextTable, row: TableRow, mapping: ColumnMapping, today: date) -> Person:
    if len(row.cells) > len(table.headings):
        raise InputError(
            "The row has {count} cells under {headings} headings; check its quotation marks.",
            count=len(row.cells),
            headings=len(table.headings),
        )

    def text(field: PersonField) -> str:
        return " ".join(_texts(row, mapping, field))

    number = check_personal_number(text(PersonField.PERSONAL_NUMBER), mapping.number_kind)
    born = _day(text(PersonField.BIRTH_DATE), mapping)
    return Person(
        name=_name(text),
        birth_date=_agreed_birth_date(born, number, mapping.number_kind),
        personal_number=number,
        number_kind=mapping.number_kind if number else "",
        contact="\n".join(_texts(row, mapping, PersonField.CONTACT)),
        notes=_notes(table, row, mapping),
        consent_on=_day(text(PersonField.CONSENT_ON), mapping),
        pseudonym=text(PersonField.PSEUDONYM) or new_pseudonym(),
    ).checked(today)


def _texts(row: TableRow, mapping: ColumnMapping, field: PersonField) -> list[str]:
    cells = (row.cells[column].strip() for column in mapping.columns(field))
    return [cell for cell in cells if cell]


def _name(text: Callable[[PersonField], str]) -> str:
    parts = (PersonField.NAME, PersonField.GIVEN_NAME, PersonField.FAMILY_NAME)
    return " ".join(part for part in map(text, parts) if part)


def _day(text: str, mapping: ColumnMapping) -> date | None:
    return read_date(text, mapping.date_order) if text else None


def _agreed_birth_date(born: date | None, number: str, kind: str) -> date | None:
    """Return the birth date of the table; where it has none, that of the personal number.

    Raises
    ------
    InputError
        When they differ.
    """
    of_number = KINDS[kind].birth_date(number) if number else None
    if born is None or of_number is None or born == of_number:
        return born or of_number
    raise InputError(
        "The birth date {born} is not that of the personal number, {of_number}; correct one of "
        "them.",
        born=born.isoformat(),
        of_number=of_number.isoformat(),
    )


def _notes(table: TextTable, row: TableRow, mapping: ColumnMapping) -> str:
    """Return the notes; where several columns hold notes, each with its heading."""
    columns = mapping.columns(PersonField.NOTES)
    if len(columns) < 2:
        return "\n".join(_texts(row, mapping, PersonField.NOTES))
    filled = [(table.headings[n], row.cells[n].strip()) for n in columns]
    return "\n".join(f"{heading}: {cell}" if heading else cell for heading, cell in filled if cell)
