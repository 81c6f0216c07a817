"""Versions of prescriptions: kept, continued, closed, and never overwritten."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import numpy as np
import pytest
from sqlalchemy import select, text
from stations import ANNA, BEN, Stations

from insole_core.cases.case_json import case_to_json
from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    KeyPoint,
    ReferencePlane,
    Variant,
)
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import Conflict, RecordsError
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.records.content_store import DamagedContent
from insole_core.records.person import Person, new_id
from insole_core.records.prescription import Base
from insole_core.records.records import Records
from insole_core.records.schema import prescription_versions
from insole_core.records.visit import Visit
from insole_core.workflows.starting_design import last_design, starting_device

TODAY = date.today()


@pytest.fixture
def visit(records: Records) -> Visit:
    person = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    return records.visits.add(Visit(person.id, TODAY, findings="flat foot"))


def thicker(foot: FootRecord, thickness_mm: float) -> FootRecord:
    return foot.with_design(replace(foot.design, thickness_mm=thickness_mm))


def thicknesses(records: Records, visit: Visit, side: Side = Side.LEFT) -> list[float]:
    """Return the thickness of every version, the newest first."""
    versions = records.prescriptions.versions(visit.id, side)
    return [records.prescriptions.read(v.id).design.thickness_mm for v in versions]


def test_a_visit_opens_as_the_case_that_was_saved(
    records: Records, visit: Visit, foot_record: FootRecord, right_record: FootRecord
) -> None:
    marks = Annotations((KeyPoint("heel", (1, 2, 3)),), ReferencePlane((0, 0, 5), 3, -2))
    left, right_record = (
        replace(foot, source=foot.source.without_place()) for foot in (foot_record, right_record)
    )
    left = replace(left, annotations=marks)
    left = left.with_variant(Variant("B", InsoleDesign(side=Side.LEFT, thickness_mm=4.5)))
    for foot in (right_record, left):
        records.prescriptions.save(visit.id, foot, None)
    opened = records.visits.open_case(visit.id)
    expected = CaseRecord(opened.record.patient).with_foot(right_record).with_foot(left)
    assert case_to_json(opened.record) == case_to_json(expected)
    assert opened.record.patient.name == "Anna Berg"
    assert opened.record.patient.born == "1970-02-28"
    assert opened.record.patient.notes == "flat foot"
    for foot in (left, right_record):
        read = opened.record.of_side(foot.side)
        assert read is not None
        assert np.array_equal(read.foot.mesh.vertices, foot.foot.mesh.vertices)
        assert np.array_equal(read.foot.mesh.triangles, foot.foot.mesh.triangles)
    assert opened.bases.keys() == {Side.LEFT, Side.RIGHT}
    assert opened.visit == visit


@pytest.mark.parametrize(
    ("kind", "path", "kept"),
    [
        ("mesh", "/scans/Anna Berg 1970 left.stl", "mesh"),
        ("session", "/captures/2026-11-20", "/captures/2026-11-20"),  # its markers are corrected
    ],
)
def test_where_a_scan_lay_is_kept_only_as_long_as_it_is_needed(
    records: Records, visit: Visit, foot_record: FootRecord, kind: str, path: str, kept: str
) -> None:
    foot = replace(foot_record, source=ScanSource(kind, path, "0" * 64))
    base = records.prescriptions.save(visit.id, foot, None)
    (read,) = records.visits.open_case(visit.id).record.feet
    assert (read.source.path, read.source.sha256) == (kept, "0" * 64)
    assert records.prescriptions.save(visit.id, read, base) == base  # nothing has changed


def test_opening_a_visit_is_in_the_log(records: Records, visit: Visit) -> None:
    records.visits.open_case(visit.id)
    line = records.audit.lines(subject_id=visit.id)[0]
    assert (line.action, line.subject_kind) == ("seen", "visit")


def test_one_editing_writes_one_version(
    records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    base = None
    for thickness_mm in (3.0, 3.5, 4.0):
        base = records.prescriptions.save(visit.id, thicker(foot_record, thickness_mm), base)
    assert thicknesses(records, visit) == [4.0]
    assert len(list(records.contents.digests())) == 1


def test_what_is_unchanged_is_not_written(
    records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    base = records.prescriptions.save(visit.id, foot_record, None)
    mark = records.mark()
    assert records.prescriptions.save(visit.id, foot_record, base) == base
    assert records.mark() == mark


def test_opening_anew_begins_another_version(
    records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    records.prescriptions.save(visit.id, thicker(foot_record, 3), None)
    bases = records.visits.open_case(visit.id).bases
    records.prescriptions.save(visit.id, thicker(foot_record, 4), bases[Side.LEFT])
    assert thicknesses(records, visit) == [4, 3]
    newest, oldest = records.prescriptions.versions(visit.id, Side.LEFT)
    assert (newest.number, newest.is_closed) == (2, False)
    assert (oldest.number, oldest.is_closed, oldest.author) == (1, True, ANNA.name)


def test_a_reason_keeps_a_version(records: Records, visit: Visit, foot_record: FootRecord) -> None:
    base = records.prescriptions.save(visit.id, thicker(foot_record, 3), None, "first trial")
    base = records.prescriptions.save(visit.id, thicker(foot_record, 4), base)
    records.prescriptions.close(base.version_id, "second trial")
    with pytest.raises(RecordsError, match="closed already"):
        records.prescriptions.close(base.version_id, "again")
    assert [v.reason for v in records.prescriptions.versions(visit.id, Side.LEFT)] == [
        "second trial",
        "first trial",
    ]
    assert thicknesses(records, visit) == [4, 3]


def test_a_closed_version_cannot_be_changed_in_the_database(
    records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    base = records.prescriptions.save(visit.id, foot_record, None, "kept")
    for statement in (
        "UPDATE prescription_versions SET document = '{}' WHERE id = :id",
        "UPDATE prescription_versions SET is_closed = false WHERE id = :id",
        "DELETE FROM prescription_versions WHERE id = :id",
    ):
        with (
            pytest.raises(RecordsError, match="closed or signed prescription cannot be changed"),
            records.context.database.writing() as connection,
        ):
            connection.execute(text(statement), {"id": base.version_id})
    assert records.prescriptions.read(base.version_id).design == foot_record.design


def test_the_log_cannot_be_changed_in_the_database(records: Records, visit: Visit) -> None:
    for statement in (
        "UPDATE audit SET author = 'nobody'",
        "DELETE FROM audit",
        "DELETE FROM audit_head",
        "UPDATE audit_head SET seq = 0",
    ):
        with (
            pytest.raises(RecordsError, match="only appended to"),
            records.context.database.writing() as connection,
        ):
            connection.execute(text(statement))
    assert records.audit.verify().is_intact
    assert len(records.audit.lines(subject_id=visit.id)) == 1


def two_stations(
    stations: Stations, visit_id: str, foot: FootRecord
) -> tuple[Records, Records, Base, Base]:
    """Return two stations that have opened the same version."""
    desk, room = stations.open(ANNA), stations.open(BEN)
    desk.prescriptions.save(visit_id, thicker(foot, 3), None, "before")
    bases = [station.visits.open_case(visit_id).bases[Side.LEFT] for station in (desk, room)]
    return desk, room, *bases


@pytest.mark.parametrize("choice", ["mine", "theirs", "both"])
def test_who_saves_second_chooses_and_nothing_is_lost(
    stations: Stations, records: Records, visit: Visit, foot_record: FootRecord, choice: str
) -> None:
    desk, room, base_desk, base_room = two_stations(stations, visit.id, foot_record)
    desk.prescriptions.save(visit.id, thicker(foot_record, 4), base_desk)
    mine = thicker(foot_record, 5)
    with pytest.raises(Conflict, match="anna at desk has changed the left foot") as caught:
        room.prescriptions.save(visit.id, mine, base_room)
    conflict = caught.value
    assert conflict.mine is mine
    theirs = room.prescriptions.read(conflict.theirs.id)
    assert theirs.design.thickness_mm == 4
    assert thicknesses(records, visit) == [4, 3]
    both = theirs.with_variant(Variant("anna's", mine.design))
    chosen = {"mine": mine, "theirs": theirs, "both": both}[choice]
    base = room.prescriptions.settle(visit.id, mine, conflict.theirs, chosen)
    expected = {"mine": [5, 4, 3], "theirs": [4, 5, 4, 3], "both": [5, 5, 4, 3]}[choice]
    assert thicknesses(records, visit) == expected
    versions = records.prescriptions.versions(visit.id, Side.LEFT)
    assert [v.is_closed for v in versions] == [False] + [True] * (len(versions) - 1)
    # Who has settled it goes on; the other one is the second by now.
    room.prescriptions.save(visit.id, thicker(chosen, 6), base)
    with pytest.raises(Conflict):
        desk.prescriptions.save(visit.id, thicker(foot_record, 7), replace(base_desk, is_mine=True))


def test_a_settled_conflict_may_be_a_new_one(
    stations: Stations, records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    desk, room, base_desk, base_room = two_stations(stations, visit.id, foot_record)
    base_desk = desk.prescriptions.save(visit.id, thicker(foot_record, 4), base_desk)
    mine = thicker(foot_record, 5)
    with pytest.raises(Conflict) as caught:
        room.prescriptions.save(visit.id, mine, base_room)
    desk.prescriptions.save(visit.id, thicker(foot_record, 4.5), base_desk)
    with pytest.raises(Conflict) as again:
        room.prescriptions.settle(visit.id, mine, caught.value.theirs, mine)
    room.prescriptions.settle(visit.id, mine, again.value.theirs, mine)
    assert thicknesses(records, visit) == [5, 4.5, 3]


def test_a_foot_that_both_begin_is_a_conflict(
    stations: Stations, visit: Visit, foot_record: FootRecord
) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    desk.prescriptions.save(visit.id, foot_record, None)
    with pytest.raises(Conflict):
        room.prescriptions.save(visit.id, foot_record, None)


def test_stations_may_work_on_one_foot_each(
    stations: Stations, visit: Visit, foot_record: FootRecord, right_record: FootRecord
) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    left = desk.prescriptions.save(visit.id, foot_record, None)
    right = room.prescriptions.save(visit.id, right_record, None)
    desk.prescriptions.save(visit.id, thicker(foot_record, 4), left)
    room.prescriptions.save(visit.id, thicker(right_record, 5), right)
    assert thicknesses(desk, visit, Side.LEFT) == [4]
    assert thicknesses(desk, visit, Side.RIGHT) == [5]


def test_another_author_begins_another_version(
    stations: Stations, visit: Visit, foot_record: FootRecord
) -> None:
    desk, room = stations.open(ANNA), stations.open(BEN)
    base = desk.prescriptions.save(visit.id, thicker(foot_record, 3), None)
    room.prescriptions.save(visit.id, thicker(foot_record, 4), base)
    assert [v.author for v in desk.prescriptions.versions(visit.id, Side.LEFT)] == ["ben", "anna"]


def test_a_surface_that_was_changed_on_the_disk_is_told(
    records: Records, visit: Visit, foot_record: FootRecord
) -> None:
    base = records.prescriptions.save(visit.id, foot_record, None)
    [digest] = records.contents.digests()
    path = records.contents.path(digest)
    path.write_bytes(path.read_bytes()[:-1] + b"x")
    with pytest.raises(DamagedContent, match="changed since"):
        records.prescriptions.read(base.version_id)
    with pytest.raises(DamagedContent, match="changed since"):
        records.visits.open_case(visit.id)


def test_a_failed_audit_line_undoes_its_change(
    records: Records, visit: Visit, foot_record: FootRecord, monkeypatch: pytest.MonkeyPatch
) -> None:
    mark = records.mark()

    def fail(*_given: object, **_details: object) -> None:
        raise sqlite3.OperationalError("no")

    monkeypatch.setattr("insole_core.records.context.AuditLog.append", fail)
    with pytest.raises(sqlite3.OperationalError):
        records.prescriptions.save(visit.id, foot_record, None)
    monkeypatch.undo()
    assert records.prescriptions.versions(visit.id, Side.LEFT) == []
    assert records.mark() == mark


@pytest.mark.parametrize("has_corrections", [True, False])
def test_the_last_prescription_is_found_and_no_other_surface_is_read(
    records: Records,
    visit: Visit,
    foot_record: FootRecord,
    right_record: FootRecord,
    tmp_path: Path,
    has_corrections: bool,
) -> None:
    """A chosen thickness is prescribed as a lift is; a design as it begins is not."""
    starting = starting_device(tmp_path)
    begun = starting.design(foot_record.foot)
    design = begun.with_added(HeelLift(height_mm=6.0))
    if not has_corrections:
        design = replace(begun, thickness_mm=begun.thickness_mm + 0.7)
    before = replace(visit, id=new_id(), visited_on=TODAY - timedelta(days=30))
    before = records.visits.add(before)
    records.prescriptions.save(before.id, foot_record.with_design(design), None)
    moved = replace(foot_record.foot.mesh, vertices=foot_record.foot.mesh.vertices + 1.0)
    scanned = replace(foot_record, foot=replace(foot_record.foot, mesh=moved)).with_design(begun)
    records.prescriptions.save(visit.id, scanned, None)
    records.prescriptions.save(visit.id, right_record, None)
    kept = records.prescriptions.versions(before.id, Side.LEFT)[0]
    for path in records.contents.folder.glob("??/*"):
        if path.name != content_of(records, kept.id):
            path.unlink()
    (found,) = records.prescriptions.last_prescribed(visit.person_id, starting.prescribes)
    assert found.design == design
    template = last_design(found, starting)
    assert template is not None
    assert template.design.thickness_mm == design.thickness_mm
    assert last_design(right_record, starting) is None


def content_of(records: Records, version_id: str) -> str:
    versions = prescription_versions.c
    with records.context.database.reading() as connection:
        query = select(versions.mesh_sha256).where(versions.id == version_id)
        return str(connection.execute(query).scalar_one())
