"""Known differences are found again, wherever the second surface lies."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.compare.best_fit import find_dots, read_picked_points
from insole_core.compare.comparison import (
    MIRROR,
    ComparisonSource,
    compare_surfaces,
    surface_measures,
)
from insole_core.compare.comparison_report import colored_surface, draw_picture, report_json
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import insole_solid, positive_solid
from insole_core.workflows.compare_case import compare_sources

PAD = Pelott(centre_mm=(5.0, 150.0), height_mm=3)
NEAR = rigid(rotation_about(np.array([1, 0.3, 2.0]), 7), np.array([20.0, -30, 5]))
FAR = rigid(rotation_about(np.array([1, 2.0, 0.5]), 130), np.array([300.0, -80, 1000]))


@pytest.fixture(scope="module")
def plain(left_foot: Foot) -> TriangleMesh:
    return insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, grid_mm=2.0)))


@pytest.fixture(scope="module")
def padded(left_foot: Foot) -> TriangleMesh:
    return insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, (PAD,), grid_mm=2.0)))


def misplaced_mm(found_b2a: np.ndarray, true_b2a: np.ndarray, b: TriangleMesh) -> float:
    away = transform(found_b2a, b.vertices) - transform(true_b2a, b.vertices)
    return float(np.linalg.norm(away, axis=1).max())


@pytest.mark.slow
def test_a_surface_larger_than_any_foot_is_compared_as_no_foot(left_foot: Foot) -> None:
    large = replace(left_foot.mesh, vertices=1.8 * left_foot.mesh.vertices)
    assert surface_measures(left_foot.mesh)[0] is Side.LEFT
    assert surface_measures(large) == (None, None)


@pytest.mark.parametrize("offset_mm", [-1.7, 0.3])
def test_offset_as_they_lie(plain, offset_mm):
    higher = replace(plain, vertices=plain.vertices + np.array([0, 0, offset_mm]))
    result = compare_surfaces(higher, plain, "none").statistics
    for key, expected in {
        "signed_mean": offset_mm, "mean_abs": abs(offset_mm), "rms": abs(offset_mm),
        "p95": abs(offset_mm), "max": abs(offset_mm),
    }.items():  # fmt: skip
        assert result[key] == pytest.approx(expected, abs=0.01), key


def test_tilt_as_they_lie(plain):
    slope = 0.02
    shear = np.eye(4)
    shear[2, 0] = slope
    signed = compare_surfaces(plain.transformed(shear), plain, "none")
    x = signed.grid.places[..., 0]
    known = np.isfinite(signed.signed_mm)
    np.testing.assert_allclose(signed.signed_mm[known], slope * x[known], rtol=0, atol=0.05)


@pytest.mark.parametrize("a2b", [np.eye(4), NEAR, FAR], ids=["there", "near", "far"])
def test_bump_stays_after_the_best_fit(plain, padded, a2b):
    moved = plain.transformed(a2b)
    result = compare_surfaces(padded, moved)
    assert misplaced_mm(result.fit.b2a, inverse(a2b), moved) < 0.05
    assert result.statistics["max"] == pytest.approx(3.0, abs=0.05)
    row, column = np.unravel_index(np.nanargmax(result.signed_mm), result.signed_mm.shape)
    assert result.grid.places[row, column] == pytest.approx(PAD.centre_mm, abs=2)
    assert result.statistics["median_abs"] < 0.01


HIGHER = replace(PAD, height_mm=PAD.height_mm + 2)


@pytest.fixture(scope="module")
def higher(left_foot: Foot) -> TriangleMesh:
    return insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, (HIGHER,), grid_mm=2.0)))


@pytest.mark.parametrize("alignment", ["best", "none"])
def test_equal_surfaces_differ_by_nothing_and_two_millimetres_by_two(padded, higher, alignment):
    equal = compare_surfaces(padded, padded, alignment).statistics
    assert max(equal["max"], abs(equal["signed_mean"])) < 0.005
    signed = compare_surfaces(higher, padded, alignment).statistics
    assert signed["max"] == pytest.approx(2.0, abs=0.005)
    assert signed["signed_min"] > -0.005
    opposite = compare_surfaces(padded, higher, alignment).statistics
    assert opposite["signed_min"] == pytest.approx(-2.0, abs=0.005)
    assert opposite["signed_max"] < 0.005


@pytest.mark.parametrize("alignment", ["best", "none"])
def test_the_other_foot_is_mirrored_and_said(left_foot, alignment):
    """A made-up right foot is the mirror image of the left one."""
    vertices = left_foot.mesh.vertices * MIRROR
    other = TriangleMesh(vertices, left_foot.mesh.triangles).flipped()
    a = ComparisonSource("left foot", left_foot.mesh, side=Side.LEFT)
    b = ComparisonSource("right foot", other, side=Side.RIGHT).like(a)
    assert b.is_mirrored
    assert "right foot is of the other foot, so that it is mirrored." in b.notes
    result = compare_sources(a, b, alignment, 1).difference
    assert result.statistics["max"] < 0.005
    assert report_json(result)["b_mirrored"]
    same = ComparisonSource("left foot", left_foot.mesh, side=Side.LEFT)
    unknown = ComparisonSource("scan", other)
    assert (same.like(a), unknown.like(a)) == (same, unknown)
    picked = left_foot.mesh.vertices[[10, 500, 900]], other.vertices[[10, 500, 900]]
    by_points = compare_surfaces(a.mesh, b.mesh, b.points_like(picked))
    assert by_points.statistics["max"] < 0.005


def test_foot_against_its_own_insole(left_foot, plain):
    result = compare_surfaces(plain, left_foot.mesh.transformed(NEAR))
    assert result.statistics["median_abs"] < 0.05
    assert result.statistics["compared_area_mm2"] > 8000


def test_mould_against_insole(left_foot, padded):
    mould = positive_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, grid_mm=2.0)))
    result = compare_surfaces(padded, mould)
    assert result.statistics["max"] == pytest.approx(3.0, abs=0.05)
    assert result.statistics["median_abs"] < 0.01


@pytest.mark.slow
def test_thesis_case(left_foot):
    """N, F and O of chapter 8: O's pelott lies 5 mm further ahead, and its scan is coarse."""
    rng = np.random.default_rng(3)
    design = InsoleDesign(Side.LEFT, grid_mm=2.0)
    ahead = replace(PAD, centre_mm=(PAD.centre_mm[0], PAD.centre_mm[1] + 5))
    pads = {"N": replace(PAD, height_mm=3.4), "F": PAD, "O": ahead}
    models = {
        name: insole_solid(build_insole(left_foot, design.with_added(pad)))
        for name, pad in pads.items()
    }
    rough = models["O"].vertices + rng.normal(0, 0.8, models["O"].vertices.shape) * [0, 0, 1]
    models["O"] = replace(models["O"], vertices=rough)
    maps = {
        pair: compare_surfaces(models[pair[0]], models[pair[1]], median_pixels=6)
        for pair in ("OF", "NF", "NO")
    }
    means = {pair: result.statistics for pair, result in maps.items()}
    places = maps["NF"].grid.places
    apex = np.linalg.norm(places - np.array(PAD.centre_mm), axis=2) < 1
    assert maps["NF"].signed_mm[apex] == pytest.approx(0.4, abs=0.05)
    ahead_of_pad = np.linalg.norm(places - [5, 175], axis=2) < 2
    assert np.nanmean(maps["OF"].signed_mm[ahead_of_pad]) > 0.3
    assert means["NF"]["mean_abs"] < means["OF"]["mean_abs"]
    assert means["NF"]["mean_abs"] < means["NO"]["mean_abs"]
    unfiltered = compare_surfaces(models["O"], models["F"]).statistics
    assert means["OF"]["mean_abs"] < 0.7 * unfiltered["mean_abs"]


