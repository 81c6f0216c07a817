from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError, UsageError
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.foot.foot_placement import DoubtfulScanError
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.workflows.open_scan import open_scan
from insole_core.workflows.scanned_feet import ScannedFoot, change_of_source


@pytest.fixture(scope="module")
def scan(left_mesh: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "foot.ply"
    write_ply(left_mesh, path)
    return path


@pytest.fixture(scope="module")
def scanned(scan: Path) -> ScannedFoot:
    return open_scan(scan, Side.LEFT)


def test_a_mesh_becomes_a_foot_with_its_source(scan: Path, scanned: ScannedFoot) -> None:
    assert scanned.foot.side is Side.LEFT
    assert scanned.foot.notes
    assert (scanned.source.kind, scanned.source.path) == ("mesh", str(scan.resolve()))
    assert change_of_source(scanned.source) == ""


def test_a_mesh_without_a_side_is_a_wrong_call(scan: Path) -> None:
    with pytest.raises(UsageError, match="add --side"):
        open_scan(scan)


def test_a_scan_that_changed_or_went_is_said(scanned: ScannedFoot, tmp_path: Path) -> None:
    source = scanned.source
    assert "has changed" in change_of_source(replace(source, sha256="0" * 64))
    gone = replace(source, path=str(tmp_path / "gone.ply"))
    assert "not there any more" in change_of_source(gone)
    assert change_of_source(replace(source, path="example.zip")) == ""


def larger(mesh: TriangleMesh, factor: float, path: Path) -> Path:
    write_ply(replace(mesh, vertices=mesh.vertices * factor), path)
    return path


def test_three_clicks_open_a_doubtful_scan_with_the_doubt_as_a_warning(
    left_mesh: TriangleMesh, tmp_path: Path
) -> None:
    path = larger(left_mesh, 1.33, tmp_path / "long.ply")
    with pytest.raises(DoubtfulScanError, match="which few feet are"):
        open_scan(path, Side.LEFT)
    length_mm = 1.33 * float(np.ptp(left_mesh.vertices[:, 1]))
    clicks = PoseClicks((0.0, 2.0, 20.0), (0.0, length_mm - 8, 12.0), (0.0, 0.65 * length_mm, 0.0))
    scanned = open_scan(path, Side.LEFT, choice=ImportChoice(pose=clicks))
    assert any("which few feet are" in warning for warning in scanned.warnings)
    assert scanned.source.choice == ImportChoice(Side.LEFT, "mm", pose=clicks)


def test_a_length_that_no_foot_has_is_opened_by_force_only(
    left_mesh: TriangleMesh, tmp_path: Path
) -> None:
    path = larger(left_mesh, 1.5, tmp_path / "giant.ply")
    with pytest.raises(InputError, match="feet are 90 to 350 mm long"):
        open_scan(path, Side.LEFT)
    assert open_scan(path, Side.LEFT, choice=ImportChoice(force=True)).foot.length_mm > 350
