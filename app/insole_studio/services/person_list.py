"""Lists of persons, and by what persons and visits are told apart in one line."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import date
from typing import Final

from insole_core.records.person import Person, PersonSummary
from insole_core.records.record_field import listed_fields
from insole_core.records.visit import Visit, VisitSummary
from insole_studio.texts import moment_text, tr, translate_core_message
from insole_studio.widgets.row_table import TableRow

COLUMNS: Final = (*listed_fields(Person), "last_visit")
"""By what the columns can be sorted."""


def person_headings() -> tuple[str, ...]:
    """Return the headings of the columns."""
    labels = (translate_core_message(field.label) for field in listed_fields(Person).values())
    return (*labels, tr("Last visit"))


def name_and_birth(name: str, birth_date: date | None) -> str:
    """Return by what namesakes are told apart, where one line names a person."""
    return name if birth_date is None else f"{name}, {birth_date.isoformat()}"


def visit_time_text(visit: Visit | VisitSummary) -> str:
    """Return the day of a visit, with the time at which it was begun if that was on this day."""
    return f"{visit.visited_on.isoformat()} {begun_text(visit)}".strip()


def begun_text(visit: Visit | VisitSummary) -> str:
    """Return the time at which a visit was begun; empty for one that was planned before its day."""
    day, _, time = moment_text(visit.created_at).partition(" ")
    return time if day == visit.visited_on.isoformat() else ""


def identified(person: PersonSummary) -> str:
    """Return who somebody is in one line: also of namesakes who were born on one day."""
    number = person.personal_number or person.pseudonym
    return f"{name_and_birth(person.name, person.birth_date)} ({number})"


def person_rows(persons: Iterable[PersonSummary]) -> list[TableRow]:
    """Return a row for each person."""
    return [TableRow(person.id, tuple(map(_text, _values(person)))) for person in persons]


def _values(person: PersonSummary) -> Iterable[object]:
    return (getattr(person, name) for name in COLUMNS)


def _text(value: object) -> str:
    """Return a value as text: a day as ISO 8601, nothing for what is unknown."""
    return "" if value is None else str(value)
