"""``insole-studio pressure``: a map under a foot of a case."""

from __future__ import annotations

import json
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.pressure.alignment import SolePrint
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_studio.cli.main import run


@pytest.fixture(scope="module")
def foot() -> Foot:
    shape = FootShape(side=Side.RIGHT)
    mesh = build_foot(shape, np.random.default_rng(1), cell_mm=3.0).mesh
    return place_foot(mesh, Side.RIGHT, frame="reference")


@pytest.fixture
def case(foot: Foot, tmp_path: Path) -> Path:
    path = tmp_path / "case.insole"
    source = ScanSource("mesh", "/scans/foot.ply", "0" * 64)
    write_case(CaseRecord.of_foot(FootRecord.begun(foot, source)), path)
    return path


@pytest.fixture
def plate(foot: Foot, tmp_path: Path) -> Path:
    """The heights of the sole as pressures of 6 mm cells, toes first."""
    sole = SolePrint.of(foot).heights_mm[::3, ::3]
    kpa = np.round(np.clip(7 - sole, 0, None)[::-1] * 55, 1)
    path = tmp_path / "plate.csv"
    lines = [";".join(str(value).replace(".", ",") for value in row) for row in kpa]
    path.write_text("\n".join(["unit: kPa", *lines]))
    return path


def test_the_map_is_kept_and_its_peaks_are_printed(
    case: Path, plate: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, report = tmp_path / "new.insole", tmp_path / "pressure.json"
    arguments = ["pressure", str(plate), "--case", str(case), "--side", "right", "--pitch", "6"]
    arguments += ["--seen-from", "above", "--out", str(out), "--report", str(report)]
    assert run(arguments) == 0
    printed = capsys.readouterr()
    assert "head_3" in printed.out
    assert "Warning" not in printed.err
    content = json.loads(report.read_text())
    assert content["peaks"]["heel"] > 150
    assert content["threshold"] == 200
    (kept,) = read_case(out).feet
    assert kept.plantar.pressure is not None
    with ZipFile(out) as saved:  # the name may be that of the patient
        texts = [saved.read(name) for name in saved.namelist() if name.endswith(".json")]
    assert all(b"plate.csv" not in text for text in [*texts, report.read_bytes()])
    assert abs(kept.plantar.pressure.placement.turn_deg) < 3
    assert read_case(case).feet[0].plantar.pressure is None


@pytest.mark.parametrize(
    ("missing", "reason"),
    [
        (["--seen-from", "above", "--side", "right"], "distance of the sensors"),
        (["--pitch", "6", "--seen-from", "above"], "which foot"),
        (["--pitch", "6", "--side", "right"], "above or below"),
        (["--pitch", "6", "--side", "left", "--seen-from", "above"], "no left foot"),
        (["--pitch", "6", "--insole", "2"], "holds 1 maps"),
    ],
)
def test_what_the_file_does_not_say_is_asked(
    case: Path, plate: Path, capsys: pytest.CaptureFixture[str], missing: list[str], reason: str
) -> None:
    assert run(["pressure", str(plate), "--case", str(case), *missing]) != 0
    assert reason in capsys.readouterr().err


def test_a_distance_of_sensors_that_is_none_is_explained(
    case: Path, plate: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        run(["pressure", str(plate), "--case", str(case), "--pitch", "abc"])
    assert "'abc' is no distance of sensors; give one in mm" in capsys.readouterr().err
