"""Every bad input of an export ends in one sentence and leaves nothing behind."""

from __future__ import annotations

import errno
import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.formats import stl
from insole_core.formats.ply import write_ply
from insole_core.formats.solid_content import merged
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import FootShape, build_foot
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    write_ply(build_foot(FootShape(), np.random.default_rng(1), cell_mm=4.0).mesh, path)
    return path


@pytest.fixture
def call(scan: Path, tmp_path: Path) -> list[str]:
    return ["design", str(scan), "--side", str(Side.LEFT), "--out", str(tmp_path / "i.stl")]


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


def prescription(path: Path, **design: object) -> list[str]:
    values = {"format": "insole-design", "version": 1, "side": "left", "corrections": []}
    values |= {"thickness_mm": 3.0, "grid_mm": 2.0}
    path.write_text(json.dumps({**values, **design}))
    return ["--prescription", str(path)]


@pytest.mark.slow
def test_disk_that_is_full_while_exporting(
    call: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def write_half(_mesh: TriangleMesh, path: Path, _label: str) -> None:
        path.write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(stl, "write_stl", write_half)
    options = ["--job-sheet", str(tmp_path / "s.pdf"), "--checks", str(tmp_path / "c.json")]
    assert run([*call, *options]) == 1
    assert "the disk is full; free some space and try again" in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


def test_folder_of_that_name(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "i.stl").mkdir()
    assert run(call) == 1
    assert "a folder of that name is there" in last_line(capsys)


@pytest.mark.slow
def test_existing_file_is_replaced_as_a_whole(call: list[str], tmp_path: Path) -> None:
    (tmp_path / "i.stl").write_text("old")
    assert run(call) == 0
    assert (tmp_path / "i.stl").stat().st_size > 1e5


BESIDE = [[300, 0], [390, 0], [390, 90], [300, 90]]


@pytest.mark.parametrize(
    ("design", "sentence"),
    [
        ({"outline": {"source": "drawn", "points_mm": BESIDE}}, "leaves no insole"),
        (
            {"corrections": [
                {"type": "pelott", "shape": "egg", "centre_mm": [0, 150], "length_mm": 60,
                 "width_mm": 40, "height_mm": -8, "turn_deg": 0}
            ]},
            "raise the thickness or make the recess shallower",
        ),
        ({"thickness_mm": 0.1}, "thickness_mm"),
    ],
)  # fmt: skip
def test_designs_that_cannot_be_made(
    call: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    design: dict[str, object],
    sentence: str,
) -> None:
    assert run([*call, *prescription(tmp_path / "design.json", **design)]) == 1
    assert sentence in last_line(capsys)
    assert [path.name for path in tmp_path.iterdir()] == ["design.json"]


@pytest.mark.slow
def test_block_too_small_for_a_pair(
    call: list[str], scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "right.ply"
    shape = FootShape(side=Side.RIGHT)
    write_ply(build_foot(shape, np.random.default_rng(2), cell_mm=4.0).mesh, other)
    assert run([*call, "--pair", str(other), "--block", "EVA single"]) == 1
    assert "The pair needs a block of" in last_line(capsys)
    assert [path.name for path in tmp_path.iterdir()] == ["right.ply"]


@pytest.mark.slow
def test_scan_with_holes_and_several_shells(
    scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mesh = read_mesh(scan).mesh
    rng = np.random.default_rng(5)
    middle = mesh.vertices[mesh.triangles].mean(axis=1)
    holes = mesh.vertices[rng.integers(0, len(mesh.vertices), 8)]
    kept = np.linalg.norm(middle[:, None] - holes, axis=2).min(axis=1) > 6
    crumb = TriangleMesh(mesh.vertices[:3] * 0.1 + [90, 0, 0], np.array([[0, 1, 2]], np.int32))
    torn = merged([TriangleMesh(mesh.vertices, mesh.triangles[kept]), crumb])
    write_ply(torn, tmp_path / "torn.ply")
    call = ["design", str(tmp_path / "torn.ply"), "--side", "left", "--out"]
    assert run([*call, str(tmp_path / "i.stl")]) == 0
    assert trimesh.load_mesh(tmp_path / "i.stl").is_watertight
    assert "open" in capsys.readouterr().err


@pytest.mark.slow
def test_names_of_any_script(scan: Path, tmp_path: Path) -> None:
    name = "Åsa محمد 王小明 Иванов a'b c&d"
    out, sheet = tmp_path / f"{name}.3mf", tmp_path / f"{name}.pdf"
    call = ["design", str(scan), "--side", "left", "--out", str(out), "--job-sheet", str(sheet)]
    coarse = prescription(tmp_path / "design.json")
    assert run([*call, *coarse, "--pseudonym", name, "--mark", f"{name} 7"]) == 0
    assert out.stat().st_size > 1e5
    assert sheet.read_bytes().startswith(b"%PDF")


def test_name_that_cannot_be_engraved(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*call, "--mark", "王小明"]) == 1
    assert "The font has none of the letters of “王小明”" in last_line(capsys)
    assert list(tmp_path.iterdir()) == []
