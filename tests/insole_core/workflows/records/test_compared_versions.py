"""Versions of a prescription, as the record gives them back, differ by what was changed in them."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace
from datetime import date

import pytest

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.compare.comparison import Alignment, ComparisonSource, compare_surfaces
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.prescription import Base
from insole_core.records.records import Records, open_records
from insole_core.records.visit import Visit
from insole_core.workflows.compare_case import Wanted, compare_sources, surface_of

pytestmark = pytest.mark.slow

PELOTT = Pelott(centre_mm=(8.0, 150.0), height_mm=4.0)


@pytest.fixture(scope="module")
def versions(
    tmp_path_factory: pytest.TempPathFactory, left_foot: Foot, right_foot: Foot
) -> dict[str, FootRecord]:
    """A pelott, 2 mm higher, as before again, and the mirrored one of the other foot."""
    place = RecordsPlace.local(tmp_path_factory.mktemp("record"))
    with closing(open_records(place, Author("anna", "desk"))) as records:
        return stored_versions(records, left_foot, right_foot)


def stored_versions(records: Records, left_foot: Foot, right_foot: Foot) -> dict[str, FootRecord]:
    person = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    visit = records.visits.add(Visit(person.id, date.today()))
    across = replace(PELOTT, centre_mm=(-8.0, 150.0), turn_deg=-PELOTT.turn_deg)
    wanted = {
        "first": (left_foot, PELOTT),
        "higher": (left_foot, replace(PELOTT, height_mm=6.0)),
        "again": (left_foot, PELOTT),
        "other foot": (right_foot, across),
    }
    stored: dict[str, FootRecord] = {}
    newest: dict[Side, Base] = {}
    for name, (foot, pad) in wanted.items():
        source = ScanSource("mesh", f"{foot.side}.stl", "a" * 64)
        design = InsoleDesign(foot.side, (pad,), grid_mm=2.0)
        record = FootRecord.begun(foot, source, design)
        kept = records.prescriptions.save(visit.id, record, newest.get(foot.side))
        newest[foot.side] = replace(kept, is_mine=False)  # as when the visit is opened again
        stored[name] = records.prescriptions.read(kept.version_id)
    assert len(records.prescriptions.versions(visit.id, Side.LEFT)) == 3
    return stored


@pytest.fixture(scope="module")
def insoles(versions: dict[str, FootRecord]) -> dict[str, ComparisonSource]:
    return {
        name: surface_of(CaseRecord.of_foot(version), Wanted("insole", version.side))
        for name, version in versions.items()
    }


@pytest.mark.parametrize("alignment", ["best", "none"])
def test_versions_differ_by_nothing_or_by_what_was_added(
    versions: dict[str, FootRecord],
    insoles: dict[str, ComparisonSource],
    alignment: Alignment,
) -> None:
    first, higher, again = (insoles[name].mesh for name in ("first", "higher", "again"))
    equal = compare_surfaces(first, again, alignment)
    assert f"{equal.statistics['max']:.2f}" == "0.00"
    assert design_differences(versions["first"].design, versions["again"].design) == ()
    added = compare_surfaces(higher, first, alignment)
    assert f"{added.statistics['max']:.2f}" == "2.00"
    assert added.statistics["signed_min"] > -0.005
    (line,) = design_differences(versions["first"].design, versions["higher"].design)
    assert "4 mm" in line
    assert "→ 6 mm" in line


def test_a_version_of_the_other_foot_is_mirrored_and_said(
    insoles: dict[str, ComparisonSource],
) -> None:
    first = insoles["first"]
    other = insoles["other foot"].like(first)
    assert other.is_mirrored
    assert "right insole is of the other foot, so that it is mirrored." in other.notes
    result = compare_sources(first, other, "none", 1).difference
    assert result.b_is_mirrored
    assert abs(result.statistics["signed_mean"]) < 0.005
    assert result.statistics["p95"] < 0.1, "but for the rim, where the cells of two grids differ"
