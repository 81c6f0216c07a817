"""Reading surfaces of other programs: good ones, odd ones, and none at all."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.errors import InputError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="module")
def small_foot() -> TriangleMesh:
    """A left foot in few triangles."""
    return build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=5.0).mesh


def export(mesh: TriangleMesh, path: Path) -> Path:
    colors = None if mesh.colors is None else mesh.colors
    trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_colors=colors, process=False).export(path)
    return path


def open_sole(mesh: TriangleMesh) -> TriangleMesh:
    return mesh.part(mesh.vertices[:, 2] < 30)


@pytest.mark.parametrize("suffix", [".ply", ".stl", ".obj", ".STL"])
def test_all_formats_give_the_same_closed_surface(small_foot, tmp_path, suffix):
    read = read_mesh(export(small_foot, tmp_path / f"foot{suffix}"))
    assert read.unit == "mm"
    assert read.mesh.is_closed
    assert read.mesh.volume_mm3 == pytest.approx(small_foot.volume_mm3, rel=1e-4)
    assert not any("open" in note or "inside out" in note for note in read.notes)


def test_colours_stay_with_their_vertices(small_foot, tmp_path):
    read = read_mesh(export(small_foot, tmp_path / "foot.ply"))
    assert read.mesh.colors is not None
    distance, given = cKDTree(small_foot.vertices).query(read.mesh.vertices)
    assert distance.max() < 1e-3
    assert np.array_equal(read.mesh.colors, small_foot.colors[given])


def test_surface_without_colours_has_none(small_foot, tmp_path):
    assert read_mesh(export(small_foot, tmp_path / "foot.stl")).mesh.colors is None


@pytest.mark.parametrize(
    ("unit", "factor"), [("mm", 1.0), ("cm", 0.1), ("m", 0.001), ("inch", 1 / 25.4)]
)
def test_unit_is_found_from_the_size(small_foot, tmp_path, unit, factor):
    scaled = replace(small_foot, vertices=small_foot.vertices * factor)
    read = read_mesh(export(scaled, tmp_path / "foot.stl"))
    assert read.unit == unit
    assert np.ptp(read.mesh.vertices, axis=0) == pytest.approx(
        np.ptp(small_foot.vertices, axis=0), abs=0.01
    )
    words = {"mm": "millimetres", "cm": "centimetres", "m": "metres", "inch": "inches"}
    assert f"Read in {words[unit]}" in read.notes[0]


def test_a_given_unit_counts_whatever_the_size_suggests(small_foot, tmp_path):
    half = replace(small_foot, vertices=small_foot.vertices / 2 / 25.4)
    path = export(half, tmp_path / "half.ply")
    read = read_mesh(path, "inch")
    assert read.unit == "inch"
    assert np.ptp(read.mesh.vertices, axis=0) == pytest.approx(
        np.ptp(small_foot.vertices, axis=0) / 2, abs=0.01
    )
    with pytest.raises(InputError, match=r"half\.ply is 5 mm long if .* millimetres.*unit"):
        read_mesh(path, "mm")


@pytest.mark.slow
def test_a_scan_finer_than_a_foot_needs_is_thinned_and_said(tmp_path):
    shape, rng = FootShape(side=Side.LEFT), np.random.default_rng(1)
    foot = build_foot(shape, rng, cell_mm=4.0).mesh
    vertices, triangles = foot.vertices, foot.triangles
    while len(triangles) < 600_000:
        vertices, triangles = trimesh.remesh.subdivide(vertices, triangles)
    fine = TriangleMesh(vertices, triangles.astype(np.int32))
    read = read_mesh(export(fine, tmp_path / "foot.stl"))
    assert len(read.mesh.triangles) < 300_000
    assert any("thinned out to one point every 0.9 mm" in note for note in read.notes)
    assert read.mesh.volume_mm3 == pytest.approx(foot.volume_mm3, rel=1e-3)
    nearest = cKDTree(vertices).query(read.mesh.vertices)[1]
    across = np.sum((read.mesh.vertices - vertices[nearest]) * fine.vertex_normals[nearest], axis=1)
    assert np.quantile(np.abs(across), 0.99) < 0.05


def test_inside_out_is_turned_and_said(small_foot, tmp_path):
    read = read_mesh(export(small_foot.flipped(), tmp_path / "foot.ply"))
    assert read.mesh.volume_mm3 > 0
    assert any("inside out" in note for note in read.notes)


def test_open_surface_works_and_is_said(small_foot, tmp_path):
    read = read_mesh(export(open_sole(small_foot), tmp_path / "sole.obj"))
    assert any("open" in note for note in read.notes)


def test_open_surface_inside_out_is_turned(small_foot, tmp_path):
    sole = open_sole(small_foot)
    read = read_mesh(export(sole.flipped(), tmp_path / "sole.ply"))
    facing = (read.mesh.triangle_normals * [0, 0, 1]).sum()
    assert facing == pytest.approx((sole.triangle_normals * [0, 0, 1]).sum(), rel=1e-3)
    assert any("inside out" in note for note in read.notes)


def sphere(radius: float) -> TriangleMesh:
    ball = trimesh.creation.icosphere(radius=radius)
    return TriangleMesh(np.array(ball.vertices), np.array(ball.faces, np.int32))


def flat() -> TriangleMesh:
    corners = np.array([[0, 0, 0], [100, 0, 0], [100, 250, 0], [0, 250, 0]], float)
    return TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))


def without_area() -> TriangleMesh:
    corners = np.array([[0, 0, 0], [0, 100, 0], [0, 200, 0]], float)
    return TriangleMesh(corners, np.array([[0, 1, 2]], np.int32))


def with_nan() -> TriangleMesh:
    ball = sphere(100)
    vertices = ball.vertices.copy()
    vertices[3, 1] = np.nan
    return replace(ball, vertices=vertices)


@pytest.mark.parametrize(
    ("mesh", "reason"),
    [
        (sphere(5000), "which is no foot in millimetres"),
        (sphere(37), "which is no foot in millimetres"),
        (sphere(1e-5), "which is no foot in millimetres"),
        (flat(), "is flat"),
        (without_area(), "without area"),
        (with_nan(), "not numbers"),
    ],
    ids=["house", "thumb", "dust", "flat", "line", "nan"],
)
def test_what_is_no_foot_is_refused(mesh, reason, tmp_path):
    with pytest.raises(InputError, match=reason):
        read_mesh(export(mesh, tmp_path / "thing.ply"))


def test_missing_and_unknown_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="does not exist"):
        read_mesh(tmp_path / "none.ply")
    with pytest.raises(InputError, match="one of the formats"):
        read_mesh(tmp_path / "foot.xyzw")


@pytest.mark.parametrize("suffix", [".ply", ".stl", ".obj"])
@pytest.mark.parametrize("content", [b"", b"\x00\x01garbage\xff" * 9, b"nothing to see\n"])
def test_garbage_is_refused_with_its_name(suffix, content, tmp_path):
    path = tmp_path / f"foot{suffix}"
    path.write_bytes(content)
    with pytest.raises(InputError, match=f"foot{suffix}"):
        read_mesh(path)


@pytest.mark.parametrize("suffix", [".ply", ".stl"])
@pytest.mark.parametrize("kept", [0.05, 0.5, 0.99])
def test_file_cut_off_is_refused(small_foot, tmp_path, suffix, kept):
    path = export(small_foot, tmp_path / f"foot{suffix}")
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * kept)])
    with pytest.raises(InputError, match="export it again"):
        read_mesh(path)


def test_corner_that_does_not_exist_is_refused(tmp_path):
    path = tmp_path / "foot.ply"
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n100 0 0\n0 200 50\n3 0 1 7\n"
    )
    with pytest.raises(InputError, match=r"foot\.ply"):
        read_mesh(path)


def test_too_large_a_file_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "huge.stl"
    with path.open("wb") as file:
        file.truncate(700_000_000)
    with pytest.raises(InputError, match="too large"):
        read_mesh(path)
