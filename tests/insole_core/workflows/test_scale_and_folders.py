"""A known size scales a scan of any unit; a folder holds both feet."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError
from insole_core.foot.foot_candidate import FoundFoot, PoseClicks
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.scale import KnownDistance, KnownFootLength, KnownShoeSize, known_length_mm
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.import_scan import (
    examine_scan,
    nearest_candidate,
    read_scan,
    take_foot,
)
from insole_core.workflows.scanned_feet import ScannedFoot, choice_of


@pytest.fixture(scope="module")
def left_mesh() -> TriangleMesh:
    """A left foot in fewer triangles than elsewhere."""
    return build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh


@pytest.fixture(scope="module")
def right_mesh(left_mesh: TriangleMesh) -> TriangleMesh:
    return replace(left_mesh, vertices=left_mesh.vertices * [-1, 1, 1]).flipped()


@pytest.fixture(scope="module")
def turned(left_mesh: TriangleMesh) -> TriangleMesh:
    """The foot lying on its side."""
    lying = np.eye(4)
    lying[:3, :3] = [[0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]]
    return left_mesh.transformed(lying)


@pytest.fixture(scope="module")
def length_mm(left_mesh: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> float:
    path = tmp_path_factory.mktemp("true") / "foot.stl"
    write_stl(left_mesh, path)
    return examine_scan(path).feet[0].candidates[0].length_mm


@pytest.mark.parametrize("factor", [1e-4, 1e6])
def test_a_known_length_of_the_foot_scales_any_unit(turned, length_mm, tmp_path, factor):
    path = tmp_path / "foot.stl"
    write_stl(replace(turned, vertices=turned.vertices * factor), path)
    with pytest.raises(InputError):
        examine_scan(path)
    examination = examine_scan(path, ImportChoice(known_size=KnownFootLength(length_mm)))
    assert examination.feet[0].candidates[0].length_mm == pytest.approx(length_mm, rel=0.004)
    height_mm = np.ptp(examination.read.mesh.vertices, axis=0)
    assert height_mm == pytest.approx(np.ptp(turned.vertices, axis=0), rel=0.005)
    assert any("Scaled by the size that is known" in note for note in examination.notes)


def test_two_points_and_their_distance_give_the_scale(turned, tmp_path):
    path = tmp_path / "foot.stl"
    scaled = turned.vertices * 3.7e3
    write_stl(replace(turned, vertices=scaled), path)
    first, second = scaled[10], scaled[2000]
    between_mm = float(np.linalg.norm(turned.vertices[10] - turned.vertices[2000]))
    known = KnownDistance(tuple(first), tuple(second), between_mm)
    surface = examine_scan(path, ImportChoice(known_size=known)).read.mesh
    assert np.ptp(surface.vertices, axis=0) == pytest.approx(
        np.ptp(turned.vertices, axis=0), rel=1e-4
    )
    with pytest.raises(InputError, match="coincide"):
        examine_scan(path, ImportChoice(known_size=replace(known, second=known.first)))


def test_a_shoe_size_stands_for_the_foot_that_it_fits():
    assert known_length_mm(KnownShoeSize(42)) == pytest.approx(265, abs=1)
    assert known_length_mm(KnownShoeSize(36)) == pytest.approx(225, abs=1)
    for wrong in (KnownShoeSize(95), KnownFootLength(26.5), KnownFootLength(float("nan"))):
        with pytest.raises(InputError, match="correct the length"):
            known_length_mm(wrong)


def folder_of(tmp_path: Path, **meshes: TriangleMesh) -> Path:
    for name, mesh in meshes.items():
        write_stl(mesh, tmp_path / f"{name}.stl")
    return tmp_path


def test_a_folder_gives_both_feet_by_their_names(left_mesh, right_mesh, tmp_path):
    folder = folder_of(tmp_path, foot_R=right_mesh, foot_L=left_mesh)
    feet = examine_scan(folder).feet
    assert [foot.candidates[0].side for foot in feet] == [Side.LEFT, Side.RIGHT]
    assert [foot.path for foot in feet] == [folder / "foot_L.stl", folder / "foot_R.stl"]
    assert not any(foot.doubts for foot in feet)


def test_names_that_contradict_the_shapes_are_doubted(left_mesh, right_mesh, tmp_path):
    feet = examine_scan(folder_of(tmp_path, links=right_mesh, rechts=left_mesh)).feet
    assert all("is named as a" in foot.doubts[0] for foot in feet)


def test_names_that_tell_nothing_leave_it_to_the_shapes(left_mesh, right_mesh, tmp_path):
    feet = examine_scan(folder_of(tmp_path, scan1=right_mesh, scan2=left_mesh)).feet
    assert [foot.candidates[0].side for foot in feet] == [Side.RIGHT, Side.LEFT]


def clicked_on(foot: TriangleMesh) -> PoseClicks:
    """Heel, toe and sole of a foot that stands with its toes towards +y."""
    y, z = foot.vertices[:, 1], foot.vertices[:, 2]
    ball = np.abs(y - (y.min() + 0.7 * np.ptp(y))) < 10
    numbers = y.argmin(), y.argmax(), np.flatnonzero(ball)[z[ball].argmin()]
    heel, toe, sole = (tuple(map(float, foot.vertices[number])) for number in numbers)
    return PoseClicks(heel, toe, sole)


def is_clicked(found: FoundFoot) -> bool:
    return any("heel, toe and sole were clicked" in note for note in found.notes)


def test_points_clicked_on_one_of_two_feet_tell_how_that_one_lies(left_mesh, right_mesh, tmp_path):
    beside = replace(right_mesh, vertices=right_mesh.vertices + np.array([200.0, 0.0, 0.0]))
    choice = ImportChoice(pose=clicked_on(beside))
    write_stl(left_mesh, tmp_path / "left.stl")
    write_stl(beside, tmp_path / "right.stl")
    feet = {foot.told_side: foot for foot in examine_scan(tmp_path, choice).feet}
    assert is_clicked(feet[Side.RIGHT])
    assert not is_clicked(feet[Side.LEFT])


def test_a_file_with_both_feet_beside_another_scan_loses_none(left_mesh, right_mesh, tmp_path):
    beside = right_mesh.vertices + np.array([200.0, 0.0, 0.0])
    both = TriangleMesh(
        np.vstack([1.002 * left_mesh.vertices, beside]),  # the larger foot comes first
        np.vstack([left_mesh.triangles, right_mesh.triangles + len(left_mesh.vertices)]),
    )
    feet = examine_scan(folder_of(tmp_path, both=both, again=right_mesh)).feet
    assert sorted(str(foot.told_side) for foot in feet) == ["left", "right", "right"]
    asked = [foot.told_side for foot in feet if any("holds two feet" in it for it in foot.doubts)]
    assert asked == [Side.LEFT, Side.RIGHT]


def read_once_more(scanned: ScannedFoot, tmp_path: Path) -> ScannedFoot:
    """Save a foot in a case, open the case, and read the scan with what it keeps of it."""
    case = tmp_path / "case.insole"
    write_case(CaseRecord.of_foot(FootRecord.begun(scanned.foot, scanned.source)), case)
    feet = read_case(case).feet
    choice = choice_of(feet)
    examination = examine_scan(Path(feet[0].source.path), choice)
    near = nearest_candidate(examination.feet, feet[0].foot)
    assert near is not None
    return take_foot(examination, examination.feet[near[0]], near[1], choice)


@pytest.mark.parametrize("said", ["length", "distance", "unit"])
def test_a_case_keeps_what_was_said_of_its_scan(left_mesh, length_mm, tmp_path, said):
    path = tmp_path / "foot.stl"
    factor = 0.1 if said == "unit" else 3e4
    write_stl(replace(left_mesh, vertices=left_mesh.vertices * factor), path)
    first, second = left_mesh.vertices[10], left_mesh.vertices[2000]
    between_mm = float(np.linalg.norm(first - second))
    known = {
        "length": KnownFootLength(length_mm + 7),
        "distance": KnownDistance(tuple(first * factor), tuple(second * factor), between_mm),
    }.get(said)
    choice = ImportChoice(unit="cm" if said == "unit" else None, known_size=known)
    mm = read_scan(path, choice).mm_per_unit * factor
    said_all = replace(choice, pose=clicked_on(left_mesh).scaled(mm), force=True)
    examination = examine_scan(path, said_all)
    found = examination.feet[0]
    assert is_clicked(found)
    other = found.best(found.candidates[0].side.other)
    assert other is not None

    scanned = take_foot(examination, found, other, said_all)
    again = read_once_more(scanned, tmp_path)

    assert again.source == scanned.source
    assert again.foot.notes == scanned.foot.notes
    np.testing.assert_array_equal(again.foot.mesh.vertices, scanned.foot.mesh.vertices)
