"""The visits of the record, and their follow-ups."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from datetime import date
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, delete, func, insert, select, update

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.errors import Conflict, RecordsError
from insole_core.geometry.side import Side
from insole_core.messages import Message, joined
from insole_core.records.audit import AuditLog
from insole_core.records.author import utc_now
from insole_core.records.checked_values import word_of
from insole_core.records.context import RecordsContext
from insole_core.records.person import Person
from insole_core.records.prescription import Base
from insole_core.records.prescriptions import Prescriptions
from insole_core.records.record_field import (
    changed_fields,
    check_fields,
    fields_of,
    typed_fields,
)
from insole_core.records.rights import Right
from insole_core.records.rows import (
    all_visits,
    locked_person,
    note_of_visit,
    person_of,
    visit_from,
    visit_of,
    visit_values,
)
from insole_core.records.schema import (
    captures,
    follow_ups,
    orders,
    persons,
    prescription_versions,
    presence,
    visit_photos,
    visits,
)
from insole_core.records.stations import Presence
from insole_core.records.visit import CaptureState, FollowUp, OpenedCase, Visit, VisitSummary

_FIELDS: Final = tuple(field.name for field in fields(FollowUp))


class Visits:
    """Finds, adds and changes visits; deletes empty ones."""

    def __init__(self, context: RecordsContext, prescriptions: Prescriptions) -> None:
        self._context = context
        self._presence = Presence(context)
        self._prescriptions = prescriptions

    def get(self, visit_id: str) -> Visit:
        """Return a visit.

        Raises
        ------
        RecordsError
            When there is none.
        """
        with self._context.reading() as connection:
            return visit_of(connection, visit_id)

    def of_person(self, person_id: str) -> list[Visit]:
        """Return the visits of a person, the newest first."""
        query = all_visits().where(visits.c.person_id == person_id)
        query = query.order_by(visits.c.visited_on.desc(), visits.c.created_at.desc())
        with self._context.reading() as connection:
            return [visit_from(row) for row in connection.execute(query)]

    def on(self, day: date) -> list[VisitSummary]:
        """Return the visits of one day, in the order in which they were added."""
        return self._summaries(_listed().where(visits.c.visited_on == day))

    def work_list(self) -> list[VisitSummary]:
        """Return the visits for which the capture room has something to do, oldest first."""
        return self._summaries(_listed().where(visits.c.capture_state == CaptureState.WANTED))

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
        with self._context.writing(Right.WRITE, visit.person_id) as connection:
            locked_person(connection, visit.person_id)
            connection.execute(insert(visits).values(visit_values(visit)))
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
        with self._context.writing_visit(Right.WRITE, visit.id) as (connection, stored):
            if stored.revision != revision:
                raise Conflict(
                    visit,
                    stored,
                    "Somebody else has changed the fields of this visit meanwhile; choose which "
                    "to keep.",
                )
            changed = changed_fields(stored, visit)
            if not changed:
                return stored
            values = visit_values(visit, changed)
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

    def held(self, visit_id: str) -> dict[str, int]:
        """Return how many scans, photos, versions, orders and follow-ups a visit holds."""
        with self._context.reading() as connection:
            return _held_by(connection, visit_id)

    def delete(self, visit_id: str) -> None:
        """Delete a visit that holds nothing, which the audit log tells.

        Raises
        ------
        NotAllowed
        RecordsError
            When it holds something, somebody else has it open, or it is gone already.
        """
        with self._context.writing_visit(Right.WRITE, visit_id) as (connection, visit):
            _check_empty(connection, visit)
            others = self._presence.others_within(connection, visit_id)
            if others:
                raise RecordsError(
                    "The visit is open at the moment: {who}; close it there before it is deleted.",
                    who=f"{others[0].author}, {others[0].station}",
                )
            connection.execute(delete(presence).where(presence.c.visit_id == visit_id))
            connection.execute(delete(visits).where(visits.c.id == visit_id))
            AuditLog.seal(connection, self._context.author, "visit", [visit_id])
            self._context.log(connection, "deleted", "visit", visit_id, person=visit.person_id)

    def note_seen(self, visit_id: str) -> None:
        """Let the audit log tell that somebody sees a visit, such as one that was open already.

        Raises
        ------
        RecordsError
            When there is no such visit.
        """
        if not self._context.database.is_read_only:
            with self._context.writing_visit(Right.SEE, visit_id) as (connection, visit):
                self._context.log(connection, "seen", "visit", visit_id, person=visit.person_id)

    def open_case(self, visit_id: str) -> OpenedCase:
        """Return a visit as the case that a window works on, which the audit log tells.

        The newest version of each foot is read, with the scan it was made from.

        Raises
        ------
        RecordsError
            When there is no such visit, or a surface is missing or was changed on the disk.
        """
        self.note_seen(visit_id)
        with self._context.reading() as connection:
            visit = visit_of(connection, visit_id)
            person = person_of(connection, visit.person_id)
            rows = self._prescriptions.newest_of(connection, visit_id)
            bases = {word_of(Side, row.side): Base(row.id, row.revision) for row in rows}
            order = note_of_visit(connection, visit)
        record = CaseRecord(patient_of(person, visit), order=order)
        with ThreadPoolExecutor(len(Side)) as pool:  # unpacking takes most of the time
            feet = list(pool.map(self._prescriptions.foot_of, rows))
        for foot in reversed(feet):  # the left foot is shown first
            record = record.with_foot(foot)
        return OpenedCase(record, bases, person, visit)

    def _summaries(self, query: Select[Any]) -> list[VisitSummary]:
        query = query.order_by(visits.c.visited_on, visits.c.created_at)
        with self._context.reading() as connection:
            return [_summary(row) for row in connection.execute(query)]


def patient_of(person: Person, visit: Visit) -> Patient:
    """Return what the patient panel shows of a person on a visit."""
    return Patient(
        name=person.name,
        born="" if person.birth_date is None else person.birth_date.isoformat(),
        visit=visit.visited_on.isoformat(),
        notes=visit.findings,
        pseudonym=person.pseudonym,
    )


def _summary(row: Row[Any]) -> VisitSummary:
    values = dict(row._mapping)
    return VisitSummary(**values | {"capture_state": CaptureState(values["capture_state"])})


def _listed() -> Select[Any]:
    of_visit = (visits.c[f.name] for f in fields(VisitSummary) if f.name in visits.c)
    of_person = persons.c.name.label("person_name"), persons.c.birth_date
    return select(*of_visit, *of_person).join(persons, persons.c.id == visits.c.person_id)


_HELD: Final = {
    "scans": captures,
    "photos": visit_photos,
    "versions": prescription_versions,
    "orders": orders,
    "follow_ups": follow_ups,
}


_SAYS_SOMETHING: Final = {
    "measures",
    *(name for name, field in typed_fields(Visit).items() if not field.is_needed),
}
"""Fields of a visit that are empty in one that was made by mistake."""


def _held_by(connection: Connection, visit_id: str) -> dict[str, int]:
    """Return how many things of each kind were scanned, prescribed or ordered on a visit."""
    counts = {}
    for name, table in _HELD.items():
        query = select(func.count()).select_from(table).where(table.c.visit_id == visit_id)
        counts[name] = int(connection.execute(query).scalar_one())
    return counts


def _check_empty(connection: Connection, visit: Visit) -> None:
    """Check that a visit holds nothing that somebody has found, scanned, prescribed or ordered.

    Raises
    ------
    RecordsError
        Says what it holds.
    """
    day = visit.visited_on.isoformat()
    counts = _held_by(connection, visit.id)
    if any(counts.values()):
        raise RecordsError(
            "The visit of {day} holds scans ({scans}), photos ({photos}), versions of "
            "prescriptions ({versions}), orders ({orders}) or follow-ups ({follow_ups}), and is "
            "kept; only an empty visit can be deleted.",
            day=day,
            **counts,
        )
    filled = [
        Message(field.noun)
        for name, field in fields_of(Visit).items()
        if name in _SAYS_SOMETHING and getattr(visit, name)
    ]
    if filled:
        raise RecordsError(
            "The visit of {day} has {fields}, and is kept; clear this under “Edit…” first if it "
            "was made by mistake.",
            day=day,
            fields=joined(filled),
        )


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
