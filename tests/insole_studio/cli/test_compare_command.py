"""``insole-studio compare``, as another program calls it."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simulated_view import simulate_view

from insole_core.foot.foot_placement import place_foot
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.recording.session import Manifest, Session
from insole_core.recording.writer import write_session
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import FootShape, build_foot
from insole_core.simulate.scene import load_reference_system
from insole_core.solids.solid import insole_solid
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, str]:
    """An insole, and the same 1.25 mm lower."""
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh
    foot = place_foot(mesh, Side.LEFT, frame="reference")
    solid = insole_solid(build_insole(foot, InsoleDesign(Side.LEFT)))
    folder = tmp_path_factory.mktemp("pair")
    paths = folder / "a.stl", folder / "lower Fuß 足.stl"
    write_stl(solid, paths[0])
    write_stl(replace(solid, vertices=solid.vertices - np.array([0, 0, 1.25])), paths[1])
    return str(paths[0]), str(paths[1])


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


@pytest.mark.slow
def test_offset_and_every_output(pair: tuple[str, str], tmp_path: Path) -> None:
    outputs = {"report": "d.json", "picture": "d.png", "surface": "d.ply"}
    options = [word for key, name in outputs.items() for word in (f"--{key}", str(tmp_path / name))]
    assert run(["compare", *pair, *options, "--align", "none"]) == 0
    values = json.loads((tmp_path / "d.json").read_text())
    for key in ("mean_abs", "rms", "p95", "max", "signed_mean"):
        assert values[key] == pytest.approx(1.25, abs=0.01), key
    assert values["b2a"] == np.eye(4).tolist()
    assert values["compared_area_mm2"] > 10_000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["d.json", "d.ply", "d.png"]


@pytest.mark.slow
def test_best_fit_is_the_default(pair: tuple[str, str], tmp_path: Path) -> None:
    assert run(["compare", *pair, "--report", str(tmp_path / "d.json")]) == 0
    values = json.loads((tmp_path / "d.json").read_text())
    assert values["max"] < 0.05
    assert values["b2a"][2][3] == pytest.approx(1.25, abs=0.02)


def test_picked_points(pair: tuple[str, str], tmp_path: Path) -> None:
    b = [[0.0, 0, 0], [50, 0, 0], [0, 90, 0]]
    points = {"a": [[x, y, 1.25] for x, y, _ in b], "b": b}
    (tmp_path / "points.json").write_text(json.dumps(points))
    call = ["--align", str(tmp_path / "points.json"), "--report", str(tmp_path / "d.json")]
    assert run(["compare", *pair, *call]) == 0
    assert json.loads((tmp_path / "d.json").read_text())["max"] < 0.01


@pytest.mark.slow
def test_mould_in_one_view_without_a_reference_system(
    pair: tuple[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    view = simulate_view(read_mesh(Path(pair[0])).mesh, 3, frames=3)
    manifest = Manifest("2026-11-20T10:00:00Z", Side.LEFT, load_reference_system(), ("above",))
    sensor = replace(view.sensor, faces=("sole",))
    session = Session(manifest, (replace(view, sensor=sensor),), "simulated")
    write_session(session, tmp_path / "mould.zip")
    outputs = ["--report", str(tmp_path / "d.json"), "--paper", str(tmp_path / "d.pdf")]
    assert run(["compare", pair[0], str(tmp_path / "mould.zip"), *outputs]) == 0
    values = json.loads((tmp_path / "d.json").read_text())
    assert values["mean_abs"] < 0.8
    assert values["compared_area_mm2"] > 10_000
    assert "taken as a thing on a table" in capsys.readouterr().err
    assert (tmp_path / "d.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("options", "code", "sentence"),
    [
        (["--align", "worst"], 2, "write best, none, dots"),
        (["--align", "{tmp}/no.json"], 1, "cannot be read"),
        (["--align", "dots"], 1, "no colours"),
        (["--picture", "{tmp}/d.jpg"], 2, "end in .png"),
        (["--surface", "{tmp}/d.stl"], 2, "end in .ply"),
        (["--median", "0"], 2, "1 to 25"),
        (["--picture", "{tmp}/no/d.png"], 1, "its folder does not exist"),
    ],
)
def test_failures_leave_nothing_behind(
    pair: tuple[str, str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    code: int,
    sentence: str,
) -> None:
    words = [word.format(tmp=tmp_path) for word in options]
    assert run(["compare", *pair, "--report", str(tmp_path / "d.json"), *words]) == code
    assert sentence in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_foot_has_the_measures_that_measure_tells(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mesh = build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(1), cell_mm=4.0).mesh
    meshes = {"whole": mesh, "low": mesh.part(mesh.vertices[:, 2] < 35)}
    known = {}
    for name, part in meshes.items():
        write_stl(part, tmp_path / f"{name}.stl")
        call = ["measure", str(tmp_path / f"{name}.stl"), "--side", "right"]
        assert run([*call, "--report", str(tmp_path / f"{name}.json")]) == 0
        known[name] = json.loads((tmp_path / f"{name}.json").read_text())["measures"]
    left = TriangleMesh(mesh.vertices * [-1.0, 1.0, 1.0], mesh.triangles).flipped()
    write_stl(left, tmp_path / "left.stl")
    feet = [str(tmp_path / f"{name}.stl") for name in ("whole", "left")]
    assert run(["compare", *feet, "--report", str(tmp_path / "mirrored.json")]) == 0
    assert "left.stl is of the other foot, so that it is mirrored." in capsys.readouterr().err
    mirrored = json.loads((tmp_path / "mirrored.json").read_text())
    assert mirrored["b_mirrored"]
    assert mirrored["max"] < 0.01
    files = [str(tmp_path / f"{name}.stl") for name in meshes]
    assert run(["compare", *files, "--report", str(tmp_path / "difference.json")]) == 0
    found = json.loads((tmp_path / "difference.json").read_text())["measures"]
    assert not json.loads((tmp_path / "difference.json").read_text())["b_mirrored"]
    for which, name in zip("ab", meshes, strict=True):
        assert found[which].keys() == {"foot_length", "ball_width", "heel_width", "arch_height"}
        for key, value in found[which].items():
            assert value == pytest.approx(known[name][key], abs=0.001), key
