"""From the rows of a table to persons."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import Any

from insole_core.cases.written_dates import read_date
from insole_core.errors import InputError
from insole_core.messages import Message
from insole_core.records.person import Person
from insole_core.records.person_columns import IMPORTED, NAME_PARTS, ColumnMapping
from insole_core.records.personal_numbers import KINDS, check_personal_number
from insole_core.records.record_field import Day, Lines
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

    typed = {
        name: _read(name, table, row, mapping, today) for name in IMPORTED if mapping.columns(name)
    }
    name = " ".join(filter(None, [typed.pop(part, "") for part in NAME_PARTS]))
    number = check_personal_number(typed.pop("personal_number", ""), mapping.number_kind)
    return Person(
        name,
        _agreed_birth_date(typed.pop("birth_date", None), number, mapping.number_kind),
        number,
        mapping.number_kind if number else "",
        **typed,
    ).checked(today)


def _read(name: str, table: TextTable, row: TableRow, mapping: ColumnMapping, today: date) -> Any:
    """Return what a row holds of a field; of several columns each becomes a line."""
    field, columns = IMPORTED[name], mapping.columns(name)
    cells = [(table.headings[number], row.cells[number].strip()) for number in columns]
    cells = [(heading, cell) for heading, cell in cells if cell]
    if isinstance(field, Lines) and field.keeps_headings and len(columns) > 1:
        return "\n".join(f"{heading}: {cell}" if heading else cell for heading, cell in cells)
    text = "\n".join(cell for _, cell in cells)
    if isinstance(field, Day):
        return read_date(text, mapping.date_order) if text else None
    return text if field.kind is str else field.read(text, today)


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
