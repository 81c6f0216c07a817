"""Persons who may be in the record twice."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from datetime import date
from enum import StrEnum
from itertools import pairwise

from insole_core.records.person import PersonSummary
from insole_core.records.search_text import name_key_of


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
