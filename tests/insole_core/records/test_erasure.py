"""A name in every text that a user or a file can fill is found nowhere after its erasure."""

from __future__ import annotations

import os
import zipfile
from contextlib import closing
from dataclasses import fields, replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sqlalchemy import Column, MetaData, select

from insole_core.cases.case_record import Annotations, FootRecord, KeyPoint, Variant
from insole_core.cases.scan_source import ScanSource
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.template import Template
from insole_core.recording.box import Box
from insole_core.recording.reader import read_session
from insole_core.recording.session import (
    CaptureCondition,
    Manifest,
    Marker,
    ReferenceSystem,
    Session,
    View,
)
from insole_core.recording.writer import write_session
from insole_core.records import retention, schema
from insole_core.records.capture import CaptureFacts
from insole_core.records.captures import MESH, SESSION
from insole_core.records.database import Database
from insole_core.records.marks import Erased, Merged, mark_of
from insole_core.records.migrate import copies_of, keep_copy
from insole_core.records.order import OrderState
from insole_core.records.person import Person
from insole_core.records.records import Records, open_records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.signing import SignatureReport, verify_signatures
from insole_core.records.statement import statement_of
from insole_core.records.verify import verify_record
from insole_core.records.visit import FollowUp, Visit
from insole_core.scans.mesh_file import read_mesh
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.solids.prescription_paper import Responsible

TODAY = date(2026, 11, 22)
NAME = "Zaphodina Uniqname"
PARTS = ("zaphodina", "uniqname", "1971-04-02", "19710402")
COLUMNS = [column for table in schema.metadata.sorted_tables for column in table.columns]


def label(column: Column[Any]) -> str:
    return f"{column.table.name}.{column.name}"


@pytest.mark.parametrize("column", COLUMNS, ids=label)
def test_every_column_says_what_becomes_of_it(column: Column[Any]) -> None:
    mark = mark_of(column)
    stays = mark.erased in (Erased.KEPT, Erased.CHECKED)
    assert stays == bool(mark.why), "a column that is kept says why, and no other one"
    if column.table is schema.persons and mark.erased is Erased.EMPTIED and mark.is_sealed:
        assert mark.merged is Merged.FILLED, "a merge would drop it"
    if mark.merged is Merged.FILLED:
        assert column.name in {field.name for field in fields(Person)}


def test_the_database_has_no_other_columns(records: Records) -> None:
    found = MetaData()
    with records.context.database.reading() as connection:
        found.reflect(connection)
    stored = {label(column) for table in found.sorted_tables for column in table.columns}
    assert stored - {"alembic_version.version_num"} == {label(column) for column in COLUMNS}


def planted_session(session: Session, path: Path) -> Path:
    """A session whose notes and unknown keys and files hold the name."""
    condition = CaptureCondition(notes=f"{NAME} stands on her left foot")
    extra = {"patient": NAME, "born": "1971-04-02"}
    manifest = replace(session.manifest, capture_condition=condition, extra=extra)
    write_session(replace(session, manifest=manifest), path)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(f"{NAME}.txt", NAME)
    return path


@pytest.fixture(scope="module")
def session() -> Session:
    """The smallest session: a sensor that has seen a slope once."""
    camera = PinholeCamera(640, 480, 585.6, 585.5, 316.0, 247.6)
    sensor = Sensor(
        "kinect-v1", "A1", camera, camera, np.eye(4), LinearInverseDisparity(3.33, -0.00307),
        faces=("sole",),
    )  # fmt: skip
    depth = np.full((480, 640), 500, np.uint16) + np.arange(640, dtype=np.uint16) % 100
    color = np.full((480, 640, 3), 90, np.uint8)
    view = View("top", sensor, 1, 1, lambda _index: depth, lambda _index: color)
    system = ReferenceSystem("two", (Marker("S1", (-80.0, -110.0, -9.6), "sole"),
                                     Marker("S2", (80.0, 100.0, 9.6), "sole")))  # fmt: skip
    box = Box((-70, -150, -40), (70, 150, 160))
    manifest = Manifest("2026-11-20T10:00:00Z", Side.LEFT, system, ("top",), box)
    return Session(manifest, (view,), "memory")


