"""Scans of others: each is read right, or asked, or refused with what it is."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from benchmarks._odd_scans import last_form
from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InputError
from insole_core.foot.foot_candidate import FoundFoot
from insole_core.foot.foot_placement import DoubtfulScanError
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import measure
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_resolution import thinned
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.import_scan import examine_scan, take_foot
from insole_core.workflows.open_scan import open_scan

LENGTH_MM = 246.0
FAR_MM, UTM_M = np.array([3e6, 4e5, 0.0]), np.array([4.5e5, 5.4e6, 0.0])


@pytest.fixture(scope="module")
def foot() -> TriangleMesh:
    """A left foot of 246 mm, in few triangles."""
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh
    return thinned(TriangleMesh(mesh.vertices, mesh.triangles), 5.0)


@pytest.fixture(scope="module")
def egg() -> TriangleMesh:
    """An ellipsoid as large as a foot, which may lie in several ways."""
    shape = trimesh.creation.icosphere(3)
    return TriangleMesh(np.asarray(shape.vertices) * (45, 125, 30), np.asarray(shape.faces))


def written(suffix: str, mesh: TriangleMesh, path: Path, change: object = None) -> Path:
    shape = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    made = shape.export(file_type=suffix)
    data = made.encode() if isinstance(made, str) else bytes(made)
    path.write_bytes(change(data) if callable(change) else data)
    return path


def scaled(mesh: TriangleMesh, length: float) -> TriangleMesh:
    return mesh.moved(mesh.vertices * length / LENGTH_MM)


@pytest.mark.parametrize(
    ("suffix", "length", "said"),
    [
        ("stl", 14.0, r"\(a child's, EU 23\) if it is in centimetres, 35\d mm \(no foot\)"),
        ("stl", 6.65, r"a foot of 16[89] mm \(a child's, EU 2\d\) if it is in inches"),
        ("stl", 180.0, r"a foot of (179|180) mm \(a child's, EU 29\) if it is in millimetres"),
        ("glb", 246.0, r"in metres by what it says.*a foot of 24\d mm if it is in millimetres"),
    ],
)
def test_a_guessed_unit_is_asked(
    foot: TriangleMesh, tmp_path: Path, suffix: str, length: float, said: str
) -> None:
    path = written(suffix, scaled(foot, length), tmp_path / f"foot.{suffix}")
    (found,) = examine_scan(path).feet
    assert len(found.unit_readings) >= 1
    assert re.search(said, " ".join(found.doubts))
    unit = found.unit_readings[0].unit
    told = open_scan(path, Side.LEFT, choice=ImportChoice(unit=unit)).foot
    assert told.length_mm == pytest.approx(found.unit_readings[0].length_mm)


def test_a_command_says_how_to_tell_the_unit(foot: TriangleMesh, tmp_path: Path) -> None:
    path = written("stl", scaled(foot, 14.0), tmp_path / "foot.stl")
    with pytest.raises(DoubtfulScanError, match=r"if it is in centimetres.*Use --unit"):
        open_scan(path, Side.LEFT, choice=ImportChoice(force=True))


def test_what_is_told_by_lengths_is_asked_once_the_unit_is_known(
    egg: TriangleMesh, tmp_path: Path
) -> None:
    path = written("stl", scaled(egg, 14.0), tmp_path / "egg.stl")
    (found,) = examine_scan(path).feet
    assert "does not say in which unit it is" in found.doubts[0]
    assert all("no toes" in doubt for doubt in found.doubts[1:])
    (told,) = examine_scan(path, ImportChoice(unit="cm")).feet
    assert "may lie in another way" in " ".join(told.doubts)


@pytest.mark.parametrize("side", [None, Side.LEFT])
def test_ways_to_lie_that_read_alike_are_said_once(
    egg: TriangleMesh, tmp_path: Path, side: Side | None
) -> None:
    path = written("stl", egg, tmp_path / "egg.stl")
    (found,) = examine_scan(path, ImportChoice(side)).feet
    (doubt,) = (doubt for doubt in found.doubts if "may lie in another way" in doubt)
    ways = str(doubt.values["others"]).split(" / ")
    assert len(ways) == len(set(ways))


@pytest.mark.parametrize(("suffix", "length"), [("stl", 24.6), ("stl", 0.246), ("glb", 0.14)])
def test_a_unit_that_is_certain_is_not_asked(
    foot: TriangleMesh, tmp_path: Path, suffix: str, length: float
) -> None:
    path = written(suffix, scaled(foot, length), tmp_path / f"foot.{suffix}")
    (found,) = examine_scan(path).feet
    assert (found.unit_readings, found.doubts) == ((), ())


@pytest.mark.parametrize(
    ("suffix", "change", "count"),
    [("obj", lambda data: data + b"\0", 1), ("stl", lambda data: data + bytes(5000), 5000)],
)
def test_zero_bytes_at_the_end_are_left_out_and_said(
    foot: TriangleMesh, tmp_path: Path, suffix: str, change: object, count: int
) -> None:
    read = read_mesh(written(suffix, foot, tmp_path / f"foot.{suffix}", change))
    assert f"{count} zero bytes at the end of the file were left out." in read.notes


@pytest.mark.parametrize("suffix", ["obj", "stl_ascii", "off"])
def test_decimal_commas_are_named(foot: TriangleMesh, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"foot.{suffix[:3]}"
    written(suffix, foot, path, lambda data: data.replace(b".", b","))
    with pytest.raises(InputError, match=f"decimal commas, which no {suffix[:3].upper()} file has"):
        read_mesh(path)


@pytest.fixture(scope="module")
def near(foot: TriangleMesh, tmp_path_factory: pytest.TempPathFactory) -> FoundFoot:
    """The foot at the origin, in metres."""
    path = tmp_path_factory.mktemp("near") / "near.off"
    return examine_scan(written("off", foot.moved(foot.vertices / 1000), path)).feet[0]


@pytest.mark.parametrize("far", [(6e4, 4e4, 0.0), (6e5, 4e5, 100.0), (4.5e8, 5.4e9, 1e5)])
def test_a_foot_far_from_the_origin_is_the_same(
    foot: TriangleMesh, near: FoundFoot, tmp_path: Path, far: tuple[float, float, float]
) -> None:
    metres = foot.moved((foot.vertices + np.array(far)) / 1000)
    lines = "".join("v {!r} {!r} {!r}\n".format(*row) for row in metres.vertices.tolist())
    lines += "".join("f {} {} {}\n".format(*row) for row in (foot.triangles + 1).tolist())
    path = tmp_path / "far.obj"
    path.write_text(lines, encoding="ascii")
    examination = examine_scan(path)
    (found,) = examination.feet
    assert [one.side for one in found.candidates] == [one.side for one in near.candidates]
    for there, here in zip(found.candidates, near.candidates, strict=True):
        assert there.length_mm == pytest.approx(here.length_mm, abs=0.7)
        assert there.dissimilarity == pytest.approx(here.dissimilarity, rel=0.05)
    assert (found.told_side, found.doubts) == (Side.LEFT, ())
    made = take_foot(examination, found, found.candidates[0]).foot
    assert abs(made.mesh.vertices[:, 0]).max() < 100


def test_lost_digits_are_told_or_refused(foot: TriangleMesh, tmp_path: Path) -> None:
    coarse = written("stl", foot.moved(foot.vertices + FAR_MM), tmp_path / "coarse.stl")
    (warning,) = open_scan(coarse, Side.LEFT).warnings
    assert "rounded to steps of 0.25 mm" in warning
    metres = foot.moved(foot.vertices / 1000 + UTM_M)
    with pytest.raises(InputError, match="the last digits of its coordinates are lost"):
        read_mesh(written("stl", metres, tmp_path / "lost.stl"))


def test_a_last_is_doubted_although_the_side_is_said(tmp_path: Path) -> None:
    path = written("stl", last_form(265.0), tmp_path / "last.stl")
    with pytest.raises(DoubtfulScanError, match="has no toes and no ankle, as a shoe last"):
        open_scan(path, Side.LEFT)
    foot = open_scan(path, Side.LEFT, choice=ImportChoice(form=Form.FOOT))
    assert "No single toes are seen" in " ".join(foot.warnings)


@pytest.mark.parametrize("side", [None, Side.LEFT, Side.RIGHT])
def test_missing_toes_are_told_without_a_length_and_whatever_the_side(
    foot: TriangleMesh, tmp_path: Path, side: Side | None
) -> None:
    y = foot.vertices[:, 1]
    path = written("stl", foot.part(y < y.min() + 205), tmp_path / "toeless.stl")
    (found,) = examine_scan(path, ImportChoice(side)).feet
    said = " ".join(found.doubts)
    assert "The toes seem to be missing, so that the length of the foot is not known" in said
    assert f"{found.candidates[0].length_mm:.0f} mm" not in said
    assert "20" in found.candidates[0].length_text


@pytest.mark.shared
def test_real_feet_whose_toes_melted_together_are_told_and_taken(shared_data: Path) -> None:
    for name, side in (("left", Side.LEFT), ("right", Side.RIGHT)):
        path = shared_data / "feet" / "dupontgu" / f"{name}_foot.stl"
        (warning,) = open_scan(path, side).warnings
        assert warning.startswith("No single toes are seen")


def test_a_surface_with_two_sides_is_read_as_one(foot: TriangleMesh, tmp_path: Path) -> None:
    both = TriangleMesh(foot.vertices, np.vstack([foot.triangles, foot.triangles[:, ::-1]]))
    read = read_mesh(written("ply", both, tmp_path / "both.ply"))
    assert len(read.mesh.triangles) == len(foot.triangles)


def test_a_double_sided_block_is_no_foot_in_words(tmp_path: Path) -> None:
    box = trimesh.creation.box((90, 250, 60))
    both = TriangleMesh(np.asarray(box.vertices), np.vstack([box.faces, box.faces[:, ::-1]]))
    with pytest.raises(InputError, match="no proportions of a foot"):
        open_scan(written("stl", both, tmp_path / "block.stl"), Side.LEFT)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (b"10 20 30\n" * 5000, "points in a few places only"),
        (b"1.5 " * 400_000, "each point has its own line"),
        (b"1 2 3\n" + b"1.5 " * 400_000, "each point has its own line"),
    ],
)
def test_odd_texts_of_points_are_refused_in_words(tmp_path: Path, text: bytes, reason: str) -> None:
    path = tmp_path / "points.xyz"
    path.write_bytes(text)
    with pytest.raises(InputError, match=reason):
        read_mesh(path)


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("foot.stl", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "Git LFS"),
        ("foot.pcd", b"# .PCD v0.7\n", "a point cloud of PCL"),
        ("foot.3dm", b"3D Geometry File Format", "a model of Rhino"),
        ("foot.csv", b"x,y,z\n1,2,3\n", "a table"),
        ("foot.ply", b"<!DOCTYPE html><html>", "a web page"),
        ("equal.xyz", b"10 20 30\n" * 5000, "points in a few places only"),
        ("flat.ply", b"ply\nformat ascii 1.0\nend_header\n", "no points"),
    ],
)
def test_what_is_no_scan_is_named_before_the_side_is_asked(
    tmp_path: Path, name: str, data: bytes, reason: str
) -> None:
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(InputError, match=reason):
        open_scan(path)


def test_a_pressure_map_is_no_scan(tmp_path: Path) -> None:
    path = tmp_path / "walk.asc"
    path.write_text("file name: x.mat\nmat type s2160_001\ntime[secs] 4 5 6\n 5.8 0 0 0\n")
    with pytest.raises(InputError, match="is a pressure map of pliance"):
        open_scan(path, Side.LEFT)


def test_sizes_that_do_not_exist_are_not_stated(left_mesh: TriangleMesh, tmp_path: Path) -> None:
    path = written("stl", scaled(left_mesh, 180.0), tmp_path / "child.stl")
    child = open_scan(path, Side.LEFT, choice=ImportChoice(unit="mm")).foot
    sizes = measure(child, find_landmarks(child))
    assert sizes["shoe_size_eu"] == pytest.approx(29.5, abs=0.5)
    assert (sizes["shoe_size_uk"], sizes["shoe_size_us"]) == (None, None)
