"""An empty visit can be deleted, which the audit log tells; one with anything in it is kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import pytest
from stations import BEN, Stations

from insole_core.cases.case_record import FootRecord
from insole_core.errors import RecordsError
from insole_core.records.captures import MESH
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.verify import verify_record
from insole_core.records.visit import CaptureState, FollowUp, Visit

DAY = date(2026, 11, 20)


@pytest.fixture
def visit(records: Records) -> Visit:
    """A visit that nothing was done on; the capture room waits for it."""
    person = records.persons.add(Person("Anna Berg"))
    return records.visits.add(Visit(person.id, DAY, capture_state=CaptureState.WANTED))


def test_an_empty_visit_is_deleted_and_the_log_tells_it(records: Records, visit: Visit) -> None:
    records.presence.enter(visit.id)
    records.visits.delete(visit.id)
    assert records.visits.of_person(visit.person_id) == []
    assert records.visits.work_list() == []
    (line,) = records.audit.lines(subject_id=visit.id)[:1]
    assert (line.action, line.subject_kind) == ("deleted", "visit")
    assert visit.person_id in line.details
    assert verify_record(records.context).is_sound
    with pytest.raises(RecordsError, match="no longer in the record"):
        records.visits.delete(visit.id)


@pytest.mark.parametrize(
    ("fields", "told"),
    [
        ({"reason": "Heel pain"}, "reason"),
        ({"findings": "Flat foot", "weight_kg": 72.0}, "findings, weight in kg"),
        ({"shoe_size_eu": 42.0}, "shoe size"),
        ({"measures": {"left_length_mm": 251.0}}, "measures"),
    ],
)
def test_a_visit_with_a_field_is_kept(
    records: Records, visit: Visit, fields: dict[str, Any], told: str
) -> None:
    records.visits.change(replace(visit, **fields), visit.revision)
    with pytest.raises(RecordsError, match=f"2026-11-20 has {told}, and is kept"):
        records.visits.delete(visit.id)
    assert records.visits.get(visit.id).revision == 2


Fill = Callable[[Records, Visit, FootRecord, Path], object]


def _scan(records: Records, visit: Visit, _foot: FootRecord, path: Path) -> object:
    path.write_bytes(b"solid")
    return records.captures.add(visit.id, MESH, path)


def _follow_up(records: Records, visit: Visit, _foot: FootRecord, _path: Path) -> object:
    told = FollowUp(visit.person_id, DAY, "No pain any more", visit_id=visit.id)
    return records.follow_ups.add(told)


@pytest.mark.parametrize(
    ("fill", "held"),
    [
        (_scan, r"scans \(1\)"),
        (lambda r, visit, foot, _p: r.prescriptions.save(visit.id, foot, None), r"tions \(1\)"),
        (_follow_up, r"follow-ups \(1\)"),
    ],
)
def test_what_was_scanned_prescribed_or_followed_up_is_kept(
    records: Records,
    visit: Visit,
    foot_record: FootRecord,
    tmp_path: Path,
    fill: Fill,
    held: str,
) -> None:
    fill(records, visit, foot_record, tmp_path / "scan.stl")
    with pytest.raises(RecordsError, match=held):
        records.visits.delete(visit.id)
    assert [kept.id for kept in records.visits.of_person(visit.person_id)] == [visit.id]


def test_a_visit_that_somebody_else_has_open_is_kept(
    stations: Stations, records: Records, visit: Visit
) -> None:
    elsewhere = stations.open(BEN)
    elsewhere.presence.enter(visit.id)
    with pytest.raises(RecordsError, match="open at the moment: ben, capture room"):
        records.visits.delete(visit.id)
    elsewhere.presence.leave(visit.id)
    records.visits.delete(visit.id)