@pytest.fixture
def planted(records: Records, foot_record: FootRecord, session: Session, tmp_path: Path) -> Person:
    """A person whose name stands in all that they, their clinic and their files have filled."""
    here = tmp_path / NAME
    here.mkdir()
    scan = here / f"{NAME} 1971-04-02 left.stl"
    write_stl(foot_record.foot.mesh, scan, f"{NAME} 1971-04-02")
    solid = here / f"{NAME}-left.stl"
    write_stl(foot_record.foot.mesh, solid, NAME)
    paper = here / f"{NAME}.pdf"
    paper.write_bytes(b"%PDF-1.4 " + NAME.encode())
    person = records.persons.add(
        Person(NAME, date(1971, 4, 2), "19710402-1234", contact=f"{NAME}, Storgatan 1",
               occupation=f"colleague of {NAME}", notes=f"{NAME} is shy", consent_on=TODAY,
               pseudonym=f"{NAME} 7")
    )  # fmt: skip
    other = records.persons.add(Person(f"{NAME}-Berg", notes=f"earlier {NAME}"))
    visit = records.visits.add(
        Visit(person.id, TODAY, reason=f"{NAME} has pain", findings=f"{NAME}: flat foot",
              weight_kg=70.1, shoe_size_eu=40)
    )  # fmt: skip
    records.persons.merge(person.id, other.id)
    facts = CaptureFacts(
        recorded_at="2026-11-22", sensor_serials=(f"{NAME} 1",),
        calibration_residuals={f"{NAME}: camera, px": 0.2}, report={"patient": NAME},
    )  # fmt: skip
    capture = records.captures.add(visit.id, MESH, scan, facts)
    records.captures.add(visit.id, SESSION, planted_session(session, here / f"{NAME}.zip"))
    records.captures.add(visit.id, SESSION, planted_session(session, here / "unused.zip"))
    foot = planted_foot(foot_record, scan, capture.source_sha256)
    version = records.prescriptions.save(visit.id, foot, None, f"Imported from {NAME}.insole")
    records.prescriptions.sign(version.version_id)
    order = records.orders.add(
        visit.id, [version.version_id], shop=f"For {NAME}", remarks=f"{NAME}: soft heel",
        files=[solid, paper], number=f"{NAME} 1",
    )  # fmt: skip
    records.orders.move(order.id, OrderState.SENT, f"{NAME} waits", order.revision)
    records.follow_ups.add(
        FollowUp(person.id, TODAY, f"{NAME} is better", f"{NAME} walks", order.id, visit.id)
    )
    records.presence.enter(visit.id)
    return person


def planted_foot(foot: FootRecord, scan: Path, sha256: str) -> FootRecord:
    design = replace(
        foot.design,
        corrections=(Pelott(centre_mm=(-5.0, 160.0), author=NAME, kind=f"for {NAME}"),),
        device=f"{NAME}'s",
    )
    anchors = ((0.0, 20.0), (25.0, 170.0), (-30.0, 150.0))
    return FootRecord(
        replace(foot.foot, notes=(f"{scan.name} was turned",)),
        ScanSource("mesh", str(scan), sha256),
        (Variant(f"{NAME}, soft", design), Variant("hard", foot.design)),
        f"{NAME}, soft",
        Annotations((KeyPoint(f"where {NAME} has pain", (0.0, 50.0, 0.0)),)),
        Template(f"{NAME} in March", foot.design, anchors),
    )


def everything(records: Records) -> str:
    """All that the tables state."""
    with records.context.database.reading() as connection:
        rows = [list(connection.execute(select(t))) for t in schema.metadata.sorted_tables]
    return repr(rows).casefold()


def bytes_of(folder: Path) -> bytes:
    """All files below a folder, what is packed in archives, and their names."""
    found = []
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        found += [str(path.relative_to(folder)).encode(), path.read_bytes()]
        if zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as archive:
                found += [name.encode() + archive.read(name) for name in archive.namelist()]
    return b"\n".join(found).lower()


def are_old(folder: Path) -> None:
    """Let all large files have been stored long ago."""
    for path in folder.rglob("*"):
        os.utime(path, (1e9, 1e9))


def left_of(records: Records) -> list[str]:
    """Return what of the name is left in the rows, and in the files of database and contents."""
    place = records.place
    stated, stored = everything(records), bytes_of(place.contents)
    if place.is_local:
        stored += bytes_of(place.database_file.parent)
    return [part for part in PARTS if part in stated or part.encode() in stored]


