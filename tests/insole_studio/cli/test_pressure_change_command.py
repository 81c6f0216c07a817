"""``insole-studio pressure-change``: how load moves, and what it refuses."""

from __future__ import annotations

import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.contact.change import SENTENCE
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.pressure.alignment import SolePrint
from insole_core.pressure.laid_map import Placement, PressureMap
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.plantar_pressure import with_pressure
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def foot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=3.0).mesh
    path = tmp_path_factory.mktemp("foot") / "foot.ply"
    write_ply(mesh, path)
    return path


def design(folder: Path, name: str, **more: Any) -> Path:
    content = {"format": "insole-design", "version": 1, "side": "left", "grid_mm": 2.0,
               "corrections": [], **more}  # fmt: skip
    path = folder / name
    path.write_text(json.dumps(content))
    return path


PAD = {"type": "pelott", "shape": "egg", "centre_mm": [2.0, 150.0], "length_mm": 60,
       "width_mm": 40, "height_mm": 5, "turn_deg": 0}  # fmt: skip


def call(foot: Path, new: Path, report: Path, *more: str, weight: str = "75") -> list[str]:
    arguments = ["pressure-change", str(foot), "--side", "left", "--prescription", str(new)]
    return [*arguments, "--weight-kg", weight, "--report", str(report), *more]


def test_the_report_tells_regions_points_and_areas_with_their_limits(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, new = tmp_path / "change.json", design(tmp_path, "new.json", corrections=[PAD])
    assert run(call(foot, new, report, "--at", "-12,40", "0,30", "90,30", "--shore-a", "35")) == 0
    told = json.loads(report.read_text())
    assert told["total_load_N"] == pytest.approx(75 * 9.80665 / 2, abs=0.001)
    assert set(told["regions"]) == {
        "heel", "midfoot", "metatarsal_heads", "toes", "head_1", "head_2", "head_3", "head_4",
        "head_5",
    }  # fmt: skip
    heel = told["regions"]["heel"]
    assert heel["limits_95"][0] < heel["change_percent"] < heel["limits_95"][1] < 0
    assert [(p["x_mm"], p["y_mm"]) for p in told["points"]] == [(-12, 40), (0, 30), (90, 30)]
    assert told["points"][1]["change_percent"] < 0
    assert told["points"][1]["reason"] == told["reasons"].get("heel", "")
    assert told["points"][2]["change_percent"] is None
    assert "beside the sole" in told["points"][2]["reason"]
    assert told["contact_area_mm2"]["new"] > told["contact_area_mm2"]["old"]
    assert set(told["cannot_tell"]) == set(told["reasons"])
    printed = capsys.readouterr()
    assert str(SENTENCE) in printed.out
    assert re.search(r"^heel +−\d+ % \(−\d+ to −\d+\)$", printed.out, re.MULTILINE)
    assert str(SENTENCE) in told["notes"]
    assert "Warning: A design names no material" not in printed.err


def test_a_stream_without_a_minus_sign_gets_a_hyphen(
    foot: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding="cp1252"))
    new = design(tmp_path, "new.json", corrections=[PAD])
    assert run(call(foot, new, tmp_path / "change.json")) == 0
    sys.stdout.flush()
    assert re.search(rb"^heel +-\d+ % \(-\d+ to -\d+\)\r?$", written.getvalue(), re.MULTILINE)


