"""Any scan of a foot: what it shows, how the foot lies, which foot it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from insole_core.export.ply import write_ply
from insole_core.foot.foot_placement import SideMismatchError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.workflows.import_scan import ImportChoice, examine_scan, take_foot


@pytest.fixture(scope="module")
def scan(left_mesh: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "foot.ply"
    write_ply(left_mesh, path)
    return path


def test_a_foot_has_a_candidate_of_either_side(scan: Path) -> None:
    examination = examine_scan(scan)
    (found,) = examination.feet
    assert (examination.read.unit, examination.form) == ("mm", Form.FOOT)
    assert [one.side for one in found.candidates] == [Side.LEFT, Side.RIGHT]
    assert found.candidates[0].length_mm == pytest.approx(245, abs=2)


def test_the_other_side_is_taken_by_force_only(scan: Path) -> None:
    examination = examine_scan(scan)
    (found,) = examination.feet
    left, right = found.candidates
    assert take_foot(examination, found, left).foot.side is Side.LEFT
    with pytest.raises(SideMismatchError, match="looks like a left foot"):
        take_foot(examination, found, right)
    forced = take_foot(examination, found, right, ImportChoice(force=True))
    assert forced.foot.side is Side.RIGHT
    assert forced.foot.source2insole[2, :3] @ left.source2insole[2, :3] > 0.98
