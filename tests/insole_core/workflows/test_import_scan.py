"""Any scan of a foot: what it shows, how the foot lies, which foot it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from insole_core.cases.scan_source import ImportChoice
from insole_core.foot.foot_placement import SideMismatchError
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.workflows.import_scan import ScanExamination, examine_scan, take_foot
from insole_core.workflows.open_scan import open_scan
from insole_core.workflows.scanned_feet import mesh_source


@pytest.fixture(scope="module")
def scan(left_mesh: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "foot.ply"
    write_ply(left_mesh, path)
    return path


@pytest.fixture(scope="module")
def examination(scan: Path) -> ScanExamination:
    return examine_scan(scan)


def test_a_foot_has_a_candidate_of_either_side(examination: ScanExamination) -> None:
    (found,) = examination.feet
    assert (examination.read.unit, examination.form) == ("mm", Form.FOOT)
    assert [one.side for one in found.candidates] == [Side.LEFT, Side.RIGHT]
    assert found.candidates[0].length_mm == pytest.approx(245, abs=2)


def test_a_size_of_feet_in_two_units_is_asked(left_mesh: TriangleMesh, tmp_path: Path) -> None:
    path = tmp_path / "foot.ply"
    inches = left_mesh.vertices * 290 / 245 / 25.4
    write_ply(left_mesh.moved(inches), path)
    (found,) = examine_scan(path).feet
    assert "a foot of 291 mm if it is in inches, a foot of 114 mm (a child's, EU 20)" in " ".join(
        found.doubts
    )
    (told,) = examine_scan(path, ImportChoice(unit="inch")).feet
    assert told.doubts == ()


def test_a_guessed_length_is_not_told_as_one(left_mesh: TriangleMesh, tmp_path: Path) -> None:
    path = tmp_path / "foot.ply"
    toeless = left_mesh.part(left_mesh.vertices[:, 1] < 55)
    write_ply(toeless.moved(toeless.vertices * 340 / 245 / 25.4), path)
    (found,) = examine_scan(path).feet
    said = " ".join(found.doubts)
    scanned_mm = found.candidates[0].surface_mm
    assert f"without toes, of which {scanned_mm:.0f} mm were scanned if it is in inches" in said
    assert f"a foot of {found.candidates[0].length_mm:.0f} mm" not in said


def test_the_other_side_is_taken_by_force_only(examination: ScanExamination) -> None:
    (found,) = examination.feet
    left, right = found.candidates
    assert take_foot(examination, found, left).foot.side is Side.LEFT
    with pytest.raises(SideMismatchError, match="looks like a left foot"):
        take_foot(examination, found, right)
    forced = take_foot(examination, found, right, ImportChoice(force=True))
    assert forced.foot.side is Side.RIGHT
    assert forced.foot.source2insole[2, :3] @ left.source2insole[2, :3] > 0.98


def test_the_only_scan_of_a_folder_is_taken(left_mesh: TriangleMesh, tmp_path: Path) -> None:
    file = tmp_path / "visit" / "foot.ply"
    file.parent.mkdir()
    write_ply(left_mesh, file)
    examination = examine_scan(file.parent)
    (found,) = examination.feet
    source = take_foot(examination, found, found.candidates[0]).source
    assert source.path == str(file.resolve())
    assert source.sha256 == mesh_source(file).sha256


def test_one_of_two_scans_is_taken_by_its_side(
    left_mesh: TriangleMesh, right_mesh: TriangleMesh, tmp_path: Path
) -> None:
    write_ply(left_mesh, tmp_path / "left.ply")
    write_ply(right_mesh, tmp_path / "right.ply")
    source = open_scan(tmp_path, Side.RIGHT).source
    assert source.path == str((tmp_path / "right.ply").resolve())


def test_a_file_that_is_named_as_the_other_foot_is_doubted(
    left_mesh: TriangleMesh, tmp_path: Path
) -> None:
    file = tmp_path / "right.ply"
    write_ply(left_mesh, file)
    (found,) = examine_scan(file, ImportChoice(side=Side.LEFT)).feet
    assert [doubt for doubt in found.doubts if "is named as a right foot" in doubt]