def test_picked_points(plain, padded, tmp_path: Path):
    on_a = plain.vertices[[10, 2000, 5000, 9000]]
    path = tmp_path / "points.json"
    path.write_text(json.dumps({"a": on_a.tolist(), "b": transform(FAR, on_a).tolist()}))
    points = read_picked_points(path)
    result = compare_surfaces(padded, plain.transformed(FAR), points)
    assert misplaced_mm(result.fit.b2a, inverse(FAR), plain.transformed(FAR)) < 1e-6
    assert result.fit.residual_mm < 1e-9


def with_dots(mesh: TriangleMesh, places: np.ndarray) -> TriangleMesh:
    away = np.linalg.norm(mesh.vertices[:, None, :2] - places, axis=2).min(axis=1)
    top = mesh.vertices[:, 2] > 0
    dark = (away < 4) & top
    colors = np.where(dark[:, None], 20, 200).repeat(3, axis=1).astype(np.uint8)
    return replace(mesh, colors=colors)


DOTS = np.array([(-20.0, 40), (18, 55), (25, 170), (-30, 150)])


def test_black_dots(plain, padded):
    a, b = with_dots(padded, DOTS), with_dots(plain, DOTS)
    found = find_dots(a, "a")
    assert np.linalg.norm(found[:, None, :2] - DOTS, axis=2).min(axis=0).max() < 0.6
    result = compare_surfaces(a, b.transformed(FAR), "dots")
    assert misplaced_mm(result.fit.b2a, inverse(FAR), b.transformed(FAR)) < 0.05


