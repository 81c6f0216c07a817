"""Adding the sample patient, with the case that comes with the product."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import Patient
from insole_core.cases.sample import SAMPLE_PSEUDONYM
from insole_core.geometry.side import Side
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.sample_patient import remove_sample
from insole_core.resources import resource_path
from insole_core.workflows.records.keep_case import add_case

EXAMPLE = "example/example.insole"


def ensure_sample(records: Records, name: str, notes: str, findings: str) -> Person:
    """Return the sample patient; add it with a visit where it is not in the record.

    Parameters
    ----------
    name, notes, findings
        Of patient and visit, in the language of the user; the name says that it is a sample.

    Raises
    ------
    RecordsError, OutputError
        When it cannot be stored; then what was stored of it is removed by `remove_sample`.
    """
    known = records.persons.sample()
    if known is not None:
        return known
    case = read_case(resource_path(EXAMPLE))
    patient = case.patient
    added = records.persons.add(
        Person(name, date.fromisoformat(patient.born), notes=notes, pseudonym=SAMPLE_PSEUDONYM)
    )
    day = min(date.fromisoformat(patient.visit), date.today())
    visited = Patient(visit=day.isoformat(), notes=findings)
    add_case(records, replace(case, patient=visited), added.id)
    return added


def renew_sample(records: Records, name: str, notes: str, findings: str) -> None:
    """Put the sample patient into another language, unless something was tried on it already.

    Parameters
    ----------
    name, notes, findings
        As for `ensure_sample`.

    Raises
    ------
    NotAllowed
    RecordsError, OutputError
        When it cannot be stored.
    """
    known = records.persons.sample()
    if known is not None and known.name != name and _is_as_added(records, known):
        remove_sample(records.context)
        ensure_sample(records, name, notes, findings)


def _is_as_added(records: Records, sample: Person) -> bool:
    visits = records.visits.of_person(sample.id)
    versions = [
        version
        for v in visits
        for side in Side
        for version in records.prescriptions.versions(v.id, side)
    ]
    revisions = {sample.revision, *(v.revision for v in visits), *(v.revision for v in versions)}
    tried: list[object] = [
        *(kind for v in visits for kind, count in records.visits.held(v.id).items() if count),
        *records.follow_ups.of_person(sample.id),  # also those of no visit
    ]
    return len(visits) == len(versions) == 1 and revisions == {1} and tried == ["versions"]
