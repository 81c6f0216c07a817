"""Solids that were worked on: fewer triangles, letters, and two in one block."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from benchmarks._witnesses import by_admesh
from insole_core.errors import DesignError
from insole_core.export.lettering import with_known_letters
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.marking import mark
from insole_core.solids.nesting import nest_pair
from insole_core.solids.simplification import greatest_distance, simplify, to_manifold
from insole_core.solids.solid import insole_solid


@pytest.fixture(scope="module")
def left(left_foot) -> TriangleMesh:
    return insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT)))


@pytest.fixture(scope="module")
def coarse_pair(left_foot, right_foot) -> tuple[TriangleMesh, TriangleMesh]:
    left, right = (
        insole_solid(build_insole(foot, InsoleDesign(foot.side, grid_mm=2.0)))
        for foot in (left_foot, right_foot)
    )
    return left, right


def check_by_admesh(mesh: TriangleMesh, path: Path) -> None:
    write_stl(mesh, path)
    faults = by_admesh(path)
    if faults is None:
        pytest.skip("the program admesh is not installed")
    assert faults == []


@pytest.mark.slow
def test_simplified_solid_keeps_its_promise(left, tmp_path: Path):
    result = simplify(left, 40_000, 0.05)
    assert len(result.mesh.triangles) <= 40_000 < len(left.triangles)
    assert result.mesh.is_closed
    assert 0 < result.deviation_mm <= 0.05
    assert result.mesh.volume_mm3 == pytest.approx(left.volume_mm3, rel=1e-3)
    check_by_admesh(result.mesh, tmp_path / "simple.stl")


def test_solid_below_the_target_stays_as_it_is(left):
    result = simplify(left, 10**6, 0.05)
    assert result.mesh is left
    assert result.deviation_mm == 0


@pytest.mark.slow
def test_target_that_cannot_be_met(coarse_pair):
    with pytest.raises(DesignError, match="100 triangles are too few"):
        simplify(coarse_pair[0], 100, 0.05)


def test_open_mesh_is_no_solid(left):
    opened = TriangleMesh(left.vertices, left.triangles[5:])
    with pytest.raises(DesignError, match="closed solid"):
        simplify(opened, 100, 0.05)


def test_distance_from_a_known_surface(left):
    flat = TriangleMesh(
        np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0]]), np.array([[0, 1, 2]], np.int32)
    )
    points = np.array([[1.0, 1, 2], [-3, -4, 0], [12, 0, 4]])
    each = [greatest_distance(flat, point[None]) for point in points]
    assert each == pytest.approx([2, 5, 5])
    assert greatest_distance(flat, points[:2]) == pytest.approx(5)


def test_the_farthest_of_many_points_is_found_beside_those_that_only_seem_far():
    """In the tip of a needle the nearest samples may lie on another triangle."""
    corners = np.array([[0.0, 0, 0], [90, 0, 0], [90, 0.1, 0], [0, 0.1, 3], [0, -9, 0]])
    bent = TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3], [0, 4, 1]], np.int32))
    rng = np.random.default_rng(1)
    points = np.stack([*rng.uniform([[0], [0]], [[90], [0.1]], (2, 900)), np.zeros(900)], axis=1)
    each = [greatest_distance(bent, point[None]) for point in points[:40]]
    assert greatest_distance(bent, points[:40]) <= max(each) + 1e-12
    points[700, 2] = -0.5  # below all of it
    assert greatest_distance(bent, points) == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("relief", ["engraved", "raised"])
def test_identification(left, relief, tmp_path: Path):
    marked = mark(
        left, ("Müller Ł 7", "left 2026-11-20"), centre_mm=(-5, 130), room_mm=(40, 100),
        relief=relief,
    )  # fmt: skip
    assert marked.is_closed
    lowest, change = marked.bounds_mm[0, 2], marked.volume_mm3 - left.volume_mm3
    assert lowest == pytest.approx(0 if relief == "engraved" else -0.6, abs=1e-9)
    assert -400 < change < -50 if relief == "engraved" else 50 < change < 400
    check_by_admesh(marked, tmp_path / "marked.stl")


def test_identification_is_read_from_below(left):
    """Of an L, the upright is at the left end and the foot points to the right."""
    marked = mark(left, ("L",), centre_mm=(-5, 100), room_mm=(40, 60), letter_mm=20)
    ceiling = marked.vertices[np.isclose(marked.vertices[:, 2], 0.6)]
    # From below with y to the right, x points up: reading direction +y, letters stand towards +x.
    upright = ceiling[ceiling[:, 0] > np.median(ceiling[:, 0]) + 3]
    assert upright[:, 1].mean() < ceiling[:, 1].mean()


@pytest.mark.parametrize(
    ("text", "sentence"), [(" \n", "is empty"), ("x" * 90, "too long"), ("\x00", "is empty")]
)
def test_identification_that_cannot_be_written(left, text, sentence):
    with pytest.raises(DesignError, match=sentence):
        mark(left, (text,), centre_mm=(-5, 130), room_mm=(40, 100))


def test_identification_beside_the_bottom(left):
    with pytest.raises(DesignError, match="flat bottom"):
        mark(left, ("left",), centre_mm=(-60, 130), room_mm=(40, 100))


@pytest.mark.parametrize(
    ("text", "known"),
    [("Ångström", "Ångström"), ("Иванов", "Иванов"), ("足", "?"), ("a\tb", "a b"), ("ＡＢ", "AB")],
)
def test_letters_of_any_script(text, known):
    assert with_known_letters(text) == known


@pytest.mark.slow
def test_pair_in_one_block(coarse_pair):
    left, right = coarse_pair
    nest = nest_pair(left, right, (340, 220, 40))
    bodies = [to_manifold(mesh) for mesh in nest.meshes]
    assert (bodies[0] ^ bodies[1]).volume() == 0
    assert bodies[0].min_gap(bodies[1], 30.0) >= 12 - 1e-6
    for mesh, original, a2b in zip(nest.meshes, (left, right), nest.insole2block, strict=True):
        assert mesh.bounds_mm[0, :2].min() >= 4 - 1e-9
        assert np.linalg.det(a2b[:3, :3]) == pytest.approx(1)
        assert mesh.volume_mm3 == pytest.approx(original.volume_mm3, rel=1e-9)
    assert nest.size_mm[0] < 2 * 110 + 20
    low = np.min([mesh.bounds_mm[0] for mesh in nest.meshes], axis=0)
    high = np.max([mesh.bounds_mm[1] for mesh in nest.meshes], axis=0)
    np.testing.assert_allclose((low + high)[:2], (220, 340))


def test_block_too_small_for_a_pair(coarse_pair):
    with pytest.raises(DesignError, match="needs a block of"):
        nest_pair(*coarse_pair, (300, 120, 40))
