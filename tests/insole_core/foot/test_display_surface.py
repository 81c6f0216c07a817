"""The surface for display has an even border, and what was measured stays what it was."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.cases.case_file import read_case
from insole_core.foot.display_surface import DisplaySurface, display_surface
from insole_core.foot.foot import Foot
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces
from insole_core.resources import resource_path


@pytest.fixture(scope="module")
def example() -> Foot:
    foot = read_case(resource_path("example/example.insole")).foot
    assert foot is not None
    return foot


@pytest.fixture(scope="module")
def shown(example: Foot) -> DisplaySurface:
    return display_surface(example.mesh)


def border_mm(mesh: TriangleMesh) -> float:
    start, end = np.moveaxis(mesh.vertices[mesh.links.ends], 1, 0)
    return float(np.linalg.norm(end - start, axis=1).sum())


def holes(mesh: TriangleMesh) -> int:
    """Number of boundary curves."""
    at, number = np.unique(mesh.links.ends, return_inverse=True)
    a, b = number.reshape(-1, 2).T
    chain = TriangleMesh(mesh.vertices[at], np.stack([a, b, b], 1).astype(np.int32))
    return pieces(chain)[0]


def check_is_presentable(mesh: TriangleMesh, shown: DisplaySurface) -> None:
    assert border_mm(shown.mesh) < 0.5 * border_mm(mesh)
    assert holes(shown.mesh) < 0.5 * holes(mesh)
    crowded = [(surface.links.edges[1] > 2).sum() for surface in (mesh, shown.mesh)]
    assert crowded[1] <= crowded[0]  # as many edges of three triangles as were measured
    assert 0.95 < shown.mesh.area_mm2 / mesh.area_mm2 < 1.1
    low, high = mesh.bounds_mm[:, :2], shown.mesh.bounds_mm[:, :2]
    assert np.abs(low - high).max() < 1.5  # neither heel nor toes get shorter


def test_the_border_of_the_example_is_even(example: Foot, shown: DisplaySurface) -> None:
    check_is_presentable(example.mesh, shown)


def test_toes_are_not_joined(shown: DisplaySurface) -> None:
    mesh = shown.mesh
    corners = mesh.vertices[mesh.triangles[shown.is_filled]]
    sides_mm = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    low = corners[..., 2].max(axis=1) < 12.0
    assert low.sum() > 50
    assert sides_mm[low].max() < 5.0


def test_what_was_measured_stays_in_its_place(example: Foot, shown: DisplaySurface) -> None:
    inner = ~shown.mesh.links.is_boundary
    start, end = np.moveaxis(example.mesh.vertices[shown.ends], 1, 0)
    source = start + shown.share[:, None] * (end - start)
    assert np.abs(shown.mesh.vertices - source)[inner].max() < 1e-9
    moved_mm = np.linalg.norm(shown.mesh.vertices - source, axis=1)
    assert moved_mm.max() < 6.0
    assert np.quantile(moved_mm, 0.98) < 1.0
    assert inner.mean() > 0.95


def test_filled_gaps_have_no_value(example: Foot, shown: DisplaySurface) -> None:
    mesh, values = shown.with_values(example.mesh.vertices[:, 1])
    has_value = np.isfinite(values)[mesh.triangles]
    np.testing.assert_array_equal(has_value.all(axis=1), ~shown.is_filled)
    np.testing.assert_array_equal(has_value.any(axis=1), ~shown.is_filled)
    known = np.isfinite(values)
    assert np.abs(values[known] - mesh.vertices[known, 1]).max() < 6.0
    assert np.median(np.abs(values[known] - mesh.vertices[known, 1])) == 0.0
    assert mesh.area_mm2 == pytest.approx(shown.mesh.area_mm2)


def test_files_say_what_was_measured(example: Foot, tmp_path: Path) -> None:
    before, after = tmp_path / "before.ply", tmp_path / "after.ply"
    write_ply(example.mesh, before)
    shown = example.display_surface()
    assert example.display_surface() is shown
    write_ply(example.mesh, after)
    assert before.read_bytes() == after.read_bytes()
    assert shown.mesh.colors is not None
    assert len(shown.mesh.colors) == len(shown.mesh.vertices)


def test_a_closed_surface_is_shown_as_it_is() -> None:
    corners = np.array([[0.0, 0, 0], [30, 0, 0], [0, 30, 0], [0, 0, 30]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32)
    mesh = TriangleMesh(corners, faces)
    assert display_surface(mesh).mesh is mesh


def test_a_surface_that_is_closed_by_filling_is_whole() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4, radius=40.0)
    ball.apply_translation([0.0, 0.0, 40.0])
    mesh = TriangleMesh(np.array(ball.vertices), ball.faces.astype(np.int32))
    hole = np.linalg.norm(mesh.vertices - mesh.vertices[10], axis=1) < 1.0
    shown = display_surface(mesh.part(~hole))
    assert shown.mesh.is_closed
    assert 3 <= shown.is_filled.sum() <= 4


def test_an_even_border_stays() -> None:
    x, y = np.meshgrid(np.arange(0.0, 81.0, 2.0), np.arange(0.0, 251.0, 2.0))
    index = np.arange(x.size, dtype=np.int32).reshape(x.shape)
    a, b, c, d = (
        part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    )
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    mesh = TriangleMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), triangles)
    shown = display_surface(mesh)
    assert not shown.is_filled.any()
    assert mesh.area_mm2 - shown.mesh.area_mm2 < 40.0  # its corners are rounded


def test_it_is_fast(example: Foot) -> None:
    fresh = TriangleMesh(example.mesh.vertices, example.mesh.triangles, example.mesh.colors)
    start = time.process_time()
    display_surface(fresh)
    assert time.process_time() - start < 3.0  # 0.4 s usually


@pytest.mark.shared
def test_a_session_of_the_reference_is_presentable(recorded_foot: Callable[[str], Foot]) -> None:
    foot = recorded_foot("left_a")
    check_is_presentable(foot.mesh, foot.display_surface())


@pytest.mark.shared
@pytest.mark.parametrize(
    "name", ["plantar_scan.obj", "dupontgu/left_foot.stl", "limb/stl_file.stl"]
)
def test_foreign_scans_hardly_change(
    scanned_mesh: Callable[[str], TriangleMesh], name: str
) -> None:
    mesh = scanned_mesh(name)
    shown = display_surface(mesh).mesh
    assert abs(shown.area_mm2 / mesh.area_mm2 - 1) < 0.005
    assert np.abs(shown.bounds_mm - mesh.bounds_mm).max() < 1.5
