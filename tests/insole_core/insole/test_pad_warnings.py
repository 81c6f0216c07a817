"""Pads beside the foot and pads on each other: what is warned of, with which share."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import ClinicRules, load_rules
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.warnings.design_warnings import DesignWarning, design_warnings

RULES = load_rules()
BESIDE_FOOT = "Only {share:.0%} of the {pad} lies below the foot; move it inwards."
OVERLAP = "The {pad} lies with {share:.0%} on the {other_pad}, and their heights add up."
ROUND = tuple(
    (float(20 * np.cos(a)), float(20 * np.sin(a)))
    for a in np.linspace(0, 2 * np.pi, 24, endpoint=False)
)
DISC = Pelott(id="disc", shape="outline", outline_mm=ROUND, centre_mm=(0.0, 100.0), height_mm=3)


@pytest.fixture(scope="module", params=["left_foot", "right_foot"])
def foot(request: pytest.FixtureRequest) -> Foot:
    found: Foot = request.getfixturevalue(request.param)
    return found


def warned(
    foot: Foot, template: str, *pads: Pelott, rules: ClinicRules = RULES
) -> list[DesignWarning]:
    insole = build_insole(foot, InsoleDesign(foot.side, pads, grid_mm=2.0))
    found = design_warnings(insole, find_landmarks(foot), rules)
    return [warning for warning in found if warning.sentence.template == template]


def percent(warning: DesignWarning) -> int:
    return round(100 * float(warning.sentence.values["share"]))


def beside(pad: Pelott, x_mm: float, name: str = "other") -> Pelott:
    return replace(pad, id=name, centre_mm=(x_mm, pad.centre_mm[1]))


@pytest.mark.parametrize("apart_mm", [2.0, 10.0, 20.0, 26.0])
def test_two_discs_overlap_by_the_area_of_their_lens(foot: Foot, apart_mm: float) -> None:
    half = apart_mm / 2
    lens = 2 * 20**2 * np.arccos(half / 20) - apart_mm * np.sqrt(20**2 - half**2)
    (found,) = warned(foot, OVERLAP, DISC, beside(DISC, apart_mm), rules=anything_goes(0.0))
    assert percent(found) == pytest.approx(100 * lens / (np.pi * 20**2), abs=3)


def anything_goes(share: float) -> ClinicRules:
    return replace(RULES, greatest_overlap_share=share, least_on_foot_share=1.0)


@pytest.mark.parametrize(("apart_mm", "count"), [(20.0, 1), (30.0, 0), (41.0, 0)])
def test_overlaps_over_a_quarter_are_warned_of(foot: Foot, apart_mm: float, count: int) -> None:
    assert len(warned(foot, OVERLAP, DISC, beside(DISC, apart_mm))) == count


def test_the_smaller_of_two_pads_is_named_whatever_their_order(foot: Foot) -> None:
    small = Pelott(id="small", shape="drop", centre_mm=(0.0, 100.0), length_mm=22, width_mm=18)
    for pads in ((DISC, small), (small, DISC)):
        (found,) = warned(foot, OVERLAP, *pads)
        assert (found.correction_id, found.place_mm) == ("small", (0.0, 100.0))
        assert (
            found.sentence
            == "The drop lies with 100% on the free-hand pad, and their heights add up."
        )


def test_three_pads_on_one_spot_are_three_overlaps(foot: Foot) -> None:
    pads = [beside(DISC, 0.0, name) for name in "abc"]
    assert len(warned(foot, OVERLAP, *pads)) == 3


def test_what_is_switched_off_overlaps_nothing(foot: Foot) -> None:
    assert warned(foot, OVERLAP, DISC, replace(beside(DISC, 0.0), enabled=False)) == []
    assert warned(foot, BESIDE_FOOT, replace(beside(DISC, 150.0), enabled=False)) == []


@pytest.mark.parametrize(
    ("centre_mm", "share"),
    [((200.0, 100.0), 0), ((-200.0, 100.0), 0), ((0.0, -60.0), 0), ((0.0, 400.0), 0)],
)
def test_a_pad_off_the_foot_is_warned_of(
    foot: Foot, centre_mm: tuple[float, float], share: int
) -> None:
    (found,) = warned(foot, BESIDE_FOOT, replace(DISC, centre_mm=centre_mm))
    assert percent(found) == share
    assert (found.correction_id, found.place_mm) == ("disc", centre_mm)
    assert found.sentence == "Only 0% of the free-hand pad lies below the foot; move it inwards."


def test_a_pad_on_the_border_counts_by_its_part_below_the_foot(foot: Foot) -> None:
    behind_mm = foot.length_mm * 0.5
    at = foot.mesh.vertices[np.abs(foot.mesh.vertices[:, 1] - behind_mm) < 3]
    edge_mm = float(at[at[:, 2] < 20, 0].max())
    inside, outside = (
        warned(foot, BESIDE_FOOT, replace(DISC, centre_mm=(edge_mm + off, behind_mm)))
        for off in (-12.0, 12.0)
    )
    assert inside == []
    assert 0 < percent(outside[0]) < 50
