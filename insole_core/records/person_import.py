"""Adding persons of a list to the record: first what would be done, then in one transaction."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final, Protocol

from sqlalchemy import Connection, select

from insole_core.folded_text import fold
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.records.person import Person, PersonSummary
from insole_core.records.person_matching import PersonIndex, born_text, name_key_of, summary_of
from insole_core.records.person_table import IMPORTED, NAME_PARTS, PersonRow, PersonRows
from insole_core.records.persons import add_persons
from insole_core.records.records import Records
from insole_core.records.rights import Right
from insole_core.records.rows import PERSON_FIELDS
from insole_core.records.schema import audit_head, persons

_Line = tuple[str, str, str]
"""Key of a name, the field, and a line of it without case and accents."""
_TOLD: Final = tuple(
    name
    for name, field in IMPORTED.items()
    if field.kind is str and name not in (*NAME_PARTS, "personal_number", "pseudonym")
)
"""Texts about a person that do not say who it is."""
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


def plan_import(records: Records, rows: PersonRows) -> ImportPlan:
    """Return what becomes of the rows of a table; nothing is added.

    A person is there already where personal number or pseudonym, or name and birth date are the
    same. A row without number and birth date is there already where all that it says is: name,
    contact, notes and other texts. Who only may be somebody else is doubtful. Nothing that the
    record holds of a person is changed.

    Raises
    ------
    RecordsError
    """
    with records.context.reading() as connection:
        return _plan(connection, rows)


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
    with records.context.writing(Right.WRITE) as connection:
        connection.execute(select(audit_head).with_for_update())  # one import after the other
        plan = _plan(connection, rows)
        added = list(plan.persons(with_doubtful=with_doubtful))
        for begin in range(0, len(added), _AT_ONCE):
            progress.step(begin / len(added), "Adding persons")
            add_persons(records.context, connection, added[begin : begin + _AT_ONCE])
    return plan


def _plan(connection: Connection, rows: PersonRows) -> ImportPlan:
    """Return what becomes of the rows, as the record is in a transaction."""
    planner = _Planner(_known_persons(connection))
    lines = [ImportLine(row.line, Outcome.REFUSED, row.reason) for row in rows.refused]
    lines += [planner.planned(row) for row in rows.accepted]
    return ImportPlan(tuple(sorted(lines, key=lambda line: line.line)))


def _known_persons(connection: Connection) -> list[Person]:
    """Return everybody in the record, and whoever was merged into them: they are there, too."""
    columns = (persons.c[name] for name in PERSON_FIELDS)
    return [
        Person(*row)
        for row in connection.execute(select(*columns).where(persons.c.is_erased.is_(False)))
    ]


class _Planner:
    """Compares each row with the record and with the rows before it."""

    def __init__(self, known: Iterable[Person]) -> None:
        self._index = PersonIndex(())
        self._doubtful = PersonIndex(())
        """Apart, since they are added only on demand: nobody is doubtful because of them."""
        self._by_line: dict[_Line, list[Person]] = defaultdict(list)
        """Of the record and of the rows before, by what tells people of one name apart."""
        self._line_of: dict[str, int] = {}
        for person in known:
            self._note(person, self._index)

    def planned(self, row: PersonRow) -> ImportLine:
        """Return what becomes of the next row."""
        person = row.person
        match = self._index.find(person)
        same = match if match is not None and match.is_certain else self._doubtful.find(person)
        if same is not None and same.is_certain:
            return self._found(row, same.person)
        held = self._who_holds_all_of(person)
        if held is not None:
            return self._found(row, summary_of(held))
        if self._index.with_pseudonym(person.pseudonym) is not None:
            reason = Message(
                "Another person has the pseudonym {pseudonym}; correct it.",
                pseudonym=person.pseudonym,
            )
            return ImportLine(row.line, Outcome.REFUSED, reason, person)
        self._line_of[person.id] = row.line
        if match is None:
            self._note(person, self._index)
            return ImportLine(row.line, Outcome.NEW, person=person)
        self._note(person, self._doubtful)
        return ImportLine(row.line, Outcome.DOUBTFUL, match.reason, person)

    def _note(self, person: Person, index: PersonIndex) -> None:
        index.add(summary_of(person))
        for line in _lines_of(person):
            self._by_line[line].append(person)

    def _who_holds_all_of(self, person: Person) -> Person | None:
        """Return who is a person without number and birth date, by all that a row says of them."""
        if person.birth_date is not None or person.personal_number:
            return None
        known = self._by_line.get(next(_lines_of(person)), ())
        return next((other for other in known if _holds_all_of(other, person)), None)

    def _found(self, row: PersonRow, same: PersonSummary) -> ImportLine:
        earlier = self._line_of.get(same.id)
        if earlier is not None:
            reason = Message("The same person stands in line {line}.", line=earlier)
            return ImportLine(row.line, Outcome.REPEATED, reason, row.person)
        reason = Message("It is {name}, {born}.", name=same.name, born=born_text(same))
        return ImportLine(row.line, Outcome.PRESENT, reason, row.person)


def _lines_of(person: Person) -> Iterator[_Line]:
    """Yield each line of the texts about them, and last that there is a person of this name."""
    name = name_key_of(person.name)
    for field in _TOLD:
        yield from ((name, field, line) for line in _folded_lines(getattr(person, field)))
    yield name, "", ""


def _holds_all_of(known: Person, person: Person) -> bool:
    """Return whether somebody of the same name has all that a row tells of them.

    Somebody with a birth date or a number, which the row lacks, is the same by the contact only:
    else two of one name would be taken for one.
    """
    is_completed = known.birth_date is not None or bool(known.personal_number)
    if is_completed and not person.contact:
        return False
    return all(_has_lines(getattr(known, field), getattr(person, field)) for field in _TOLD)


def _has_lines(text: str, wanted: str) -> bool:
    return set(_folded_lines(wanted)) <= set(_folded_lines(text))


def _folded_lines(text: str) -> list[str]:
    return [fold(line) for line in text.split("\n") if line]


class Outcomes(Protocol):
    """What becomes of something that is imported."""

    @property
    def outcome(self) -> Outcome:
        """Whether it is added."""


def count_outcomes(lines: Iterable[Outcomes]) -> Message:
    """Return how many there are of each outcome: "3 new, 1 refused"."""
    counts = Counter(line.outcome for line in lines)
    return joined(
        Message("{count} {outcome}", count=counts[outcome], outcome=str(outcome))
        for outcome in Outcome
        if counts[outcome]
    )


def count_added(lines: Sequence[Outcomes], *, with_doubtful: bool) -> Message:
    """Return how many an import has added, and the outcomes: "4 added (3 new, 1 doubtful)".

    Parameters
    ----------
    with_doubtful
        Whether doubtful ones were added.
    """
    added = {Outcome.NEW, Outcome.DOUBTFUL} if with_doubtful else {Outcome.NEW}
    count = sum(line.outcome in added for line in lines)
    return Message("{count} added ({outcomes})", count=count, outcomes=count_outcomes(lines))
