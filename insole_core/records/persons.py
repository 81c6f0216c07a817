"""The persons of the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date
from typing import Any, Final

from sqlalchemy import (
    ColumnElement,
    Connection,
    ScalarSelect,
    Select,
    and_,
    case,
    func,
    insert,
    select,
    tuple_,
    update,
)

from insole_core.cases.sample import SAMPLE_KEEPS_NAME, SAMPLE_PSEUDONYM
from insole_core.errors import Conflict, InputError
from insole_core.records.author import utc_now
from insole_core.records.checked_values import highest
from insole_core.records.context import RecordsContext
from insole_core.records.merging import (
    Merge,
    MergePreview,
    NamedMerge,
    latest_merges,
    merge_persons,
    preview_merge,
    undo_merge,
)
from insole_core.records.person import SUMMARISED, Person, PersonSummary, new_pseudonym
from insole_core.records.person_matching import MOST_KEY, name_key_of, search_words
from insole_core.records.record_field import changed_fields, fields_of
from insole_core.records.rights import Right
from insole_core.records.rows import (
    PERSON_FIELDS,
    found_by,
    locked_person,
    person_of,
    touch_person,
    write_search_text,
)
from insole_core.records.schema import person_words, persons, visits

_LAST_CHARACTER: Final = "\U0010ffff"
_MOST_VALUES: Final = 500
_FEW: Final = 500
"""If more have each of the words, many names that begin with the first are likely to fit."""
_MANY: Final = 2000
"""Less are looked at one by one in some ten milliseconds; of more, many are likely to fit."""
_SUMMARY: Final = tuple(persons.c[name] for name in SUMMARISED)
_CAN_BE_FOUND: Final = (persons.c.merged_into.is_(None), persons.c.is_erased.is_(False))


class Persons:
    """Finds, adds and changes persons."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def search(self, typed: str, limit: int = 50) -> list[PersonSummary]:
        """Find persons by beginnings of words of all that they are known by.

        That is name, birth date, personal number, pseudonym and numbers of orders.

        Parameters
        ----------
        typed
            Every word must begin one of theirs; case, accents and signs in numbers do not matter.
            Without words, the recent ones.

        Returns
        -------
        list[PersonSummary]
            Those whose name begins with the first word come first.
        """
        words = search_words(typed)
        if not words:
            return self.recent(limit)
        with self._context.reading() as connection:
            counts = {word: _count(connection, word) for word in words}
            rarest = min(words, key=counts.__getitem__)
            found = []
            if counts[rarest] >= _FEW:
                found = _found(connection, _by_name(words).limit(limit))
            if counts[rarest] < _MANY and len(found) < limit:
                found = _found(connection, _by_word(rarest, words, limit))
            elif len(found) < limit:
                found += _found(connection, _by_rest(words).limit(limit - len(found)))
        return found

    def listed(
        self, typed: str, sorted_by: str, limit: int, *, is_descending: bool = False
    ) -> list[PersonSummary]:
        """Return everybody, or whom `search` finds, in the order of one of their fields.

        Parameters
        ----------
        typed
            As for `search`; empty for everybody.
        sorted_by
            A field that is listed, or "last_visit"; whose is empty comes last.
        """
        column = _sorting_column(sorted_by)
        column = column.desc() if is_descending else column.asc()
        query = _listed().where(*(_holds(word) for word in search_words(typed)))
        query = query.order_by(column.nulls_last(), persons.c.sort_key, persons.c.id)
        return self._summaries(query.limit(limit))

    def recent(self, limit: int = 20) -> list[PersonSummary]:
        """Return those who were seen or changed last, the latest first."""
        return self._summaries(_listed().order_by(persons.c.last_seq.desc()).limit(limit))

    def everybody(self) -> list[PersonSummary]:
        """Return all who can be found, to compare a list of others with them."""
        return self._summaries(_listed())

    def alike(self) -> list[PersonSummary]:
        """Return those who may be here twice: by personal number, or by name and birth date."""
        number, name_key, born = persons.c.personal_number, persons.c.name_key, persons.c.birth_date
        several = func.count() > 1
        numbers = select(number).where(number != "").group_by(number).having(several)
        named = select(name_key, born).where(name_key != "", born.is_not(None))
        names = named.group_by(name_key, born).having(several)
        with self._context.reading() as connection:
            same_number = _found(connection, _listed().where(number.in_(numbers)))
            same_name = _found(connection, _listed().where(tuple_(name_key, born).in_(names)))
        return list(dict.fromkeys([*same_number, *same_name]))

    def with_number(self, personal_number: str) -> list[PersonSummary]:
        """Return those who have a personal number, as it is stored."""
        return self._summaries(_listed().where(persons.c.personal_number == personal_number))

    def namesakes(self, name: str, birth_date: date | None) -> list[PersonSummary]:
        """Return those of a name and birth date, the latest first; case and accents do not matter.

        Parameters
        ----------
        birth_date
            None for those whose birth date is not known, either.
        """
        same_name = persons.c.name_key == name_key_of(name)[:MOST_KEY]
        query = _listed().where(same_name, persons.c.birth_date == birth_date)
        return self._summaries(query.order_by(persons.c.last_seq.desc()))

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
        with self._context.writing(Right.SEE) as connection:
            person = person_of(connection, person_id)
            touch_person(connection, person.id)
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
            (stored,) = add_persons(self._context, connection, [person])
            return stored

    def sample(self) -> Person | None:
        """Return the sample patient; None where it was removed."""
        with self._context.reading() as connection:
            query = select(persons.c.id).where(persons.c.pseudonym == SAMPLE_PSEUDONYM)
            found = connection.execute(query).scalar()
            return None if found is None else person_of(connection, found)

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
            changed = changed_fields(stored, person)
            if stored.revision != revision:
                raise Conflict(
                    person,
                    stored,
                    "Somebody else has changed the fields of this person meanwhile; choose which "
                    "to keep.",
                )
            if not changed:
                return stored
            if stored.is_sample and not {"name", "pseudonym"}.isdisjoint(changed):
                raise InputError(SAMPLE_KEEPS_NAME)
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

    def _summaries(self, query: Select[Any]) -> list[PersonSummary]:
        with self._context.reading() as connection:
            return _found(connection, query)


