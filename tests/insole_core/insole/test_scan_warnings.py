"""Warnings about a foot that is not level, or was not scanned for this."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal

import pytest

from insole_core.foot.alignment import PoseAngles, pose_angles, quarter_turned, turned
from insole_core.foot.contact_tilt import contact_tilt
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import is_of_other_side, place_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.warnings.design_warnings import design_warnings


def warnings(foot: Foot) -> list[str]:
    """The sentences about the pose, as the window and the command line show them."""
    insole = build_insole(foot, InsoleDesign(foot.side, grid_mm=2.0))
    found = design_warnings(insole, find_landmarks(foot), load_rules())
    about = ("not level", "scan of the", "not scanned", "has the shape of")
    return [str(w.sentence) for w in found if any(part in w.sentence for part in about)]


def pitched(foot: Foot, by_deg: float) -> Foot:
    landmarks = find_landmarks(foot)
    return turned(foot, landmarks, PoseAngles(pose_angles(foot, landmarks).pitch_deg + by_deg))


def test_a_level_foot_is_no_reason_to_warn(left_foot: Foot, right_foot: Foot) -> None:
    assert warnings(left_foot) == warnings(right_foot) == []


def test_a_mirror_image_of_an_earlier_scan_names_the_foot_that_was_scanned(right_foot: Foot):
    reused, mirrored = warnings(replace(right_foot, mirrored=True, scanned_on="2026-05-02"))
    assert reused.startswith("The scan of the left foot is that of the visit of 2026-05-02")
    assert mirrored.startswith("The right foot was not scanned")


OTHER = "The right foot has the shape of a left one"


@pytest.mark.parametrize("frame", ["reference", "unknown"])
def test_a_foot_of_the_other_side_is_told_whoever_insisted_on_it(
    left_mesh: TriangleMesh, frame: Literal["reference", "unknown"]
) -> None:
    foot = place_foot(left_mesh, Side.RIGHT, frame=frame, force=True)
    (sentence,) = [w for w in warnings(foot) if "level" not in w]
    assert sentence.startswith(OTHER)
    assert "check which foot was scanned" in sentence
    kept = replace(foot, notes=())  # as a case keeps it, without what was said at the import
    assert [w for w in warnings(kept) if w.startswith(OTHER)]
    # The deliberate mirror image says what it is; a form of a loaded foot tells too little.
    assert not any("has the shape of" in w for w in warnings(replace(foot, mirrored=True)))
    assert not any("has the shape of" in w for w in warnings(replace(foot, form=Form.IMPRINT)))
    assert not any("has the shape of" in w for w in warnings(foot.mirror_image()))


def test_a_foot_that_was_turned_by_hand_is_not_taken_for_the_other_one(left_foot: Foot) -> None:
    turns = [(axis, quarters) for axis in range(3) for quarters in (1, 2, 3)]
    assert not any(is_of_other_side(quarter_turned(left_foot, *turn)) for turn in turns)


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize(
    ("file", "side"),
    [("dupontgu", Side.LEFT), ("focus_template", Side.LEFT), ("foot3d_0044", Side.LEFT),
     ("plantar_scan.obj", Side.RIGHT)],
)  # fmt: skip
def test_a_scan_of_a_real_foot_tells_its_side(
    scanned_mesh: Callable[[str], TriangleMesh], file: str, side: Side
) -> None:
    mesh = scanned_mesh(file)
    assert not is_of_other_side(place_foot(mesh, side, frame="unknown"))
    assert is_of_other_side(place_foot(mesh, side.other, frame="unknown", force=True))


@pytest.mark.parametrize(
    ("by_deg", "higher", "way"), [(-4.0, "heel", "toes up"), (4.0, "ball", "toes down")]
)
def test_a_tilted_foot_is_told_with_what_levels_it(
    left_foot: Foot, by_deg: float, higher: str, way: str
) -> None:
    tilted, level = pitched(left_foot, by_deg), contact_tilt(left_foot)
    tilt = contact_tilt(tilted)
    assert tilt is not None
    assert level is not None
    assert tilt.angle_deg == pytest.approx(level.angle_deg - by_deg, abs=0.6)
    (sentence,) = warnings(tilted)
    assert f"the {higher} lies {abs(tilt.heel_mm - tilt.ball_mm):.0f} mm higher" in sentence
    assert f"({round(abs(tilt.angle_deg), 1):g}°)" in sentence
    assert way in sentence
    assert warnings(pitched(tilted, tilt.angle_deg)) == []


@pytest.mark.shared
def test_a_scan_that_is_not_level_is_told(real_foot: Callable[[str, Side], Foot]) -> None:
    foot = real_foot("plantar_scan.obj", Side.RIGHT)
    (sentence,) = warnings(foot)
    assert "the heel lies 5 mm higher than the ball" in sentence
