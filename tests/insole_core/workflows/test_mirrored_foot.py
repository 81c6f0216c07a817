"""A foot that was not scanned is the other one's mirror image, and this is said everywhere."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from read_pdf import text_of_pdf
from scipy.spatial import cKDTree

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, KeyPoint, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.export.order_verification import read_order
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import mirrored as mirror
from insole_core.resources import resource_path
from insole_core.solids.export_rules import ExportRules
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import read_shop
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.make_order import OrderChoice, make_parts, write_order
from insole_core.workflows.order_package import PackedItem, write_package
from insole_core.workflows.records.keep_case import visit_measures
from insole_core.workflows.scanned_feet import feet_made_of
from insole_core.workflows.starting_design import mirrored_foot

PATIENT = Patient("Ö", "1970-02-28", "2026-11-20")
MARKED = KeyPoint("custom", (20.0, 100.0, 0.0))


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "left.stl"
    path.write_bytes(b"as it was scanned")
    return path


@pytest.fixture(scope="module")
def scanned(left_foot: Foot, scan: Path) -> FootRecord:
    source = ScanSource("mesh", str(scan), hashlib.sha256(scan.read_bytes()).hexdigest())
    corrections = (Pelott(centre_mm=(8.0, 150.0)), Posting(rearfoot_deg=4.0))
    design = InsoleDesign(Side.LEFT, corrections, grid_mm=2.0)
    return FootRecord.begun(left_foot, source, design, annotations=Annotations((MARKED,)))


@pytest.fixture(scope="module")
def mirrored(scanned: FootRecord) -> FootRecord:
    return mirrored_foot(scanned, lambda correction: correction)


def test_foot_and_landmarks_are_the_mirror_image(scanned: FootRecord, mirrored: FootRecord) -> None:
    assert mirrored.side is Side.RIGHT
    there, here = mirrored.foot.mesh, scanned.foot.mesh
    np.testing.assert_array_equal(there.vertices, here.vertices * [-1, 1, 1])
    np.testing.assert_allclose(there.vertex_normals, here.vertex_normals * [-1, 1, 1], atol=1e-9)
    assert np.linalg.det(mirrored.foot.source2insole) == pytest.approx(1.0)
    own = here.transformed(inverse(scanned.foot.source2insole)).vertices * [-1, 1, 1]
    back = there.transformed(inverse(mirrored.foot.source2insole)).vertices
    np.testing.assert_allclose(back, own, atol=1e-9)
    assert mirrored.annotations.key_points == (replace(MARKED, position_mm=(-20.0, 100.0, 0.0)),)
    assert mirrored.annotations.key_points != scanned.annotations.key_points
    left, right = landmarks_of(scanned), landmarks_of(mirrored)
    for name, mark in left.items():
        np.testing.assert_allclose(right[name].point, mark.point * [-1, 1, 1], atol=1e-6)


def test_its_insole_is_the_mirror_image(scanned: FootRecord, mirrored: FootRecord) -> None:
    left, right = (build_insole(foot.foot, foot.design) for foot in (scanned, mirrored))
    assert [type(c) for c in mirrored.design.corrections] == [Pelott, Posting]
    x, y = np.meshgrid(np.linspace(-25, 25, 11), np.linspace(20, 200, 19))
    x, y = x.ravel(), y.ravel()
    there = right.contact.height_at(np.stack([x, y], axis=1))
    here = left.contact.height_at(np.stack([-x, y], axis=1))
    np.testing.assert_allclose(there, here, atol=1e-6)


def test_what_the_pictures_told_of_a_recorded_foot_is_mirrored_with_it(
    tmp_path: Path,
) -> None:
    """The outlines in the pictures tell where the foot ends, and how surely, as on the scan."""
    recorded = read_case(resource_path("example/example.insole")).feet[0]
    design = recorded.design.with_added(Pelott(centre_mm=(-8.0, 150.0), turn_deg=7.0))
    recorded = recorded.with_design(design.with_added(Posting(rearfoot_deg=4.0)))
    image = mirrored_foot(recorded, lambda correction: correction)
    assert recorded.foot.mesh.touches is not None
    here, there = landmarks_of(recorded), landmarks_of(image)
    assert list(there) == list(here)
    for name, mark in here.items():
        told = (mark.confidence, mark.deviation_mm or 0.0)
        mirrored = there[name]
        np.testing.assert_allclose(mirrored.point, mark.point * [-1, 1, 1], atol=1e-6)
        assert (mirrored.confidence, mirrored.deviation_mm or 0.0) == pytest.approx(told, abs=1e-9)
    own = mirror(recorded.design)
    renamed = [
        replace(c, id=made.id)
        for c, made in zip(own.corrections, image.design.corrections, strict=True)
    ]
    assert image.design == replace(own, corrections=tuple(renamed))
    solids = [
        part.solid.vertices
        for part in make_parts(
            CaseRecord(PATIENT, (recorded, image), recorded.side),
            OrderChoice(both=True, most_triangles=None),
            ExportRules({}, {}),
        )
    ]
    way_mm, _ = cKDTree(solids[0]).query(solids[1] * [-1, 1, 1])
    # Where two places of the rim's edge are equally near, either one may take another.
    assert np.count_nonzero(way_mm > 1e-6) <= 4
    assert way_mm.max() < 0.25


def test_the_case_keeps_that_it_was_mirrored(
    scanned: FootRecord, mirrored: FootRecord, tmp_path: Path
) -> None:
    write_case(CaseRecord(PATIENT, (scanned, mirrored), Side.LEFT), tmp_path / "c.insole")
    kept = read_case(tmp_path / "c.insole")
    assert {foot.side: foot.foot.mirrored for foot in kept.feet} == {
        Side.LEFT: False,
        Side.RIGHT: True,
    }
    assert [foot.source.mirrored for foot in kept.feet] == [False, True]


def test_what_was_not_scanned_is_not_measured_and_not_read_again(
    scanned: FootRecord, mirrored: FootRecord, scan: Path
) -> None:
    assert {key.partition("_")[0] for key in visit_measures((scanned, mirrored))} == {"left"}
    assert feet_made_of(scan, (scanned, mirrored)) == (scanned,)


def test_papers_and_solids_say_it_of_the_mirrored_foot_alone(
    scanned: FootRecord, mirrored: FootRecord, tmp_path: Path
) -> None:
    record = CaseRecord(PATIENT, (scanned, mirrored), Side.LEFT)
    choice = OrderChoice(both=True, prescription=True, pseudonym="26-7KQ4M " + 40 * "x")
    parts = make_parts(record, choice, ExportRules({}, {}))
    write_order(
        parts, choice, tmp_path / "o.stl",
        shop=read_shop(), patient=PATIENT, responsible=Responsible("Ö", "Ö", "Ö", "Ö"),
    )  # fmt: skip
    said = "The right foot was not scanned: foot and insole are mirrored from the left foot."
    for side, is_said in (("left", False), ("right", True)):
        for paper in ("job-sheet", "prescription"):
            text = " ".join(text_of_pdf(tmp_path / f"o-{side}-{paper}.pdf").split())
            assert (said in text) is is_said, (side, paper)
        header = (tmp_path / f"o-{side}.stl").read_bytes()[:80]
        assert (b"mirrored from left" in header) is is_said
    plain = replace(choice, job_sheet=False, prescription=False)
    text_stl = replace(plain, ascii_stl=True)
    formats = (replace(plain, suffix=".obj"), replace(plain, suffix=".ply"), text_stl)
    for chosen in formats:
        name = f"plain{chosen.suffix}"
        write_order(parts, chosen, tmp_path / name, shop=read_shop(), patient=PATIENT)
        for side, is_said in (("left", False), ("right", True)):
            path = tmp_path / name.replace(".", f"-{side}.")
            assert (b"right mirrored from left" in path.read_bytes()[:200]) is is_said, path


def test_the_order_of_a_shop_says_it(
    scanned: FootRecord, mirrored: FootRecord, tmp_path: Path
) -> None:
    record = CaseRecord(PATIENT, (scanned, mirrored), Side.LEFT)
    choice = OrderChoice(both=True, job_sheet=False, pseudonym="26-7KQ4M")
    parts = make_parts(record, choice, ExportRules({}, {}))
    write_package(
        [PackedItem(parts, choice, PATIENT, {})], tmp_path / "order",
        number="26-7KQ4M", shop=read_shop(), now=datetime.now(UTC),
    )  # fmt: skip
    (item,) = read_order(tmp_path / "order").items
    assert (item.sides, item.mirrored) == ((Side.LEFT, Side.RIGHT), (Side.RIGHT,))