def test_a_planted_name_is_found_nowhere(
    records: Records, planted: Person, foot_record: FootRecord, tmp_path: Path
) -> None:
    assert left_of(records) == list(PARTS)
    versions = schema.prescription_versions
    are_old(records.place.contents)
    erasure = erase_person(records.context, planted.id, ErasureReason.REQUEST, TODAY)
    assert erasure.kept_until is not None
    assert left_of(records) == []
    # The device stays documented: prescription, signature, surface, scan and solid.
    with records.context.database.reading() as connection:
        assert verify_signatures(connection) == SignatureReport(checked=1)
        version_id = connection.execute(select(versions.c.id)).scalar_one()
        orders = connection.execute(select(schema.orders.c.id)).scalar_one()
    foot = records.prescriptions.read(version_id)
    assert [variant.name for variant in foot.variants] == ["1", "2"]
    assert foot.chosen == "1"
    (pelott,) = foot.design.corrections
    assert isinstance(pelott, Pelott)
    assert pelott.centre_mm == (-5.0, 160.0)
    visit_id = records.orders.get(orders).visit_id
    (scan,) = records.captures.of_visit(visit_id)
    mesh = read_mesh(records.captures.copy_to(scan, tmp_path)).mesh
    assert len(mesh.triangles) == len(foot_record.foot.mesh.triangles)
    assert [file.name for file in records.orders.get(orders).files] == ["solid-1-left.ply"]
    statement = statement_of(records.context, orders, Responsible(maker="A", maker_address="B",
                                                                  clinic="C"))  # fmt: skip
    assert statement.feet[0].signed_by == "anna"


def test_a_session_stays_without_its_words(
    records: Records, foot_record: FootRecord, session: Session, tmp_path: Path
) -> None:
    person = records.persons.add(Person(NAME, date(1971, 4, 2)))
    visit = records.visits.add(Visit(person.id, TODAY))
    given = planted_session(session, tmp_path / f"{NAME}.zip")
    capture = records.captures.add(visit.id, SESSION, given)
    source = ScanSource("session", str(given), capture.source_sha256)
    records.prescriptions.save(visit.id, replace(foot_record, source=source), None)
    are_old(records.place.contents)
    assert PARTS[0] in left_of(records)
    erase_person(records.context, person.id, ErasureReason.REQUEST, TODAY)
    assert left_of(records) == []
    (stored,) = records.captures.of_visit(visit.id)
    assert stored.file_name == "session.zip"
    bare = read_session(records.captures.copy_to(stored, tmp_path))
    assert bare.manifest.extra == {}
    assert bare.manifest.capture_condition == CaptureCondition()
    assert (bare.views[0].read_depth(0) == session.views[0].read_depth(0)).all()


def test_a_name_that_was_changed_long_ago_is_not_left_in_free_pages(records: Records) -> None:
    person = records.persons.add(Person(NAME, contact=f"{NAME} " * 900))
    person = records.persons.change(replace(person, name="Eva Berg", contact=""), person.revision)
    assert PARTS[0] in left_of(records) or not records.place.is_local
    erase_person(records.context, person.id, ErasureReason.REQUEST, TODAY)
    assert left_of(records) == []


def test_a_merge_drops_nothing_that_a_person_has(records: Records) -> None:
    kept = records.persons.add(Person("Eva Berg"))
    full = Person(
        "Eva Berg", date(1971, 4, 2), "19640823-3234", "se", contact="Storgatan 1",
        occupation="nurse", consent_on=TODAY, notes="shy",
    )  # fmt: skip
    other = records.persons.add(full)
    records.persons.merge(kept.id, other.id)
    joined = records.persons.get(kept.id)
    for column in schema.persons.columns:
        if mark_of(column).merged is Merged.FILLED:
            value = getattr(full, column.name)
            assert value, f"fill {column.name} here, too"
            assert getattr(joined, column.name) == value


def test_an_erasure_that_was_stopped_is_finished_by_the_next_opening(
    records: Records, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = records.persons.add(Person(NAME))
    with records.context.database.writing() as connection:
        keep_copy(records.context.database, connection, "0005")

    def stop(_database: Database) -> None:
        raise SystemExit

    monkeypatch.setattr(retention, "finish_erasing", stop)
    with pytest.raises(SystemExit):
        erase_person(records.context, person.id, ErasureReason.REQUEST, TODAY)
    assert records.persons.get(person.id).is_erased
    assert verify_record(records.context).is_sound
    for _ in range(2):  # the second one finds nothing to do
        with closing(open_records(records.place, records.who)) as again:
            assert copies_of(again.context.database) == []
            assert verify_record(again.context).is_sound
    assert left_of(records) == []