def test_against_itself_nothing_changes_and_the_material_that_is_assumed_is_told(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, new = tmp_path / "change.json", design(tmp_path, "new.json", corrections=[PAD])
    assert run(call(foot, new, report, "--against", str(new))) == 0
    told = json.loads(report.read_text())
    assert told["regions"]["heel"] == {
        "change_percent": 0.0, "limits_95": [0.0, 0.0], "load_change_percent": 0.0
    }  # fmt: skip
    assert "Shore A 35 is assumed" in capsys.readouterr().err


def test_what_is_not_known_of_the_old_insole_widens_the_limits(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named: dict[str, Any] = {"shell": {"material": "EVA, Shore A 35"}, "thickness_mm": 6}
    new = design(tmp_path, "new.json", **named)
    widths: list[float] = []
    for number, more in enumerate(({}, {"shell": None}, {"layers": {"cover_mm": 3}})):
        content = {**named, **more, "thickness_mm": 8}
        given = {key: value for key, value in content.items() if value is not None}
        old = design(tmp_path, "old.json", **given)
        report = tmp_path / f"change_{number}.json"
        assert run(call(foot, new, report, "--against", str(old))) == 0
        assert ("A design " in capsys.readouterr().err) is bool(more)
        low, high = json.loads(report.read_text())["regions"]["heel"]["limits_95"]
        widths.append(high - low)
    assert min(widths[1:]) > widths[0] + 0.01


@pytest.mark.parametrize(
    ("more", "weight", "code", "reason"),
    [
        (("--side", "right"), "75", 2, "different feet"),
        ((), "0.7", 2, "a person weighs"),
        (("--at", "12;40"), "75", 2, "no place"),
        (("--shore-a", "300"), "75", 2, "--shore-a"),
    ],
)
def test_a_wrong_call_is_told(
    foot: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    more: tuple[str, ...],
    weight: str,
    code: int,
    reason: str,
) -> None:
    report = tmp_path / "change.json"
    arguments = call(foot, design(tmp_path, "new.json"), report, *more, weight=weight)
    assert exit_code(arguments) == code
    assert reason in capsys.readouterr().err
    assert not report.exists()


def exit_code(arguments: list[str]) -> int:
    try:
        return run(arguments)
    except SystemExit as ended:
        return int(str(ended.code))


def test_without_a_weight_it_is_asked_for(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = call(foot, design(tmp_path, "new.json"), tmp_path / "change.json")
    at = arguments.index("--weight-kg")
    del arguments[at : at + 2]
    assert exit_code(arguments) == 2
    assert "--weight-kg" in capsys.readouterr().err


def test_a_material_of_unknown_stiffness_is_refused(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "change.json"
    new = design(tmp_path, "new.json", shell={"material": "TPU, printed"})
    assert run(call(foot, new, report)) == 1
    assert "TPU, printed" in capsys.readouterr().err.splitlines()[-1]
    assert not report.exists()
    assert run(call(foot, new, report, "--shore-a", "60")) == 0


@pytest.mark.parametrize(("kpa_per_mm", "code"), [(18.0, 0), (70.0, 1)])
def test_the_tissue_is_fitted_to_a_standing_map_of_a_case_and_not_to_one_of_walking(
    foot: Path, tmp_path: Path, kpa_per_mm: float, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    placed = place_foot(read_mesh(foot).mesh, Side.LEFT, frame="reference")
    heights = SolePrint.of(placed).heights_mm[::3, ::3]
    kpa = np.clip(6 - heights, 0, None)[::-1] * kpa_per_mm
    first = SolePrint.of(placed).first_mm
    middle = [start + 6.0 * (n - 1) / 2 for start, n in zip(first, kpa.shape[::-1], strict=True)]
    laid = PressureMap(kpa, (6.0, 6.0), Placement(*middle))
    record = FootRecord.begun(placed, ScanSource("mesh", "/scans/foot.ply", "0" * 64))
    case, report = tmp_path / "case.insole", tmp_path / "change.json"
    write_case(CaseRecord.of_foot(with_pressure(record, laid)), case)
    new = design(tmp_path, "new.json")
    assert run(call(foot, new, report, "--measured", str(case))) == code
    if code:
        assert "walking" in capsys.readouterr().err.splitlines()[-1]
        assert not report.exists()
    else:
        told = json.loads(report.read_text())
        assert told["total_load_N"] == pytest.approx(kpa.sum() * 0.036, rel=1e-3)
        fit = told["fit"]
        assert fit["heel_mpa"] > 0
        assert fit["held_out_error_percent"] > 0
        assert "held out" in capsys.readouterr().out


def test_a_scan_that_stood_is_refused(
    foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    placed: Foot = place_foot(read_mesh(foot).mesh, Side.LEFT, frame="reference")
    stood = np.maximum(placed.mesh.vertices, [-np.inf, -np.inf, 7.0])
    path = tmp_path / "stood.ply"
    write_ply(placed.mesh.moved(stood), path)
    report = tmp_path / "change.json"
    assert run(call(path, design(tmp_path, "new.json"), report, "--force")) == 1
    assert "weight" in capsys.readouterr().err.splitlines()[-1]
    assert not report.exists()
