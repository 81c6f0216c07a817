from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.cases.case_file import CASE_NAME, FOOT_NAMES, read_case, write_case
from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    KeyPoint,
    Patient,
    ReferencePlane,
    Variant,
)
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError, OutputError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.template import Template

SAMPLES = Path(__file__).parents[2] / "data" / "cases"
FOOT_NAME = FOOT_NAMES[Side.LEFT]


def wedge() -> TriangleMesh:
    vertices = np.array([[0.1, 0, 0], [80, 0, 0], [0, 250, 0], [0, 0, 1 / 3]], dtype=float)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], dtype=np.int32)
    return TriangleMesh(vertices, triangles, np.arange(12, dtype=np.uint8).reshape(4, 3))


@pytest.fixture
def record() -> CaseRecord:
    pose = rigid(rotation_about(np.array([0.0, 0.0, 1.0]), 3.0), np.array([1.0, 2.0, 3.0]))
    source = ScanSource("session", "/clinic/left_a", "0f" * 32, "2026-11-20T10:00:00Z")
    design = InsoleDesign(
        Side.LEFT,
        (Pelott(centre_mm=(12.0, 150.0), sigma_mm=(9.0, 12.0)), Posting(rearfoot_deg=4.0)),
        thickness_mm=4.0,
    )
    left = FootRecord.begun(
        Foot(Side.LEFT, wedge(), pose, 241.5, ("Placed by its markers.",)),
        source,
        design,
        annotations=Annotations(
            (KeyPoint("Heel", (0.0, 1.5, 2.0)),), ReferencePlane((0.0, 100.0, 5.0), 2.0, -3.5)
        ),
        earlier=Template("A", design, ((0.0, 30.0), (25.0, 170.0), (-30.0, 150.0))),
    ).with_variant(Variant("B", replace(design, thickness_mm=3.0)))
    stood = replace(source, weight_bearing="semi")
    right = FootRecord.begun(Foot(Side.RIGHT, wedge(), np.eye(4), 243.0), stood)
    patient = Patient("Änna B.", "1970-01-02", "2026-11-20", "first\nsecond")
    return CaseRecord(patient).with_foot(right).with_foot(left)


@pytest.fixture
def case(record: CaseRecord, tmp_path: Path) -> Path:
    path = tmp_path / "anna.insole"
    write_case(record, path)
    return path


def test_what_is_written_comes_back_to_the_bit(record: CaseRecord, case: Path) -> None:
    again = read_case(case)
    assert (again.patient, again.at_hand) == (record.patient, Side.LEFT)
    assert [foot.side for foot in again.feet] == [Side.LEFT, Side.RIGHT]
    for read, written in zip(again.feet, record.feet, strict=True):
        assert (read.source, read.variants) == (written.source, written.variants)
        assert (read.chosen, read.annotations) == (written.chosen, written.annotations)
        assert read.earlier == written.earlier
        for name in ("vertices", "triangles", "colors"):
            assert np.array_equal(getattr(read.foot.mesh, name), getattr(written.foot.mesh, name))
        assert np.array_equal(read.foot.source2insole, written.foot.source2insole)
        assert read.foot.notes == written.foot.notes
    assert again.current is again.feet[0]
    assert again.design == record.design


def test_a_case_without_a_foot_is_a_case(tmp_path: Path) -> None:
    record = CaseRecord(patient=Patient(name="Anna"))
    write_case(record, tmp_path / "a.insole")
    again = read_case(tmp_path / "a.insole")
    assert (again.patient, again.foot, again.design) == (record.patient, None, None)


def test_equal_cases_are_equal_files(record: CaseRecord, case: Path, tmp_path: Path) -> None:
    write_case(record, tmp_path / "again.insole")
    assert (tmp_path / "again.insole").read_bytes() == case.read_bytes()


def test_a_case_of_version_1_is_read() -> None:
    record = read_case(SAMPLES / "version_1.insole")
    assert record.patient.name == "Sample of version 1"
    assert record.side is Side.RIGHT
    assert record.foot is not None
    assert record.foot.mesh.is_closed
    assert record.design is not None
    assert [c.type for c in record.design.corrections] == ["pelott", "posting"]
    assert record.annotations.plane is not None
    assert [variant.name for variant in record.feet[0].variants] == ["A"]


