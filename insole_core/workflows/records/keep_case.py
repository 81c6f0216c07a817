"""Stores what has changed in the case of a visit: fields of the patient, and each foot."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from datetime import date
from typing import Final

import numpy as np

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.days import read_day
from insole_core.errors import Conflict, RecordsError
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.records.person import Person
from insole_core.records.prescription import Base
from insole_core.records.record_field import FieldChoice, merge_fields, settle_fields
from insole_core.records.records import Records
from insole_core.records.visit import CaptureState, Visit
from insole_core.records.visit_measures import measured_anew, measures_to_store
from insole_core.records.visits import patient_of
from insole_core.workflows.measured_feet import measured_feet

_PATIENT: Final = tuple(field.name for field in fields(Patient))
_TERMS: Final = tuple(field.name for field in fields(OrderTerms))


@dataclass(frozen=True, eq=False)
class CaseChange:
    """What is to be stored of a case.

    Parameters
    ----------
    before
        The patient's fields as they were stored last.
    now
        The case as it is.
    bases
        For each foot that has changed, the version it is based on; None for a new foot.
    editing
        UUID of the editing, as for `Prescriptions.save`; empty for none.
    sent
        The patient's fields as this editing has sent them since `before`, without an answer.
    terms_before
        What the shop is to be told, as it was stored last; None where that is not to be stored.
    """

    visit_id: str
    before: Patient
    now: CaseRecord
    bases: Mapping[Side, Base | None]
    editing: str = ""
    sent: tuple[Patient, ...] = ()
    terms_before: OrderTerms | None = None


@dataclass(frozen=True, eq=False)
class KeptChange:
    """What has been stored of a change.

    Parameters
    ----------
    bases
        Of the feet that were stored.
    conflicts
        Of the feet that somebody else has changed meanwhile; these were not stored.
    collided
        Names of the patient's fields that somebody else has changed meanwhile, too; these were not
        stored, see `theirs`.
    theirs
        The patient as stored now; None if nothing was tried.
    trouble
        Why not everything was tried; None if it was.
    """

    person: Person | None = None
    visit: Visit | None = None
    bases: Mapping[Side, Base] = field(default_factory=dict)
    conflicts: Mapping[Side, Conflict] = field(default_factory=dict)
    collided: tuple[str, ...] = ()
    theirs: Patient | None = None
    trouble: RecordsError | None = None


def keep_case(records: Records, change: CaseChange, reason: str = "") -> KeptChange:
    """Store a change; a foot or field that somebody else has changed is left as it is stored.

    Each part is a transaction of its own, so that a connection which is lost midway loses nothing
    that was stored before.

    Parameters
    ----------
    reason
        Why the versions of the feet are kept; empty while somebody is working on them.
    """
    bases: dict[Side, Base] = {}
    conflicts: dict[Side, Conflict] = {}
    person: Person | None = None
    visit: Visit | None = None
    collided: tuple[str, ...] = ()
    theirs: Patient | None = None
    try:
        visit = records.visits.get(change.visit_id)
        person = records.persons.get(visit.person_id)
        stored, now = patient_of(person, visit), change.now.patient
        before = _as_stored_here(change, stored)
        theirs, collided = merge_fields(before, now, stored, _PATIENT)
        person = _keep_person(records, person, theirs)
        for side, base in change.bases.items():
            foot = change.now.of_side(side)
            assert foot is not None
            try:
                bases[side] = records.prescriptions.save(
                    visit.id, foot, base, reason, change.editing
                )
            except Conflict as conflict:
                newest = records.prescriptions.read(conflict.theirs.id)
                if _are_equal(newest, foot):  # ours, whose acknowledgement was lost
                    bases[side] = Base(conflict.theirs.id, conflict.theirs.revision)
                else:
                    conflicts[side] = conflict
        visit = _keep_visit(records, visit, theirs, change)
    except RecordsError as error:
        return KeptChange(person, visit, bases, conflicts, collided, theirs, error)
    return KeptChange(person, visit, bases, conflicts, collided, theirs)


def _as_stored_here(change: CaseChange, stored: Patient) -> Patient:
    """Return the fields as this editing has stored them last, though its answer was lost."""
    own = {
        name: getattr(stored, name)
        for name in _PATIENT
        if any(getattr(stored, name) == getattr(sent, name) for sent in change.sent)
    }
    return replace(change.before, **own)


def _are_equal(stored: FootRecord, foot: FootRecord) -> bool:
    """Return whether two feet of one visit hold the same prescriptions on the same scan."""
    mine, theirs = (
        (record.variants, record.chosen, record.annotations, record.source.sha256)
        for record in (foot, stored)
    )
    return mine == theirs and np.array_equal(foot.foot.mesh.vertices, stored.foot.mesh.vertices)


def _keep_person(records: Records, person: Person, patient: Patient) -> Person:
    changed = replace(
        person,
        name=patient.name,
        birth_date=date.fromisoformat(patient.born) if patient.born else None,
        pseudonym=patient.pseudonym or person.pseudonym,
    )
    return records.persons.change(changed, person.revision)


def _keep_visit(records: Records, visit: Visit, patient: Patient, change: CaseChange) -> Visit:
    day = date.fromisoformat(patient.visit) if patient.visit else visit.visited_on
    terms = _merged_terms(change, visit.terms)
    visit = replace(visit, visited_on=day, findings=patient.notes, terms=terms)
    if change.bases:
        measures = measured_anew(visit.measures, visit_measures(change.now.feet))
        visit = replace(visit, measures=measures, capture_state=CaptureState.DONE)
    return records.visits.change(visit, visit.revision)


def _merged_terms(change: CaseChange, stored: OrderTerms) -> OrderTerms:
    """Return the stored terms with what was changed here; remarks of both stay."""
    if change.terms_before is None:
        return stored
    now = change.now.order.terms
    merged, collided = merge_fields(change.terms_before, now, stored, _TERMS)
    choices = dict.fromkeys(collided, FieldChoice.MINE)
    if "remarks" in collided and stored.remarks:
        is_there = now.remarks in stored.remarks  # emptied, or stored though its answer was lost
        choices["remarks"] = FieldChoice.THEIRS if is_there else FieldChoice.BOTH
    return settle_fields(merged, now, choices)


def add_case(records: Records, case: CaseRecord, person_id: str = "") -> Visit:
    """Make a visit of a case, for instance of one from a file; return the visit.

    Parameters
    ----------
    person_id
        Whose visit it is; empty for a new person with the data of the case.

    Raises
    ------
    InputError
        When a field of the patient cannot be right.
    RecordsError, OutputError
        When it cannot be stored.
    """
    patient, today = case.patient, date.today()
    if not person_id:
        person_id = records.persons.add(new_person(patient)).id
    day = read_day("visit", patient.visit, today)
    visited_on = date.fromisoformat(day) if day else today
    visit = Visit(
        person_id,
        visited_on,
        findings=patient.notes,
        measures=visit_measures(case.feet),
        terms=case.order.terms,
    )
    visit = records.visits.add(visit)
    for foot in case.feet:
        records.prescriptions.save(visit.id, foot, None)
    return visit


def new_person(patient: Patient) -> Person:
    """Return a person with the data of a case, who is not in the record yet.

    Raises
    ------
    InputError
        When the birth date is none.
    """
    born = read_day("born", patient.born, date.today())
    return Person(patient.name, date.fromisoformat(born) if born else None)


def visit_measures(feet: Iterable[FootRecord]) -> dict[str, float]:
    """Return the measures of feet, with their ±, as a visit stores them.

    Measures that a scan does not show are left out, and feet that were not scanned on this visit.
    """
    return measures_to_store(measured_feet(foot for foot in feet if not foot.foot.scanned_on))
