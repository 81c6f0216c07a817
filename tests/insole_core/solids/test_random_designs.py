"""Ten designs by chance: no other program finds a fault in their solids (benchmark: 200)."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks._random_designs import random_solids
from benchmarks._witnesses import by_admesh, by_manifold, by_prusa_info, by_trimesh
from insole_core.formats.solid_content import SolidPart
from insole_core.formats.stl import write_stl
from insole_core.formats.three_mf import write_3mf
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import make_solid

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def solids() -> list[TriangleMesh]:
    return [make_solid(*each) for each in random_solids(10)]


def test_trimesh_and_manifold3d_find_no_fault(solids, tmp_path: Path):
    path = tmp_path / "solid.stl"
    for solid in solids:
        write_stl(solid, path)
        assert by_trimesh(path) == []
        assert by_manifold(solid) == []


def test_admesh_finds_no_fault(solids, tmp_path: Path):
    path = tmp_path / "solid.stl"
    for solid in solids:
        write_stl(solid, path)
        faults = by_admesh(path)
        if faults is None:
            pytest.skip("the program admesh is not installed")
        assert faults == []


def test_prusa_slicer_calls_them_manifold(solids, tmp_path: Path):
    stl, three_mf = tmp_path / "solid.stl", tmp_path / "solid.3mf"
    for solid in solids[::4]:  # one of each kind
        write_stl(solid, stl)
        write_3mf([SolidPart(solid, "Ünïcode <&> 足")], three_mf)
        info, packed = by_prusa_info(stl), by_prusa_info(three_mf)
        if info is None or packed is None:
            pytest.skip("the program prusa-slicer is not installed")
        assert info["manifold"] == packed["manifold"] == "yes"
        for axis, size in zip("xyz", solid.bounds_mm[1] - solid.bounds_mm[0], strict=True):
            assert float(packed[f"size_{axis}"]) == pytest.approx(size, abs=0.01)


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "side"),
    [("left_a", Side.LEFT), ("right_b", Side.RIGHT), ("plantar_scan.obj", Side.RIGHT)],
)
def test_real_feet(true_foot, real_foot, tmp_path: Path, name: str, side: Side):
    foot = real_foot(name, side) if "." in name else true_foot(name, side)
    path = tmp_path / "solid.stl"
    for kind in ("insole", "positive"):  # blocks of them are among those of test_block
        solid = make_solid(build_insole(foot, InsoleDesign(side)), kind)
        write_stl(solid, path)
        assert by_trimesh(path) == []
        assert by_manifold(solid) == []
        assert not by_admesh(path)
