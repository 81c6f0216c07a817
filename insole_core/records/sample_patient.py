"""The sample patient of the record: invented, marked, and no reason to keep or back up anything.

It is known by its pseudonym, of which a record holds only one. What is left of one that was
removed is a row without a name, as of anybody who was erased.
"""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING, Final

from sqlalchemy import Connection, and_, exists, func, or_, select

from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.records.retention import ErasureReason, erase_in
from insole_core.records.rights import Right
from insole_core.records.schema import accounts, persons, visits

if TYPE_CHECKING:
    from insole_core.records.context import RecordsContext


_HAS_VISITS: Final = exists().where(visits.c.person_id == persons.c.id)
_IS_REAL: Final = and_(
    persons.c.pseudonym != SAMPLE_PSEUDONYM, or_(~persons.c.is_erased, _HAS_VISITS)
)


def has_patients(connection: Connection) -> bool:
    """Return whether the record holds anything of a real patient."""
    return connection.execute(select(persons.c.id).where(_IS_REAL).limit(1)).first() is not None


def count_patients(connection: Connection) -> int:
    """Return of how many real patients the record holds anything."""
    is_one = (_IS_REAL, persons.c.merged_into.is_(None))
    query = select(func.count()).select_from(persons).where(*is_one)
    return int(connection.execute(query).scalar_one())


def holds_only_sample(connection: Connection) -> bool:
    """Return whether nothing but the sample patient was ever entered, and no account was made."""
    others = select(persons.c.id).where(persons.c.pseudonym != SAMPLE_PSEUDONYM).limit(1)
    found = (connection.execute(query).first() for query in (others, select(accounts.c.id)))
    return not any(found)


def is_untouched(context: RecordsContext) -> bool:
    """Return whether the record never held anybody, as that of a first start."""
    with context.database.reading() as connection:
        count = select(func.count()).select_from(persons)
        return connection.execute(count).scalar_one() == 0


def remove_sample(context: RecordsContext) -> None:
    """Remove the sample patient with all that was tried on it; nothing where there is none.

    Raises
    ------
    NotAllowed
    RecordsError
        When the record cannot be written.
    """
    with context.writing(Right.WRITE) as connection:
        query = select(persons.c.id).where(persons.c.pseudonym == SAMPLE_PSEUDONYM)
        person_id = connection.execute(query).scalar()
        if person_id is not None:
            erase_in(connection, context, person_id, ErasureReason.SAMPLE, date.today())
