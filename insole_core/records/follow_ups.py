"""The follow-ups of the record."""

from __future__ import annotations

from dataclasses import fields, replace
from datetime import date
from typing import Final

from sqlalchemy import insert, select

from insole_core.records.context import RecordsContext
from insole_core.records.follow_up import FollowUp
from insole_core.records.person_rows import locked_person
from insole_core.records.record_field import check_fields
from insole_core.records.rights import Right
from insole_core.records.schema import follow_ups
from insole_core.records.times import utc_now

_FIELDS: Final = tuple(field.name for field in fields(FollowUp))


class FollowUps:
    """Adds and finds follow-ups."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def add(self, follow_up: FollowUp) -> FollowUp:
        """Add a follow-up; return it as it is stored.

        Raises
        ------
        InputError
            When a field cannot be right.
        RecordsError
            When its person is gone.
        """
        checked = check_fields(follow_up, date.today())
        follow_up = replace(checked, author=self._context.author.name, created_at=utc_now())
        with self._context.writing(Right.WRITE, follow_up.person_id) as connection:
            locked_person(connection, follow_up.person_id)
            connection.execute(insert(follow_ups).values(vars(follow_up)))
            self._context.log(
                connection, "added", "follow up", follow_up.id, person=follow_up.person_id
            )
        return follow_up

    def of_person(self, person_id: str) -> list[FollowUp]:
        """Return the follow-ups of a person, the newest first."""
        query = select(*(follow_ups.c[name] for name in _FIELDS))
        query = query.where(follow_ups.c.person_id == person_id)
        query = query.order_by(follow_ups.c.on_date.desc(), follow_ups.c.created_at.desc())
        with self._context.reading() as connection:
            return [FollowUp(**row._mapping) for row in connection.execute(query)]
