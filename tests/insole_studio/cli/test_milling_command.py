"""`insole-studio design --gcode`: a router's program beside the solid."""

from __future__ import annotations

from datetime import date
from pathlib import Path

import numpy as np
import pytest
from read_pdf import text_of_pdf

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.simulate import FootShape, build_foot
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def call(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    write_ply(build_foot(FootShape(), np.random.default_rng(1), cell_mm=4.0).mesh, path)
    return ["design", str(path), "--side", str(Side.LEFT)]


@pytest.mark.slow
def test_the_program_lies_beside_the_solid(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    solid, program = tmp_path / "left.stl", tmp_path / "left.nc"
    options = ["--out", str(solid), "--gcode", str(program), "--block", "EVA single"]
    options += ["--setup-sheet", str(tmp_path / "setup.pdf")]
    assert run([*call, *options, "--machine", "grbl", "--pseudonym", "P-7"]) == 0
    told = capsys.readouterr().err
    assert "foot side, finishing, 6 mm ball nose:" in told
    assert "min without changes of cutters" in told
    written = sorted(tmp_path.glob("left*.nc"))
    assert [path.name for path in written] == ["left-1.nc", "left-2.nc", "left-3.nc"]
    for path in written:
        lines = path.read_text(encoding="ascii").splitlines()
        assert lines[0] == "(P-7)"
        assert lines[-1] == "M2"
    assert solid.stat().st_size > 1000
    sheet = text_of_pdf(tmp_path / "setup.pdf")
    assert "P-7" in sheet
    assert date.today().isoformat() in sheet


@pytest.mark.slow
def test_a_block_too_low_leaves_neither_program_nor_solid(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rules = tmp_path / "shop.json"
    shop = Path(__file__).parents[3] / "resources" / "rules" / "shop.json"
    rules.write_text(shop.read_text().replace("[300.0, 110.0, 30.0]", "[300.0, 110.0, 9.0]"))
    out = tmp_path / "out"
    out.mkdir()
    options = ["--out", str(out / "left.stl"), "--gcode", str(out / "left.nc")]
    options += ["--block", "EVA single, low", "--shop", str(rules)]
    assert run([*call, *options]) == 1
    assert "The block is 9 mm high" in capsys.readouterr().err.splitlines()[-1]
    assert list(out.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--gcode", "left.nc"], "name it with --block"),
        (["--setup-sheet", "setup.pdf", "--block", "EVA single"], "name it with --gcode"),
        (
            ["--gcode", "left.nc", "--block", "EVA single", "--pin-holes", "pins.nc"],
            "add --both-sides",
        ),
        (["--gcode", "left.pdf", "--block", "EVA single"], "is no name of a program"),
        (
            ["--gcode", "left.nc", "--block", "EVA single", "--machine", "Okuma"],
            "There is no machine Okuma; there are GRBL, LinuxCNC, Mach3.",
        ),
        (
            ["--gcode", "left.nc", "--block", "EVA single", "--machine", "none.json"],
            "none.json",
        ),
    ],
)
def test_a_wrong_call_says_so_before_the_foot_is_read(
    options: list[str],
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["design", "nothing.ply", "--out", "left.stl", *options]) != 0
    assert sentence in capsys.readouterr().err.splitlines()[-1]
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_no_machine_file_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "t.csv"
    table.write_text("a;b\n")
    nest = ["order", "nest", "o.zip", "--out", str(tmp_path / "n.3mf"), "--size", "400x300x60"]
    assert run([*nest, "--machine", str(table)]) != 0
    told = capsys.readouterr().err.splitlines()[-1]
    assert "t.csv is no machine file: these end in .json. Name one, or a machine: GRBL" in told


def test_an_earlier_program_is_told_before_the_foot_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("left-5.nc").write_text("(P-7)\n")
    options = ["--gcode", "left.nc", "--block", "EVA single", "--pseudonym", "P-7"]
    options += ["--machine", "grbl"]
    assert run(["design", "nothing.ply", "--out", "left.stl", *options]) != 0
    told = capsys.readouterr().err.splitlines()[-1]
    assert "earlier program (left-5.nc) would lie beside left-1.nc" in told
    assert list(tmp_path.iterdir()) == [tmp_path / "left-5.nc"]
