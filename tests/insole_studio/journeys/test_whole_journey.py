"""The standard case from the opened scan to the file for the shop, counted action by action.

With ``INSOLE_STUDIO_MANUAL=docs/manual/images`` (and Xvfb) it also writes the pictures of the
manual.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from hands import Hands

from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.scans.mesh_file import read_mesh
from insole_core.workflows.foot_landmarks import metatarsal_line

pytestmark = pytest.mark.slow

MOST_ACTIONS, MOST_FOR_A_DEVICE = 12, 6


@pytest.mark.fine
def test_the_standard_case_takes_few_actions(
    hands: Hands, small_session: Path, tmp_path: Path
) -> None:
    hands.studio.open(small_session)
    case = hands.app.case
    assert case.side is Side.LEFT
    hands.picture("1-opened")

    hands.choose("tool_key_point")
    hands.picture("2-landmarks")
    hands.choose("confirm_landmarks")

    hands.choose("tool_pelott")
    line = metatarsal_line(case.record)
    assert line is not None
    x, y, _ = line[1]
    hands.click((x, y - 45.0))
    hands.drag((x, y - 45.0), (x, y - 42.0))
    hands.picture("3-pelott")

    hands.choose("tool_posting")
    case.select(None)
    hands.type("posting.rearfoot_deg", "4")
    hands.picture("4-posting")

    hands.type("insole.thickness_mm", "4")
    hands.choose("tool_section")
    hands.click((x, y - 42.0))
    hands.app.window.actions_by_key["map_thickness"].trigger()
    hands.picture("5-section")

    hands.export(tmp_path / "insole.stl", "6-checked")
    hands.picture("6-exported")

    design = case.record.design
    assert design is not None
    pad, posting = design.corrections
    assert isinstance(pad, Pelott)
    assert isinstance(posting, Posting)
    assert posting.rearfoot_deg == 4.0
    assert design.thickness_mm == 4.0
    assert (tmp_path / "insole-left.stl").stat().st_size > 1e6
    assert hands.actions <= MOST_ACTIONS
    print(f"{hands.actions} actions")


def test_a_finished_device_takes_six_actions(
    hands: Hands, small_session: Path, tmp_path: Path
) -> None:
    """Device chosen, pelott placed, checked, exported."""
    hands.studio.open(small_session)
    case = hands.app.case
    hands.choose("choose_device")
    hands.pick_device("sport")
    assert case.record.design is not None
    assert case.record.design.device == "Sport, full length"

    hands.choose("tool_pelott")
    line = metatarsal_line(case.record)
    assert line is not None
    x, y, _ = line[1]
    hands.click((x, y - 42.0))
    hands.export(tmp_path / "insole.stl")

    design = case.record.design
    (pad,) = design.corrections
    assert isinstance(pad, Pelott)
    assert design.finish is not None
    base = hands.app.stage.preview.base
    assert base is not None
    assert base.finished is not None, "what is exported has the designed rim"
    assert read_mesh(tmp_path / "insole-left.stl").mesh.is_closed
    assert hands.actions <= MOST_FOR_A_DEVICE
    print(f"{hands.actions} actions")
