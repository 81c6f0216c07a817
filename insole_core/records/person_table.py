"""Persons of a table: which column holds what, proposed by the headings, and what each row says."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from types import MappingProxyType
from typing import Any, Final

from insole_core.cases.written_dates import DateOrder, needs_order, order_of, read_date
from insole_core.errors import InputError
from insole_core.folded_text import fold
from insole_core.messages import Message
from insole_core.records.marks import PSEUDONYM
from insole_core.records.person import Person
from insole_core.records.personal_numbers import KINDS, check_personal_number
from insole_core.records.record_field import Day, Line, Lines, Typed, typed_fields
from insole_core.records.text_table import TableRow, TextTable

GIVEN_NAME: Final = "given_name"
FAMILY_NAME: Final = "family_name"
NAME_PARTS: Final = ("name", GIVEN_NAME, FAMILY_NAME)
"""Of which a name is put together."""


def _imported() -> Iterator[tuple[str, Typed]]:
    fields = typed_fields(Person)
    yield "name", fields.pop("name")
    yield GIVEN_NAME, Line(
        "given name", PSEUDONYM, label="Given name",
        headings=("first name", "given name", "forename", "förnamn", "tilltalsnamn", "vorname"),
    )  # fmt: skip
    yield FAMILY_NAME, Line(
        "family name", PSEUDONYM, label="Family name",
        headings=("last name", "family name", "surname", "efternamn", "nachname", "familienname"),
    )  # fmt: skip
    yield from ((name, field) for name, field in fields.items() if field.headings)


IMPORTED: Final[Mapping[str, Typed]] = MappingProxyType(dict(_imported()))
"""What a column can hold: the fields of a person, and the parts of the name."""
DATES: Final = tuple(name for name, field in IMPORTED.items() if isinstance(field, Day))


def is_shared(name: str | None) -> bool:
    """Return whether several columns may hold a field, such as street and town."""
    return name is not None and isinstance(IMPORTED[name], Lines)


@dataclass(frozen=True)
class ColumnMapping:
    """What each column of a table holds.

    Parameters
    ----------
    fields
        A key of `IMPORTED` for each column; None for a column that is not imported.
    date_order
        Of dates that have two readings; None where the table has none, or nobody has said it.
    number_kind
        Of the personal numbers: a key of `personal_numbers.KINDS`.
    """

    fields: tuple[str | None, ...]
    date_order: DateOrder | None = None
    number_kind: str = ""

    def columns(self, *fields: str) -> list[int]:
        """Return the columns that hold one of some fields, from the left."""
        return [number for number, field in enumerate(self.fields) if field in fields]

    def check(self) -> None:
        """Check that persons can be read.

        Raises
        ------
        InputError
            When no column holds a name, or two hold what a person has once.
        """
        if not self.columns(*NAME_PARTS):
            raise InputError("No column holds the names; say which one does.")
        if self.columns("name") and self.columns(GIVEN_NAME, FAMILY_NAME):
            raise InputError(
                "One column holds the whole name, and another a part of it; choose either the "
                "whole name, or given name and family name."
            )
        for name, field in IMPORTED.items():
            if not is_shared(name) and len(self.columns(name)) > 1:
                raise InputError(
                    "Two columns hold the {field}; choose one of them.", field=field.noun
                )


def propose_mapping(table: TextTable) -> ColumnMapping:
    """Return what the headings say; columns with other headings are left out."""
    fields: list[str | None] = []
    for heading in table.headings:
        field = field_of(heading)
        fields.append(None if field in fields and not is_shared(field) else field)
    if GIVEN_NAME in fields or FAMILY_NAME in fields:
        # Where parts are named, "Patient" or "Name" beside them is one of them, or a number.
        fields = [None if field == "name" else field for field in fields]
    mapping = ColumnMapping(tuple(fields))
    numbers = _cells(table, mapping, ("personal_number",))
    return ColumnMapping(mapping.fields, order_of(_cells(table, mapping, DATES)), _kind_of(numbers))


def asks_date_order(table: TextTable, mapping: ColumnMapping) -> bool:
    """Return whether some dates have two readings, so that somebody has to say their order."""
    return needs_order(_cells(table, mapping, DATES))


def field_of(heading: str) -> str | None:
    """Return the field that a heading names; None for an unknown one."""
    return _FIELD_OF.get(_plain(heading))


def _plain(heading: str) -> str:
    """Return a heading as letters only: "E-mail", "e_mail" and "EMAIL" are one."""
    return re.sub(r"[\W\d_]+", "", fold(heading))


_FIELD_OF: Final = {
    _plain(heading): name for name, field in IMPORTED.items() for heading in field.headings
}


def _cells(table: TextTable, mapping: ColumnMapping, fields: Iterable[str]) -> list[str]:
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
    return text if isinstance(field, Line | Lines) else field.read(text, today)


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
