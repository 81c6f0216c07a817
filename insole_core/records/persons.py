"""The persons of the record."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from typing import Any, Final

from sqlalchemy import (
    ColumnElement,
    Connection,
    Select,
    and_,
    case,
    func,
    insert,
    select,
    update,
)

from insole_core.errors import Conflict, InputError
from insole_core.records.context import RecordsContext
from insole_core.records.merging import (
    Merge,
    MergePreview,
    NamedMerge,
    latest_merges,
    merge_persons,
    merges_of,
    preview_merge,
    undo_merge,
)
from insole_core.records.person import Person, PersonSummary, new_pseudonym
from insole_core.records.person_rows import (
    PERSON_FIELDS,
    locked_person,
    person_of,
    write_search_text,
)
from insole_core.records.rights import Right
from insole_core.records.schema import persons, visits
from insole_core.records.search_text import search_text_of, search_words
from insole_core.records.times import utc_now

_EDITED: Final = (
    "name",
    "birth_date",
    "personal_number",
    "number_kind",
    "contact",
    "notes",
    "consent_on",
    "pseudonym",
)


class Persons:
    """Finds, adds and changes persons."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def search(self, typed: str, limit: int = 50) -> list[PersonSummary]:
        """Find persons by words of name, birth date, personal number, pseudonym and orders.

        Parameters
        ----------
        typed
            Every word must occur; case and accents do not matter. Without words, the recent ones.

        Returns
        -------
        list[PersonSummary]
            Those whose name begins with the first word come first.
        """
        words = search_words(typed)
        if not words:
            return self.recent(limit)
        text = persons.c.search_text
        found = and_(*(_holds(text, word) for word in words))
        rank = case((_begins(text, f" {words[0]}"), 0), (_holds(text, f" {words[0]}"), 1), else_=2)
        return self._summaries(_listed().where(found).order_by(rank, text).limit(limit))

    def recent(self, limit: int = 20) -> list[PersonSummary]:
        """Return those who were seen or changed last, the latest first."""
        return self._summaries(_listed().order_by(persons.c.last_seq.desc()).limit(limit))

    def everybody(self) -> list[PersonSummary]:
        """Return all who can be found, to compare a list of others with them."""
        return self._summaries(_listed())

    def with_number(self, personal_number: str) -> list[PersonSummary]:
        """Return those who have a personal number, as it is stored."""
        return self._summaries(_listed().where(persons.c.personal_number == personal_number))

    def get(self, person_id: str) -> Person:
        """Return a person, or the one that this person was merged into.

        Raises
        ------
        RecordsError
            When there is none.
        """
        with self._context.reading() as connection:
            return person_of(connection, person_id)

    def open(self, person_id: str) -> Person:
        """Return a person to somebody who looks at them, which the audit log tells.

        Raises
        ------
        RecordsError
            When there is none.
        """
        if self._context.database.is_read_only:
            return self.get(person_id)
        with self._context.writing(Right.SEE, person_id) as connection:
            person = person_of(connection, person_id)
            self._context.log(connection, "seen", "person", person.id)
        return person

    def add(self, person: Person) -> Person:
        """Add a person; return them as they are stored.

        Raises
        ------
        InputError
            When a field cannot be right, or the pseudonym is that of somebody else.
        """
        with self._context.writing(Right.WRITE) as connection:
            return add_person(self._context, connection, person)

    def change(self, person: Person, revision: int) -> Person:
        """Store the changed fields of a person; return them as they are stored.

        Parameters
        ----------
        revision
            Of the person that the change is based on.

        Raises
        ------
        InputError
            When a field cannot be right.
        Conflict
            When somebody else has changed the person meanwhile.
        """
        person = person.checked(date.today())
        with self._context.writing(Right.WRITE, person.id) as connection:
            stored = locked_person(connection, person.id)
            changed = [n for n in _EDITED if getattr(person, n) != getattr(stored, n)]
            if stored.revision != revision:
                raise Conflict(
                    person,
                    stored,
                    "Somebody else has changed the fields of this person meanwhile; choose which "
                    "to keep.",
                )
            if not changed:
                return stored
            if "pseudonym" in changed:
                _check_free(connection, person)
            values = {name: getattr(person, name) for name in changed}
            values |= {"changed_at": utc_now(), "revision": revision + 1}
            connection.execute(update(persons).where(persons.c.id == person.id).values(values))
            write_search_text(connection, person.id)
            self._context.log(connection, "changed", "person", person.id, fields=" ".join(changed))
            return person_of(connection, person.id)

    def preview_merge(self, keep_id: str, merge_id: str) -> MergePreview:
        """Return what `merge` would do; nothing is changed.

        Raises
        ------
        RecordsError
            When there is no such person.
        """
        return preview_merge(self._context, keep_id, merge_id)

    def latest_merges(self, limit: int = 100) -> list[NamedMerge]:
        """Return the merges that are not undone, the latest first."""
        return latest_merges(self._context, limit)

    def merge(self, keep_id: str, merge_id: str) -> Merge:
        """Join two persons that turned out to be one.

        Everything of `merge_id` moves to `keep_id`, whose fields stay as they are where they are
        filled in. Whoever asks for the merged person gets the kept one.

        Raises
        ------
        RecordsError
            When they are the same, or one of them was merged or erased already.
        """
        return merge_persons(self._context, keep_id, merge_id)

    def undo_merge(self, merge: Merge) -> None:
        """Take two persons apart again; what was added since stays with the one that was kept.

        Raises
        ------
        RecordsError
            When that has been done already, or a later merge has to be undone first.
        """
        undo_merge(self._context, merge)

    def merges_into(self, person_id: str) -> list[Merge]:
        """Return the merges into a person that are not undone, the latest first."""
        return merges_of(self._context, person_id)

    def _summaries(self, query: Select[Any]) -> list[PersonSummary]:
        with self._context.reading() as connection:
            return [PersonSummary(*row) for row in connection.execute(query)]


