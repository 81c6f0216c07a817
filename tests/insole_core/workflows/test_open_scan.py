from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.errors import UsageError
from insole_core.export.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.workflows.open_scan import open_scan
from insole_core.workflows.scanned_foot import change_of_source


@pytest.fixture(scope="module")
def scan(left_mesh: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "foot.ply"
    write_ply(left_mesh, path)
    return path


def test_a_mesh_becomes_a_foot_with_its_source(scan: Path) -> None:
    scanned = open_scan(scan, Side.LEFT)
    assert scanned.foot.side is Side.LEFT
    assert scanned.foot.notes
    assert (scanned.source.kind, scanned.source.path) == ("mesh", str(scan.resolve()))
    assert change_of_source(scanned.source) == ""


def test_a_mesh_without_a_side_is_a_wrong_call(scan: Path) -> None:
    with pytest.raises(UsageError, match="add --side"):
        open_scan(scan)


def test_a_scan_that_changed_or_went_is_said(scan: Path, tmp_path: Path) -> None:
    source = open_scan(scan, Side.LEFT).source
    assert "has changed" in change_of_source(replace(source, sha256="0" * 64))
    gone = replace(source, path=str(tmp_path / "gone.ply"))
    assert "not there any more" in change_of_source(gone)
    assert change_of_source(replace(source, path="example.zip")) == ""