def test_a_case_of_version_2_is_read() -> None:
    record = read_case(SAMPLES / "version_2.insole")
    assert record.patient.name == "Sample of version 2"
    left, right = record.feet
    assert (left.side, right.side, record.side) == (Side.LEFT, Side.RIGHT, Side.RIGHT)
    assert [variant.name for variant in left.variants] == ["A", "softer"]
    assert left.chosen == "softer"
    assert [c.type for c in left.design.corrections] == ["pelott", "posting"]
    assert left.earlier is not None
    assert left.earlier.design.thickness_mm == 5.0
    assert left.annotations.plane is not None
    assert right.foot.mesh.is_closed


def test_a_full_or_missing_place_leaves_the_old_file(record: CaseRecord, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="folder does not exist"):
        write_case(record, tmp_path / "missing" / "a.insole")


def change(case: Path, edit: Callable[[dict[str, Any]], object]) -> None:
    """Edit case.json inside the archive."""
    with zipfile.ZipFile(case) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    content = json.loads(parts[CASE_NAME])
    edit(content)
    parts[CASE_NAME] = json.dumps(content).encode()
    pack(case, parts)


def pack(case: Path, parts: dict[str, bytes]) -> None:
    with zipfile.ZipFile(case, "w") as archive:
        for name, part in parts.items():
            archive.writestr(name, part)


BAD: dict[str, tuple[Callable[[dict[str, Any]], object], str]] = {
    "another format": (lambda c: c.update(format="other"), "format"),
    "no version": (lambda c: c.pop("version"), "version is missing"),
    "a newer version": (
        lambda c: c.update(version=3),
        "case.json is of version 3, which is newer than",
    ),
    "no patient": (lambda c: c.pop("patient"), "patient is missing"),
    "a name that is a number": (lambda c: c["patient"].update(name=5), "patient.name"),
    "a point in 2-D": (
        lambda c: c["feet"][0]["annotations"]["key_points"][0].update(position_mm=[1, 2]),
        "position_mm has 2 numbers",
    ),
    "two points of a name": (
        lambda c: c["feet"][0]["annotations"]["key_points"].append(
            c["feet"][0]["annotations"]["key_points"][0]
        ),
        "twice",
    ),
    "a side that is none": (lambda c: c["feet"][0].update(side="both"), r"feet\[0\].side"),
    "a mirrored pose": (
        lambda c: c["feet"][0]["source2insole"][0].__setitem__(0, -1.0),
        "source2insole is no rigid transform",
    ),
    "three rows": (lambda c: c["feet"][0]["source2insole"].pop(), "source2insole must be a 4×4"),
    "a pelott out of range": (
        lambda c: c["feet"][0]["variants"][0]["design"]["corrections"][0].update(height_mm=500),
        "height_mm",
    ),
    "a weight of no kind": (
        lambda c: c["feet"][0]["source"].update(weight_bearing="heavy"),
        "source.weight_bearing",
    ),
    "a source of no kind": (lambda c: c["feet"][0]["source"].update(kind="dream"), "source.kind"),
    "a scan in an unknown unit": (
        lambda c: c["feet"][0]["source"].update(choice={"unit": "ell"}),
        r"source.choice.unit",
    ),
    "a known size without a number": (
        lambda c: c["feet"][0]["source"].update(choice={"known_size": {"first": [0, 0, 0]}}),
        r"known_size.second is missing",
    ),
    "two clicks": (
        lambda c: c["feet"][0]["source"].update(
            choice={"clicks": {"heel": [0, 0, 0], "toe": [0, 250, 0]}}
        ),
        r"clicks.sole is missing",
    ),
    "a foot of another side than the design": (
        lambda c: c["feet"].pop() and c["feet"][0].update(side="right"),
        "design is for a left foot",
    ),
    "an earlier design of the other side": (
        lambda c: c["feet"][1].update(earlier=c["feet"][0]["earlier"]),
        "design is for a left foot",
    ),
    "a newer earlier design": (
        lambda c: c["feet"][0]["earlier"].update(version=2),
        r"feet\[0\].earlier is of version 2, which is newer than this program",
    ),
    "a newer design": (
        lambda c: c["feet"][0]["variants"][0]["design"].update(version=2),
        "newer",
    ),
    "a foot without a design": (
        lambda c: c["feet"][0]["variants"][0].pop("design"),
        "design is missing",
    ),
    "a foot without variants": (lambda c: c["feet"][0].update(variants=[]), "at least one"),
    "two variants of a name": (
        lambda c: c["feet"][0]["variants"][1].update(name="A"),
        "same name twice",
    ),
    "a variant without a name": (
        lambda c: c["feet"][0]["variants"][1].update(name=""),
        "must be a text that is not empty",
    ),
    "a variant chosen that is not there": (lambda c: c["feet"][0].update(chosen="C"), "chosen"),
    "two left feet": (lambda c: c["feet"].__setitem__(1, c["feet"][0]), "same side"),
    "a foot at hand that is not there": (
        lambda c: (c["feet"].pop(0), c.update(at_hand="left")),
        "at_hand",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_violation_is_one_sentence(case: Path, name: str) -> None:
    edit, sentence = BAD[name]
    change(case, edit)
    with pytest.raises(InputError, match=sentence) as caught:
        read_case(case)
    assert case.name in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"no zip", b"PK\x03\x04 cut off"])