def add_persons(
    context: RecordsContext, connection: Connection, added: Sequence[Person]
) -> list[Person]:
    """Add persons, at least one, within a transaction; return them as they are stored.

    Raises
    ------
    InputError
        When a field cannot be right, or a pseudonym is that of somebody else.
    """
    now, today = utc_now(), date.today()
    taken = _taken(connection, [person.pseudonym for person in added])
    stored = []
    for given in added:
        person = _with_free_pseudonym(connection, given.checked(today), taken)
        taken.add(person.pseudonym)
        stored.append(replace(person, created_at=now, changed_at=now, revision=1))
    connection.execute(insert(persons), [_values(person) for person in stored])
    context.log_each(connection, "added", "person", [person.id for person in stored])
    return stored


def _values(person: Person) -> dict[str, Any]:
    """Return the columns of a person without orders."""
    return {name: getattr(person, name) for name in PERSON_FIELDS} | found_by(person)


def _listed() -> Select[Any]:
    """Return the query of the summaries of all who can be found."""
    return select(*_SUMMARY, _last_visit(persons.c.id)).where(*_CAN_BE_FOUND)


def _sorting_column(name: str) -> ColumnElement[Any] | ScalarSelect[date | None]:
    if name == "last_visit":
        return _last_visit(persons.c.id)
    if name == "name":
        return persons.c.sort_key
    column, field = persons.c[name], fields_of(Person)[name]
    return func.nullif(column, "") if field.kind is str else column


def _last_visit(person_id: ColumnElement[str]) -> ScalarSelect[date | None]:
    of_person = visits.c.person_id == person_id
    return select(highest(visits.c.visited_on)).where(of_person).scalar_subquery()


