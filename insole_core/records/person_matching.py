"""How persons are found by words, and whether two entries are one person."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from datetime import date
from enum import StrEnum
from itertools import pairwise
from typing import Final

from insole_core.folded_text import fold
from insole_core.messages import Message
from insole_core.records.person import Person, PersonSummary

MOST_KEY: Final = 80
_MOST_WORD: Final = 40
"""Letters of a word that count: an index of any database takes as many."""
_NUMBER: Final = re.compile(r"[./+-]*\d[\d./+-]*")
_FULL_SWEDISH: Final = 12
"""Digits of a personal number with its century."""
_Identity = tuple[date | None, str]
"""Birth date and personal number."""


def sort_key_of(name: str) -> str:
    """Return what persons are sorted by, and found at once by the beginning of their name.

    It is short enough for an index of any database.
    """
    return " ".join(fold(name).split())[:MOST_KEY]


def name_key_of(name: str) -> str:
    """Return the words of a name in one order: "Berg, Anna" is "Anna Berg"."""
    return " ".join(sorted(fold(name).replace(",", " ").split()))


def search_text_of(
    name: str, birth_date: date | None, personal_number: str, numbers: Iterable[str]
) -> str:
    """Return the text that a person is found by.

    Every word follows a space: a person is found by what stands after one. A word that only
    begins another one is left out.

    Parameters
    ----------
    numbers
        Pseudonym and numbers of orders.
    """
    words = [*_words_of(name), *_writings(birth_date), *_words_of_number(personal_number)]
    for number in numbers:
        words += _words_of(number)
    cut = list(dict.fromkeys(word[:_MOST_WORD] for word in words if word))
    longest = [w for w in cut if not any(o.startswith(w) for o in cut if o != w)]
    return "".join(f" {word}" for word in longest)


def search_words(text: str) -> list[str]:
    """Return the words of what somebody typed, as they stand in a search text."""
    words = (_plain(word)[:_MOST_WORD] for word in _split(text))
    return list(dict.fromkeys(word for word in words if word))


def _words_of(text: str) -> Iterator[str]:
    """Yield the words of a text, and what follows a sign within one, as in "Berg-Lund"."""
    for word in _split(text):
        for start in _starts(word):
            yield _plain(word[start:])


def _split(text: str) -> list[str]:
    """Return the folded words of a text: "Berg, Anna" has two, and no comma."""
    return fold(text).replace(",", " ").replace(";", " ").split()


def _starts(word: str) -> Iterator[int]:
    """Yield where somebody may begin to type a word.

    That is at any letter of a script that writes no spaces, or has its article before the word.
    """
    for index, letter in enumerate(word[:_MOST_WORD]):
        follows_sign = index > 0 and letter.isalnum() and not word[index - 1].isalnum()
        if index == 0 or follows_sign or unicodedata.category(letter) == "Lo":
            yield index


def _plain(word: str) -> str:
    """Return the digits alone of a date or number, and any other word as it is.

    In a date as 8.2.1970, days and months get two digits.
    """
    if _NUMBER.fullmatch(word) is None:
        return word
    *first, last = re.split(r"[./]", word)
    return re.sub(r"\D", "", "".join([*(part.rjust(2, "0") for part in first), last]))


def _words_of_number(number: str) -> Iterator[str]:
    """Yield the words of a personal number, all of it in one, and that without its century."""
    joined = "".join(letter for letter in fold(number) if letter.isalnum())
    yield joined
    if len(joined) == _FULL_SWEDISH and joined.isdecimal():
        yield joined[2:]
    yield from _words_of(number)


def _writings(day: date | None) -> list[str]:
    """Return the digits of a date as it is written in Sweden, short, and in other countries."""
    return [] if day is None else [day.strftime(form) for form in ("%Y%m%d", "%y%m%d", "%d%m%Y")]


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
