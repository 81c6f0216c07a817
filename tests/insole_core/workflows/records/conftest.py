"""A record with one person: two visits, both feet, a capture, an order and a follow-up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

import pytest
from stations import begin_migrated, keep_quickly, migrated_database

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.formats.stl import write_stl
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.records.author import Author
from insole_core.records.capture import CaptureFacts
from insole_core.records.captures import MESH
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.visit import FollowUp, Visit

NAME = "Åsa </h1><script>alert(1)</script> Öberg"


@pytest.fixture(scope="session", autouse=True)
def quick_keeping() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        keep_quickly(patch)
        yield


@pytest.fixture(scope="session")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A database with tables and nothing in them."""
    return migrated_database(tmp_path_factory.mktemp("migrated")).read_bytes()


@pytest.fixture(scope="module", autouse=True)
def with_tables(migrated: bytes) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        begin_migrated(patch, migrated)
        yield


@pytest.fixture
def records(tmp_path: Path) -> Iterator[Records]:
    """A new record of this computer."""
    opened = open_records(RecordsPlace.local(tmp_path), Author("anna", "desk"))
    yield opened
    opened.close()


@dataclass(frozen=True)
class Clinic:
    """The open record, its person and their visits, the older one first."""

    records: Records
    person: Person
    visits: tuple[Visit, Visit]


@pytest.fixture(scope="session")
def clinic(
    tmp_path_factory: pytest.TempPathFactory, left_foot: Foot, right_foot: Foot
) -> Iterator[Clinic]:
    folder = tmp_path_factory.mktemp("clinic")
    records = open_records(RecordsPlace.local(folder / "record"), Author("anna", "desk"))
    person = records.persons.add(
        Person(NAME, date(1964, 8, 23), "19640823-3234", "se", contact="070 1", notes="Öberg, shy")
    )
    visits = tuple(
        records.visits.add(
            Visit(person.id, day, reason="heel spur", findings="Åsa Öberg: plattfot <foot>")
        )
        for day in (date(2026, 3, 1), date(2026, 11, 20))
    )
    left, right = (
        FootRecord.begun(
            foot,
            ScanSource("mesh", f"/scans/Öberg/{foot.side}.stl", digest * 64),
            InsoleDesign(foot.side, grid_mm=2.0),
        )
        for foot, digest in ((left_foot, "a"), (right_foot, "b"))
    )
    records.prescriptions.save(visits[0].id, left, None)
    base = records.prescriptions.save(visits[1].id, left, None, reason="Öberg wants it so")
    design = replace(
        left.design,
        corrections=(Pelott(centre_mm=(-5.0, 160.0), author="anna", created_at="2026-11-20"),),
    )
    base = records.prescriptions.save(visits[1].id, left.with_design(design), base)
    records.prescriptions.save(visits[1].id, right, None)
    scan = folder / "Åsa Öberg.stl"
    write_stl(left_foot.mesh, scan)
    facts = CaptureFacts("2026-11-20T10:00:00Z", ("A00362A",))  # of before calibrations were noted
    records.captures.add(visits[1].id, MESH, scan, facts)
    papers = [folder / name for name in ("26-7KQ4M-left.stl", "26-7KQ4M-left-prescription.pdf")]
    for paper in papers:
        paper.write_bytes(b"of the shop")
    records.orders.add(
        visits[1].id, [base.version_id], shop="Shop", remarks="for Öberg", files=papers,
        number="26-7KQ4M",
    )  # fmt: skip
    records.follow_ups.add(FollowUp(person.id, date(2026, 11, 21), "better", "Öberg runs"))
    yield Clinic(records, records.persons.get(person.id), (visits[0], visits[1]))
    records.close()