def _found(connection: Connection, query: Select[Any]) -> list[PersonSummary]:
    return [PersonSummary(*row) for row in connection.execute(query)]


def _count(connection: Connection, word: str) -> int:
    """Return how many words begin with this one, up to `_MANY`."""
    begun = select(person_words.c.word).where(_begins(person_words.c.word, word)).limit(_MANY)
    return int(connection.execute(select(func.count()).select_from(begun.subquery())).scalar_one())


def _by_word(rarest: str, words: list[str], limit: int) -> Select[Any]:
    """Return the query that looks at those only who have one of the words, less than `_MANY`."""
    begun = select(person_words.c.person_id).where(_begins(person_words.c.word, rarest))
    of_word = begun.distinct().subquery()

    def looked_up(value: ColumnElement[Any]) -> ScalarSelect[Any]:
        """Return a value of one person: where they are joined, databases read all persons."""
        return select(value).where(persons.c.id == of_word.c.person_id).scalar_subquery()

    wanted = and_(*_CAN_BE_FOUND, *(_holds(word) for word in words if word != rarest))
    found = select(of_word.c.person_id, looked_up(persons.c.sort_key).label("sort_key"))
    found_ones = found.where(looked_up(wanted)).limit(_MANY).subquery()
    begins_name = case((_begins(found_ones.c.sort_key, words[0]), 0), else_=1)
    listed = select(found_ones, begins_name.label("rank"))
    listed_ones = listed.order_by("rank", found_ones.c.sort_key).limit(limit).subquery()
    query = select(*_SUMMARY, _last_visit(persons.c.id))
    query = query.join(listed_ones, listed_ones.c.person_id == persons.c.id)
    return query.order_by(listed_ones.c.rank, listed_ones.c.sort_key)


def _by_name(words: list[str]) -> Select[Any]:
    """Return the query of those whose name begins with the first word; an index finds them."""
    wanted = (_begins(persons.c.sort_key, words[0]), *(_holds(word) for word in words[1:]))
    return _listed().where(*wanted).order_by(persons.c.sort_key)


def _by_rest(words: list[str]) -> Select[Any]:
    """Return the query of all others; as many have each of the words, some are soon found."""
    others = (~_begins(persons.c.sort_key, words[0]), *(_holds(word) for word in words))
    return _listed().where(*others).order_by(persons.c.sort_key)


def _begins(column: ColumnElement[str], word: str) -> ColumnElement[bool]:
    return and_(column >= word, column < f"{word}{_LAST_CHARACTER}")


def _holds(word: str) -> ColumnElement[bool]:
    return persons.c.search_text.contains(f" {word}", autoescape=True)


def _with_free_pseudonym(connection: Connection, person: Person, taken: set[str]) -> Person:
    """Return the person with a pseudonym that nobody has; a drawn one is drawn anew."""
    while person.pseudonym in taken and person.pseudonym.startswith("P-"):
        person = replace(person, pseudonym=new_pseudonym())
        taken |= _taken(connection, [person.pseudonym])
    if person.pseudonym in taken:
        raise _is_taken(person)
    return person


def _check_free(connection: Connection, person: Person) -> None:
    if _taken(connection, [person.pseudonym]):
        raise _is_taken(person)


def _is_taken(person: Person) -> InputError:
    return InputError(
        "Another person has the pseudonym {pseudonym}; choose another one.",
        pseudonym=person.pseudonym,
    )


def _taken(connection: Connection, pseudonyms: Sequence[str]) -> set[str]:
    """Return those pseudonyms that somebody has; a statement takes `_MOST_VALUES` of them."""
    found: set[str] = set()
    for begin in range(0, len(pseudonyms), _MOST_VALUES):
        some = pseudonyms[begin : begin + _MOST_VALUES]
        query = select(persons.c.pseudonym).where(persons.c.pseudonym.in_(some))
        found |= set(connection.execute(query).scalars())
    return found