def test_no_archive_is_no_case(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.insole").write_bytes(content)
    with pytest.raises(InputError, match="no readable case file"):
        read_case(tmp_path / "a.insole")


def test_a_missing_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        read_case(tmp_path / "a.insole")


def test_a_cut_off_file_is_refused(case: Path) -> None:
    case.write_bytes(case.read_bytes()[:-40])
    with pytest.raises(InputError, match=case.name):
        read_case(case)


def test_a_flipped_bit_is_noticed(case: Path) -> None:
    content = bytearray(case.read_bytes())
    content[content.index(FOOT_NAME.encode()) + 100] ^= 1  # inside the mesh, not in a zip header
    case.write_bytes(bytes(content))
    with pytest.raises(InputError):
        read_case(case)


def test_a_session_is_no_case(tmp_path: Path) -> None:
    pack(tmp_path / "a.insole", {"manifest.json": b"{}"})
    with pytest.raises(InputError, match=r"holds no case\.json"):
        read_case(tmp_path / "a.insole")


def test_a_case_that_lost_its_foot_is_refused(case: Path) -> None:
    with zipfile.ZipFile(case) as archive:
        text = archive.read(CASE_NAME)
    pack(case, {CASE_NAME: text})
    with pytest.raises(InputError, match=r"lost its left\.npz"):
        read_case(case)


def _npz(**arrays: Any) -> bytes:
    packed = io.BytesIO()
    np.savez(packed, **arrays)
    return packed.getvalue()


MESH = wedge()
BAD_FEET = {
    "no archive": b"123",
    "a missing array": _npz(vertices=MESH.vertices),
    "a triangle beyond the vertices": _npz(
        vertices=MESH.vertices, triangles=MESH.triangles + np.int32(1)
    ),
    "not a number": _npz(vertices=MESH.vertices * np.nan, triangles=MESH.triangles),
    "flat vertices": _npz(vertices=MESH.vertices[:, :2], triangles=MESH.triangles),
    "pickled objects": _npz(vertices=np.array([{}]), triangles=MESH.triangles),
    "colours of others": _npz(
        vertices=MESH.vertices, triangles=MESH.triangles, colors=np.zeros((2, 3), np.uint8)
    ),
}


@pytest.mark.parametrize("name", BAD_FEET)
def test_a_damaged_foot_is_refused(case: Path, name: str) -> None:
    with zipfile.ZipFile(case) as archive:
        text = archive.read(CASE_NAME)
    pack(case, {CASE_NAME: text, FOOT_NAME: BAD_FEET[name]})
    with pytest.raises(InputError, match=r"left\.npz is damaged"):
        read_case(case)
