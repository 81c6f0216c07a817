"""The foot sheet tells measures with their ±, and draws what the angles are."""

from __future__ import annotations

import io
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.export import paper
from insole_core.foot.spread import MeasuredFoot, Spread, SpreadSource
from insole_core.geometry.side import Side
from insole_core.workflows import foot_sheet
from insole_core.workflows.foot_sheet import draw_angles, value_text, write_foot_sheet

SIMULATED = Spread(3.0, SpreadSource.SIMULATED)
FOOT = MeasuredFoot(
    {
        "foot_length": 251.0,
        "ball_girth": None,
        "rearfoot_angle_deg": -8.7,
        "achilles_angle_deg": 4.2,
        "achilles_lean_deg": 6.0,
    },
    {"rearfoot_angle_deg": SIMULATED, "foot_length": Spread(1.4, SpreadSource.SIMULATED)},
    {"achilles_lean_deg": "the leg was seen in part only"},
)
SCAN = ScanSource("session", "/clinic/left", "0" * 64, "2025-03-07T10:00:00Z")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("foot_length", "251.0 ± 1.4 mm"),
        ("rearfoot_angle_deg", "8.7 ± 3.0° varus"),
        ("achilles_angle_deg", "4.2 ± ?° valgus"),
        ("achilles_lean_deg", "≈ 6.0 ± ?° medial"),
        ("ball_girth", "not scanned"),
    ],
)
def test_each_measure_is_told_with_its_limits_and_side(name: str, said: str) -> None:
    assert value_text(name, FOOT) == said


@pytest.mark.parametrize(("side", "medial"), [(Side.LEFT, 1), (Side.RIGHT, -1)])
def test_the_drawing_leans_as_the_leg_does(
    side: Side, medial: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, *_, **__: drawn.append(figure))
    draw_angles({side: FOOT}, io.BytesIO(), str)
    ((axes,),) = (figure.axes for figure in drawn)
    ways = {
        (str(line.get_color()), line.get_linestyle()): np.diff(line.get_xydata(), axis=0)[0]
        for line in axes.lines
        if len(line.get_xydata()) == 2
    }
    leg, heel = ways[foot_sheet._LEG, "-"], ways[foot_sheet._HEEL, "-"]
    assert np.degrees(np.arctan2(leg[0] * medial, leg[1])) == pytest.approx(2 * 4.2)
    # The calcaneus is 8.7° in varus of the leg: under the ankle it runs to the medial side.
    assert np.degrees(np.arctan2(heel[0] * medial, -heel[1])) == pytest.approx(2 * (8.7 - 4.2))
    upright = ways[foot_sheet._QUIET, ":"]
    assert np.degrees(np.arctan2(upright[0] * medial, upright[1])) == pytest.approx(2 * -1.8)


@pytest.mark.parametrize("angle_deg", [0.04, -0.04])
def test_an_angle_that_rounds_to_0_is_to_neither_side(angle_deg: float) -> None:
    assert value_text(
        "rearfoot_angle_deg", MeasuredFoot({"rearfoot_angle_deg": angle_deg}, {})
    ) == ("0.0 ± ?°")


@pytest.fixture
def sheet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, dict[str, str]]:
    """What a sheet of two feet, in the language of a clinic, tells: facts by title."""
    other = MeasuredFoot({"foot_length": 250.0, "ball_width": 90.0}, FOOT.spreads)
    told: list[tuple[str, dict[str, str]]] = []
    write = paper.write_report

    def note(title: str, sections: Any, picture: bytes, path: Path) -> None:
        told.extend(sections)
        write(title, sections, picture, path)

    monkeypatch.setattr(paper, "write_report", note)
    feet = {Side.LEFT: FOOT, Side.RIGHT: other}
    write_foot_sheet(
        feet,
        {Side.LEFT: replace(SCAN, weight_bearing="semi")},
        tmp_path / "sheet.pdf",
        identification="K-7",
    )
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")
    return dict(told)


def test_a_foot_sheet_tells_days_doubts_and_differences(sheet: dict[str, dict[str, str]]) -> None:
    head = sheet["What"]
    assert (head["printed"], head["pseudonym"]) == (date.today().isoformat(), "K-7")
    assert head["uncertainty"] == (
        "±: 95 % limits, by simulated captures; ± ?: not known for this value"
    )
    left, right = sheet["left foot"], sheet["right foot"]
    assert (left["captured"], right["captured"]) == ("2025-03-07", "not known")
    assert (left["weight bearing"], right["weight bearing"]) == ("semi-weight-bearing", "not known")
    assert left["foot length"] == "251.0 ± 1.4 mm"
    assert left["achilles lean"] == "≈ 6.0 ± ?° medial: the leg was seen in part only"
    assert "ball girth" not in left
    assert sheet["Left foot minus right foot"] == {"foot length": "+1.0 ± 2.0 mm: within the error"}


def test_a_foot_sheet_says_which_foot_is_a_mirror_image(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[tuple[str, dict[str, str]]] = []
    monkeypatch.setattr(paper, "write_report", lambda _, sections, *__: told.extend(sections))
    sources = {Side.LEFT: SCAN, Side.RIGHT: replace(SCAN, mirrored=True)}
    write_foot_sheet({Side.LEFT: FOOT}, sources, tmp_path / "sheet.pdf")
    assert "foot length" in dict(told)["left foot"]
    assert "mirror image" in dict(told)["right foot"]["measures"]


def test_mirror_images_alone_make_no_sheet(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="mirror image"):
        write_foot_sheet({}, {}, tmp_path / "sheet.pdf")
    assert not list(tmp_path.iterdir())
