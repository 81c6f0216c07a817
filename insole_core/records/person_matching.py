"""Whether two entries are one person: somebody of a list, or twice in the record."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from datetime import date
from enum import StrEnum
from itertools import pairwise

from insole_core.messages import Message
from insole_core.records.person import Person, PersonSummary
from insole_core.records.search_text import name_key_of

_Identity = tuple[date | None, str]
"""Birth date and personal number."""


@dataclass(frozen=True)
class Match:
    """Somebody of the record who is, or may be, the same person.

    Parameters
    ----------
    is_certain
        Whether personal number, pseudonym, or name and birth date say so, and nothing contradicts.
    reason
        Why it is not certain; empty when it is.
    """

    person: PersonSummary
    is_certain: bool
    reason: Message


class PersonIndex:
    """Persons by what tells them apart.

    Parameters
    ----------
    persons
        Of the record.
    """

    def __init__(self, persons: Iterable[PersonSummary]) -> None:
        self._by_number: dict[str, list[PersonSummary]] = defaultdict(list)
        self._by_pseudonym: dict[str, PersonSummary] = {}
        self._by_name: dict[str, list[PersonSummary]] = defaultdict(list)
        self._told_apart: dict[str, dict[_Identity, PersonSummary]] = defaultdict(dict)
        """The first of those of one name who have birth date and number in common."""
        for person in persons:
            self.add(person)

    def add(self, person: PersonSummary) -> None:
        """Add somebody, to be found from now on."""
        if person.personal_number:
            self._by_number[person.personal_number].append(person)
        self._by_pseudonym[person.pseudonym] = person
        name = name_key_of(person.name)
        self._by_name[name].append(person)
        self._told_apart[name].setdefault((person.birth_date, person.personal_number), person)

    def with_pseudonym(self, pseudonym: str) -> PersonSummary | None:
        """Return whom a pseudonym stands for; None when it is free."""
        return self._by_pseudonym.get(pseudonym)

    def find(self, person: Person) -> Match | None:
        """Return who is the same person, or may be; None when nobody resembles them.

        Parameters
        ----------
        person
            Not in the index.
        """
        # A column of towns that is taken for names must not take hours.
        namesakes = self._told_apart.get(name_key_of(person.name), {}).values()
        matches = list(self._matches(person, namesakes))
        return next((match for match in matches if match.is_certain), next(iter(matches), None))

    def matches(self, person: Person) -> Iterator[Match]:
        """Yield everybody who is the same person, or may be."""
        return self._matches(person, self._by_name.get(name_key_of(person.name), ()))

    def _matches(self, person: Person, namesakes: Iterable[PersonSummary]) -> Iterator[Match]:
        of_number = (
            self._by_number.get(person.personal_number, ()) if person.personal_number else ()
        )
        same_pseudonym = self._by_pseudonym.get(person.pseudonym)
        for known in of_number:
            yield _identified(person, known, "personal number")
        if same_pseudonym is not None:
            yield _identified(person, same_pseudonym, "pseudonym")
        for known in namesakes:
            match = _namesake(person, known)
            if match is not None:
                yield match


def summary_of(person: Person) -> PersonSummary:
    """Return a person as they stand in a list."""
    return PersonSummary(
        person.id, person.name, person.birth_date, person.personal_number, person.pseudonym
    )


def _identified(person: Person, known: PersonSummary, what: str) -> Match:
    """Return the match of somebody with the same number; name or birth date must agree, too."""
    same_name = name_key_of(person.name) == name_key_of(known.name)
    dates = {person.birth_date, known.birth_date} - {None}
    if len(dates) < 2 and (same_name or person.birth_date == known.birth_date is not None):
        return Match(known, is_certain=True, reason=Message(""))
    return Match(
        known,
        is_certain=False,
        reason=Message(
            "The {what} is that of {name}, {born}; name or birth date differ.",
            what=what,
            name=known.name,
            born=born_text(known),
        ),
    )


def _namesake(person: Person, known: PersonSummary) -> Match | None:
    """Return the match of somebody of the same name; None when they were born on another day."""
    if None in (person.birth_date, known.birth_date):
        reason = Message(
            "There is somebody of this name, {born}, and a birth date is missing to tell whether "
            "it is the same person.",
            born=born_text(known),
        )
        return Match(known, is_certain=False, reason=reason)
    if person.birth_date != known.birth_date:
        return None
    numbers = {person.personal_number, known.personal_number} - {""}
    if len(numbers) < 2:
        return Match(known, is_certain=True, reason=Message(""))
    reason = Message(
        "There is somebody with this name and birth date, and another personal number."
    )
    return Match(known, is_certain=False, reason=reason)


def born_text(person: PersonSummary) -> Message:
    """Return when somebody was born, in words."""
    if person.birth_date is None:
        return Message("birth date unknown")
    return Message("born {day}", day=person.birth_date.isoformat())


class Likeness(StrEnum):
    """What two persons have in common."""

    NUMBER = "personal number"
    NAME = "name and birth date"


@dataclass(frozen=True)
class Duplicate:
    """Two persons who may be one.

    Parameters
    ----------
    kept
        Proposed to stay: whoever was seen last.
    """

    kept: PersonSummary
    other: PersonSummary
    likeness: Likeness


def find_duplicates(persons: Iterable[PersonSummary]) -> list[Duplicate]:
    """Propose persons to merge, those with the same personal number first.

    Each pair is proposed once; of three who are alike, two pairs.

    Parameters
    ----------
    persons
        Those who may be alike, see `Persons.alike`.
    """
    known = list(persons)
    proposed: dict[frozenset[str], Duplicate] = {}
    for likeness, key in ((Likeness.NUMBER, _number), (Likeness.NAME, _name_and_birth_date)):
        for duplicate in _alike(known, key, likeness):
            pair = frozenset((duplicate.kept.id, duplicate.other.id))
            proposed.setdefault(pair, duplicate)
    return list(proposed.values())


def _alike(
    persons: Iterable[PersonSummary],
    key: Callable[[PersonSummary], Hashable],
    likeness: Likeness,
) -> Iterator[Duplicate]:
    groups: dict[Hashable, list[PersonSummary]] = defaultdict(list)
    for person in persons:
        found = key(person)
        if found is not None:
            groups[found].append(person)
    for group in groups.values():
        latest_first = sorted(group, key=_last_seen, reverse=True)
        for kept, other in pairwise(latest_first):
            yield Duplicate(kept, other, likeness)


def _number(person: PersonSummary) -> str | None:
    return person.personal_number or None


def _name_and_birth_date(person: PersonSummary) -> tuple[str, date] | None:
    return None if person.birth_date is None else (name_key_of(person.name), person.birth_date)


def _last_seen(person: PersonSummary) -> date:
    return person.last_visit or date.min