@pytest.mark.parametrize(
    ("count", "sentence"), [(3, "3 black dots were found"), (0, "0 black dots were found")]
)
def test_other_number_of_dots(plain, padded, count, sentence):
    places = DOTS[:count] if count else np.array([[900.0, 900.0]])
    with pytest.raises(InputError, match=sentence):
        compare_surfaces(with_dots(padded, places), with_dots(plain, DOTS), "dots")


def test_dots_need_colours(plain):
    with pytest.raises(InputError, match="no colours"):
        compare_surfaces(plain, plain, "dots")


def test_surfaces_apart(plain):
    beside = replace(plain, vertices=plain.vertices + np.array([500, 0, 0]))
    with pytest.raises(InputError, match="lie over each other on 0 mm²"):
        compare_surfaces(plain, beside, "none")


def test_holes_and_several_shells(plain, padded):
    rng = np.random.default_rng(0)
    holes = replace(plain, triangles=plain.triangles[rng.random(len(plain.triangles)) > 0.1])
    crumb = TriangleMesh(
        np.array([[0.0, 0, 300], [1, 0, 300], [0, 1, 300]]), np.array([[0, 1, 2]], np.int32)
    )
    shells = TriangleMesh(
        np.concatenate([holes.vertices, crumb.vertices]),
        np.concatenate([holes.triangles, crumb.triangles + np.int32(len(holes.vertices))]),
    )
    result = compare_surfaces(padded, shells, "best")
    assert result.statistics["median_abs"] < 0.02


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("{", "is not valid JSON"),
        ("[]", "must hold one JSON object"),
        ('{"a": []}', "b is missing"),
        ('{"a": [[0,0,0],[1,0,0],[0,1,0]], "b": [[0,0,0]]}', "pick each point on both"),
        ('{"a": [[0,0]], "b": [[0,0]]}', r"a\[0\] has 2 numbers, but must have 3"),
        ('{"a": "x", "b": []}', "a must be a list"),
        (
            '{"a": [[0,0,0],[1,1,NaN]], "b": [[0,0,0],[1,1,1]]}',
            r"a\[1\]\[2\] is nan, but must be a finite number",
        ),
    ],
)
def test_bad_points_files(tmp_path: Path, content, sentence):
    path = tmp_path / "points.json"
    path.write_text(content)
    with pytest.raises(InputError, match=rf"points\.json.*{sentence}"):
        read_picked_points(path)


def test_points_on_one_line(plain):
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])
    with pytest.raises(InputError, match="one line"):
        compare_surfaces(plain, plain, (line, line))


def test_names_of_files_are_no_formulas(plain, padded, tmp_path: Path):
    result = compare_surfaces(padded, plain, "none")
    draw_picture(result, tmp_path / "map.png", (r"a$\frac$.ply", "b$x_$.stl"))
    assert (tmp_path / "map.png").stat().st_size > 0


def test_report_picture_and_surface(plain, padded, tmp_path: Path):
    result = compare_surfaces(padded, plain, "none")
    values = json.loads(json.dumps(report_json(result), allow_nan=False))
    assert values["max"] == pytest.approx(3.0, abs=0.05)
    assert np.shape(values["b2a"]) == (4, 4)
    for name in ("a", "b"):
        assert values["measures"][name]["length"] == pytest.approx(250, abs=6)
    draw_picture(result, tmp_path / "map.png", ("Übung.ply", "足.stl"))
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    surface = colored_surface(result)
    top = np.linalg.norm(surface.vertices[:, :2] - PAD.centre_mm, axis=1).argmin()
    red, _, blue = surface.colors[top].astype(int)
    assert red > blue + 50


@pytest.mark.slow
def test_a_very_fine_scan(plain):
    """A scan of many triangles against an insole: the same figures as of the coarse one."""
    fine = plain
    while len(fine.triangles) < 200_000:
        vertices, triangles = trimesh.remesh.subdivide(fine.vertices, fine.triangles)
        fine = TriangleMesh(np.asarray(vertices), np.asarray(triangles, np.int32))
    result = compare_surfaces(plain, fine.transformed(NEAR))
    assert result.statistics["max"] < 0.05
