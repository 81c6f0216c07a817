"""The block: closed, wound outwards, in its frame, with every apex where it was asked for."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from benchmarks._witnesses import by_admesh
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.block import block_solid
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign


def heights(mesh: TriangleMesh, xy: np.ndarray) -> np.ndarray:
    """Top of a solid at places (n, 2), by rays from above."""
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    origins = np.column_stack([xy, np.full(len(xy), 200.0)])
    hits, rays, _ = solid.ray.intersects_location(origins, np.tile([0, 0, -1.0], (len(xy), 1)))
    top = np.full(len(xy), -np.inf)
    np.maximum.at(top, rays, hits[:, 2])
    return top


def check_solid(mesh: TriangleMesh, path: Path) -> None:
    write_stl(mesh, path)
    read = trimesh.load_mesh(path)
    assert read.is_watertight
    assert read.is_winding_consistent
    assert read.volume == pytest.approx(mesh.volume_mm3, rel=1e-5)
    assert read.volume > 0
    assert read.bounds[0, 2] == 0
    faults = by_admesh(path)
    if faults is None:
        pytest.skip("the program admesh is not installed")
    assert faults == []


@pytest.mark.parametrize(
    "centres",
    [
        [],
        [(12.3, 150.4)],
        [(12.0, 150.0)],
        [(12.0, 150.4), (12.2, 150.6)],
        [(-500 / 3, 10.0), (0.0, 60.0)],
    ],
    ids=["none", "between", "node", "one cell", "far"],
)
def test_block_is_a_solid_for_other_programs(left_foot, tmp_path, centres):
    pads = tuple(Pelott(centre_mm=centre, height_mm=5) for centre in centres)
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, pads))
    mesh = block_solid(insole)
    assert mesh.is_closed
    check_solid(mesh, tmp_path / "block.stl")


def test_block_has_the_size_of_foot_and_margin(left_foot):
    mesh = block_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, margin_mm=15)))
    low = left_foot.mesh.vertices[left_foot.mesh.vertices[:, 2] < 45, :2]
    assert mesh.vertices.min(axis=0)[:2] == pytest.approx(low.min(axis=0) - 15, abs=1)
    assert mesh.vertices.max(axis=0)[:2] == pytest.approx(low.max(axis=0) + 15, abs=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("grid_mm", "centre"), [(0.5, (12.3, 150.4)), (1.0, (-3.5, 140.5)), (2.0, (8.0, 152.0))]
)
def test_apex_is_where_it_was_asked_for(left_foot, grid_mm, centre):
    pad = Pelott(centre_mm=centre, height_mm=6, turn_deg=20)
    plain = InsoleDesign(Side.LEFT, (Posting(rearfoot_deg=4),), grid_mm=grid_mm)
    without = block_solid(build_insole(left_foot, plain))
    with_pad = block_solid(build_insole(left_foot, plain.with_added(pad)))
    reach = np.arange(-2.5, 2.51, 0.1)
    x, y = np.meshgrid(centre[0] + reach, centre[1] + reach)
    places = np.column_stack([x.ravel(), y.ravel()])
    added = heights(with_pad, places) - heights(without, places)
    assert added.max() == pytest.approx(6, abs=0.05)
    assert np.linalg.norm(places[added.argmax()] - centre) < 0.3


def test_apex_counts_every_pad_that_lies_there(left_foot):
    pads = (Pelott(centre_mm=(10.2, 150.3), height_mm=4), Pelott(centre_mm=(14.0, 150.0)))
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, pads))
    mesh = block_solid(insole)
    top = heights(mesh, np.array([[10.2, 150.3]]))
    nearby = insole.contact.height_at(np.array([10.2, 150.3]))
    assert top[0] == pytest.approx(nearby, abs=0.05)


def test_pad_that_is_switched_off_leaves_no_trace(left_foot):
    design = InsoleDesign(Side.LEFT)
    off = Pelott(centre_mm=(12.3, 150.4), enabled=False)
    plain = block_solid(build_insole(left_foot, design))
    with_off = block_solid(build_insole(left_foot, design.with_added(off)))
    assert np.array_equal(plain.vertices, with_off.vertices)
    assert np.array_equal(plain.triangles, with_off.triangles)


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "side"),
    [("left_a", Side.LEFT), ("right_b", Side.RIGHT), ("plantar_scan.obj", Side.RIGHT)],
)
def test_real_feet_give_solids_with_the_big_toe_medially(
    true_foot, real_foot, tmp_path: Path, name: str, side: Side
):
    foot = real_foot(name, side) if "." in name else true_foot(name, side)
    centre = (12.3 * side.medial_sign, 150.4)
    pad = Pelott(centre_mm=centre, height_mm=6)
    plain = InsoleDesign(side, (Posting(rearfoot_deg=4),))
    design = plain.with_added(pad)
    with_pad, without = (block_solid(build_insole(foot, d)) for d in (design, plain))
    check_solid(with_pad, tmp_path / "block.stl")
    x, y = np.meshgrid(np.arange(-5, 5.01, 0.25) + centre[0], np.arange(-5, 5.01, 0.25) + centre[1])
    places = np.column_stack([x.ravel(), y.ravel()])
    added = heights(with_pad, places) - heights(without, places)
    assert added.max() == pytest.approx(6, abs=0.05)
    assert np.linalg.norm(places[added.argmax()] - centre) < 0.3
    level = build_insole(foot, replace(plain, corrections=()))
    y_mm = np.broadcast_to(level.contact.y_mm[:, None], level.measured.shape)
    x_mm = np.broadcast_to(level.contact.x_mm, level.measured.shape)
    toe = level.measured & (y_mm > 0.94 * foot.length_mm)
    assert x_mm[toe].mean() * side.medial_sign > 0
