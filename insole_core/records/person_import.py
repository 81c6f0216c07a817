"""Adding persons of a list to the record: first what would be done, then in one transaction."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.records.person import Person, PersonSummary
from insole_core.records.person_matching import PersonIndex, summary_of
from insole_core.records.persons import add_persons
from insole_core.records.persons_of_table import PersonRow, PersonRows
from insole_core.records.records import Records
from insole_core.records.rights import Right

_AT_ONCE: Final = 500
"""Persons between two looks at whether the user has cancelled."""


class Outcome(StrEnum):
    """What becomes of a row."""

    NEW = "new"
    PRESENT = "already there"
    REPEATED = "twice in the file"
    DOUBTFUL = "doubtful"
    REFUSED = "refused"


@dataclass(frozen=True)
class ImportLine:
    """What becomes of one row, and why.

    Parameters
    ----------
    line
        Of the file.
    reason
        Empty where there is nothing to say.
    person
        None for a row of which no person can be made.
    """

    line: int
    outcome: Outcome
    reason: str = ""
    person: Person | None = None


@dataclass(frozen=True)
class ImportPlan:
    """What becomes of all rows, in the order of the file."""

    lines: tuple[ImportLine, ...]

    def of(self, *outcomes: Outcome) -> list[ImportLine]:
        """Return the lines with some outcomes."""
        return [line for line in self.lines if line.outcome in outcomes]

    def persons(self, *, with_doubtful: bool) -> Iterator[Person]:
        """Yield the persons to add."""
        outcomes = (Outcome.NEW, Outcome.DOUBTFUL) if with_doubtful else (Outcome.NEW,)
        yield from (line.person for line in self.of(*outcomes) if line.person is not None)


def plan_import(rows: PersonRows, known: Iterable[PersonSummary]) -> ImportPlan:
    """Return what becomes of the rows of a table.

    A person is there already where personal number or pseudonym, or name and birth date are the
    same; who only may be is doubtful. Nothing that the record holds of a person is changed.

    Parameters
    ----------
    known
        Everybody in the record.
    """
    planner = _Planner(known)
    lines = [ImportLine(row.line, Outcome.REFUSED, row.reason) for row in rows.refused]
    lines += [planner.planned(row) for row in rows.accepted]
    return ImportPlan(tuple(sorted(lines, key=lambda line: line.line)))


def import_persons(
    records: Records, rows: PersonRows, *, with_doubtful: bool = False, progress: Progress = SILENT
) -> ImportPlan:
    """Add the persons of a table that are not in the record, all or none.

    Parameters
    ----------
    with_doubtful
        Whether doubtful ones are added, too; they can be merged with others later.

    Returns
    -------
    ImportPlan
        What was done. It differs from one made before where somebody else has added persons
        meanwhile.

    Raises
    ------
    RecordsError
        When the record cannot be written, or the account may not.
    Cancelled
        Then nobody was added.
    """
    plan = plan_import(rows, records.persons.everybody())
    added = list(plan.persons(with_doubtful=with_doubtful))
    with records.context.writing(Right.WRITE) as connection:
        for begin in range(0, len(added), _AT_ONCE):
            progress.step(begin / len(added), "Adding persons")
            add_persons(records.context, connection, added[begin : begin + _AT_ONCE])
    return plan


class _Planner:
    """Compares each row with the record and with the rows before it."""

    def __init__(self, known: Iterable[PersonSummary]) -> None:
        self._index = PersonIndex(known)
        self._doubtful = PersonIndex(())
        """Apart, since they are added only on demand: nobody is doubtful because of them."""
        self._line_of: dict[str, int] = {}

    def planned(self, row: PersonRow) -> ImportLine:
        """Return what becomes of the next row."""
        person = row.person
        match = self._index.find(person)
        same = match if match is not None and match.is_certain else self._doubtful.find(person)
        if same is not None and same.is_certain:
            return self._found(row, same.person)
        if self._index.with_pseudonym(person.pseudonym) is not None:
            reason = Message(
                "Another person has the pseudonym {pseudonym}; correct it.",
                pseudonym=person.pseudonym,
            )
            return ImportLine(row.line, Outcome.REFUSED, reason, person)
        self._line_of[person.id] = row.line
        if match is None:
            self._index.add(summary_of(person))
            return ImportLine(row.line, Outcome.NEW, person=person)
        self._doubtful.add(summary_of(person))
        return ImportLine(row.line, Outcome.DOUBTFUL, match.reason, person)

    def _found(self, row: PersonRow, same: PersonSummary) -> ImportLine:
        earlier = self._line_of.get(same.id)
        if earlier is None:
            return ImportLine(row.line, Outcome.PRESENT, person=row.person)
        reason = Message("The same person stands in line {line}.", line=earlier)
        return ImportLine(row.line, Outcome.REPEATED, reason, row.person)
