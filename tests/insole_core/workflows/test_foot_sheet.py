"""The foot sheet tells measures with their ±, and draws what the angles are."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

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
    {"rearfoot_angle_deg": SIMULATED},
)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("foot_length", "251.0 ± ? mm"),
        ("rearfoot_angle_deg", "8.7 ± 3.0° varus"),
        ("achilles_angle_deg", "4.2 ± ?° valgus"),
        ("achilles_lean_deg", "6.0 ± ?° medial"),
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


def test_a_foot_sheet_can_be_printed(tmp_path: Path) -> None:
    legless = MeasuredFoot({"foot_length": 250.0}, {})
    write_foot_sheet({Side.LEFT: FOOT, Side.RIGHT: legless}, tmp_path / "sheet.pdf")
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")
