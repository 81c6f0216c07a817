"""The argument that names a person."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from insole_core.errors import InputError

if TYPE_CHECKING:
    from insole_core.records.records import Records

_SHOWN = 5


def add_person(parser: argparse.ArgumentParser) -> None:
    """Add the argument."""
    parser.add_argument(
        "person", metavar="PERSON",
        help="pseudonym, personal number, or words that only one person is found by",
    )  # fmt: skip


def person_id_of(records: Records, text: str) -> str:
    """Return the id of the person that a text names.

    Raises
    ------
    InputError
        When it names nobody, or several.
    """
    found = records.persons.search(text) if text.strip() else []
    named = [person for person in found if text in (person.id, person.pseudonym)]
    if len(named or found) == 1:
        return (named or found)[0].id
    if not found:
        raise InputError("Nobody is found by “{text}”; check it with: records list.", text=text)
    some = ", ".join(person.pseudonym for person in found[:_SHOWN])
    raise InputError(
        "“{text}” names several persons ({some}…); give the pseudonym of one of them.",
        text=text,
        some=some,
    )