def add_person(context: RecordsContext, connection: Connection, person: Person) -> Person:
    """Add a person within a transaction; return them as they are stored.

    Raises
    ------
    InputError
        When a field cannot be right, or the pseudonym is that of somebody else.
    """
    now = utc_now()
    person = _with_free_pseudonym(connection, person.checked(date.today()))
    person = replace(person, created_at=now, changed_at=now, revision=1)
    values = {name: getattr(person, name) for name in PERSON_FIELDS}
    text = search_text_of(
        person.name, person.birth_date, person.personal_number, [person.pseudonym]
    )
    connection.execute(insert(persons).values(**values, search_text=text))
    context.log(connection, "added", "person", person.id)
    return person


def _listed() -> Select[Any]:
    """Return the query of the summaries of all who can be found."""
    last_visit = (
        select(func.max(visits.c.visited_on))
        .where(visits.c.person_id == persons.c.id)
        .scalar_subquery()
    )
    return select(
        persons.c.id,
        persons.c.name,
        persons.c.birth_date,
        persons.c.personal_number,
        persons.c.pseudonym,
        last_visit,
    ).where(persons.c.merged_into.is_(None), persons.c.is_erased.is_(False))


def _holds(text: ColumnElement[str], word: str) -> ColumnElement[bool]:
    return text.contains(word, autoescape=True)


def _begins(text: ColumnElement[str], word: str) -> ColumnElement[bool]:
    return text.startswith(word, autoescape=True)


def _with_free_pseudonym(connection: Connection, person: Person) -> Person:
    """Return the person with a pseudonym that nobody has; a drawn one is drawn anew."""
    while _is_taken(connection, person.pseudonym) and person.pseudonym.startswith("P-"):
        person = replace(person, pseudonym=new_pseudonym())
    _check_free(connection, person)
    return person


def _check_free(connection: Connection, person: Person) -> None:
    if _is_taken(connection, person.pseudonym):
        raise InputError(
            "Another person has the pseudonym {pseudonym}; choose another one.",
            pseudonym=person.pseudonym,
        )


def _is_taken(connection: Connection, pseudonym: str) -> bool:
    query = select(persons.c.id).where(persons.c.pseudonym == pseudonym)
    return connection.execute(query).first() is not None
