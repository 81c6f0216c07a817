from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(4), cell_mm=5.0).mesh
    path = tmp_path_factory.mktemp("scan") / "foot.stl"
    write_stl(mesh, path)
    return path


def test_a_scan_is_described_and_nothing_else_is_made(
    scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = set(scan.parent.iterdir())
    assert run(["inspect", str(scan), "--report", str(tmp_path / "scan.json")]) == 0
    assert "Foot: left" in capsys.readouterr().out
    assert set(scan.parent.iterdir()) == before
    report = json.loads((tmp_path / "scan.json").read_text())
    assert (report["unit"], report["form"]) == ("mm", "foot")
    (foot,) = report["feet"]
    assert foot["side"] == foot["candidates"][0]["side"] == "left"
    assert np.shape(foot["candidates"][0]["source2insole"]) == (4, 4)


def test_two_of_three_points_are_refused(scan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = ["--heel", "0", "0", "0", "--toe", "0", "250", "0"]
    assert run(["inspect", str(scan), *points]) == 2
    assert "all three points" in capsys.readouterr().err


def test_what_a_session_says_itself_is_refused_of_the_user(
    small_session: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    call = ["measure", str(small_session), "--report", str(tmp_path / "m.json"), "--form", "cast"]
    assert run(call) == 2
    assert "leave out form and points" in capsys.readouterr().err


def test_a_unit_and_a_length_exclude_each_other(scan: Path) -> None:
    with pytest.raises(SystemExit) as stopped:
        run(["inspect", str(scan), "--unit", "mm", "--length-mm", "250"])
    assert stopped.value.code == 2
