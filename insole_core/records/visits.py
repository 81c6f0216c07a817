"""The visits of the record."""

from __future__ import annotations

import json
from dataclasses import fields as fields_of
from dataclasses import replace
from datetime import date
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, insert, select, update

from insole_core.errors import Conflict, RecordsError
from insole_core.records.context import RecordsContext
from insole_core.records.persons import locked_person
from insole_core.records.schema import persons, visits
from insole_core.records.times import utc_now
from insole_core.records.visit import CaptureState, Visit, VisitSummary

_FIELDS: Final = tuple(field.name for field in fields_of(Visit))
_EDITED: Final = (
    "visited_on",
    "reason",
    "findings",
    "weight_kg",
    "shoe_size_eu",
    "measures",
    "capture_state",
)
_WAITING: Final = (CaptureState.WANTED, CaptureState.RUNNING)


class Visits:
    """Finds, adds and changes visits."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def get(self, visit_id: str) -> Visit:
        """Return a visit.

        Raises
        ------
        RecordsError
            When there is none.
        """
        with self._context.database.reading() as connection:
            return visit_of(connection, visit_id)

    def of_person(self, person_id: str) -> list[Visit]:
        """Return the visits of a person, the newest first."""
        query = _all().where(visits.c.person_id == person_id)
        query = query.order_by(visits.c.visited_on.desc(), visits.c.created_at.desc())
        with self._context.database.reading() as connection:
            return [_visit(row) for row in connection.execute(query)]

    def on(self, day: date) -> list[VisitSummary]:
        """Return the visits of one day, in the order in which they were added."""
        return self._summaries(_listed().where(visits.c.visited_on == day))

    def work_list(self) -> list[VisitSummary]:
        """Return the visits for which the capture room has something to do, oldest first."""
        return self._summaries(_listed().where(visits.c.capture_state.in_(_WAITING)))

    def add(self, visit: Visit) -> Visit:
        """Add a visit; return it as it is stored.

        Raises
        ------
        InputError
            When a field cannot be right.
        RecordsError
            When its person is gone.
        """
        now = utc_now()
        visit = visit.checked(date.today())
        visit = replace(visit, created_at=now, changed_at=now, revision=1)
        values = {name: getattr(visit, name) for name in _FIELDS}
        values["measures"] = json.dumps(dict(visit.measures))
        with self._context.writing(visit.person_id) as connection:
            locked_person(connection, visit.person_id)
            connection.execute(insert(visits).values(values))
            self._context.log(connection, "added", "visit", visit.id, person=visit.person_id)
        return visit

    def change(self, visit: Visit, revision: int) -> Visit:
        """Store the changed fields of a visit; return it as it is stored.

        Parameters
        ----------
        revision
            Of the visit that the change is based on.

        Raises
        ------
        InputError
            When a field cannot be right.
        Conflict
            When somebody else has changed the visit meanwhile.
        """
        visit = visit.checked(date.today())
        with self._context.writing(visit.person_id) as connection:
            stored = visit_of(connection, visit.id, locked=True)
            if stored.revision != revision:
                raise Conflict(
                    visit,
                    stored,
                    "Somebody else has changed the fields of this visit meanwhile; choose which "
                    "to keep.",
                )
            changed = [n for n in _EDITED if getattr(visit, n) != getattr(stored, n)]
            if not changed:
                return stored
            values = {name: getattr(visit, name) for name in changed}
            if "measures" in values:
                values["measures"] = json.dumps(dict(visit.measures))
            values |= {"changed_at": utc_now(), "revision": revision + 1}
            connection.execute(update(visits).where(visits.c.id == visit.id).values(values))
            self._context.log(
                connection,
                "changed",
                "visit",
                visit.id,
                person=stored.person_id,
                fields=" ".join(changed),
            )
            return visit_of(connection, visit.id)

    def _summaries(self, query: Select[Any]) -> list[VisitSummary]:
        query = query.order_by(visits.c.visited_on, visits.c.created_at)
        with self._context.database.reading() as connection:
            rows = connection.execute(query).all()
        return [_summary(row) for row in rows]


def visit_of(connection: Connection, visit_id: str, *, locked: bool = False) -> Visit:
    """Return a visit, on demand with its row locked until the transaction ends.

    Raises
    ------
    RecordsError
        When there is none.
    """
    query = _all().where(visits.c.id == visit_id)
    row = connection.execute(query.with_for_update() if locked else query).one_or_none()
    if row is None:
        raise RecordsError("This visit is no longer in the record; open the person again.")
    return _visit(row)


def _all() -> Select[Any]:
    return select(*(visits.c[name] for name in _FIELDS))


def _visit(row: Row[Any]) -> Visit:
    values = dict(zip(_FIELDS, row, strict=True))
    values["measures"] = json.loads(values["measures"])
    values["capture_state"] = CaptureState(values["capture_state"])
    return Visit(**values)


def _summary(row: Row[Any]) -> VisitSummary:
    values = dict(row._mapping)
    return VisitSummary(**values | {"capture_state": CaptureState(values["capture_state"])})


def _listed() -> Select[Any]:
    return select(
        visits.c.id,
        visits.c.person_id,
        persons.c.name.label("person_name"),
        persons.c.birth_date,
        visits.c.visited_on,
        visits.c.reason,
        visits.c.capture_state,
    ).join(persons, persons.c.id == visits.c.person_id)
