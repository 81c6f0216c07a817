"""Library pads lie where the field puts them, on either foot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import Landmarks, find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules, proposed_post_deg
from insole_core.insole.elements import Pelott
from insole_core.insole.elements.pad_places import PLACES, placed_pad
from insole_core.insole.pads.clearance import clearance
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.pad_library import LibraryPad, load_pads

NOWHERE = (0.0, 0.0)
PADS = {
    "metatarsal_line": Pelott(centre_mm=NOWHERE, length_mm=70, width_mm=50),
    "arch": Pelott(centre_mm=NOWHERE, shape="arch_support", length_mm=100, width_mm=55),
    "heel": Pelott(centre_mm=NOWHERE, shape="horseshoe", length_mm=60, width_mm=60),
    "first_head": Pelott(centre_mm=NOWHERE, shape="cut_out", length_mm=45, width_mm=25),
    "first_ray": Pelott(centre_mm=NOWHERE, shape="mortons_extension", length_mm=60, width_mm=30),
}


@pytest.fixture(scope="module", params=list(Side))
def foot(request: pytest.FixtureRequest) -> Foot:
    shape = FootShape(length_mm=255, ball_width_mm=96, side=request.param)
    mesh = build_foot(shape, np.random.default_rng(2), cell_mm=4.0).mesh
    return place_foot(mesh, request.param, frame="reference")


@pytest.fixture(scope="module")
def landmarks(foot: Foot) -> Landmarks:
    return find_landmarks(foot)


def laid(foot: Foot, landmarks: Landmarks, place: str) -> Pelott:
    return placed_pad(PADS[place], place, foot.side, landmarks, 8.0)


@pytest.mark.parametrize("pad", [
    PADS["metatarsal_line"],
    Pelott(centre_mm=NOWHERE, shape="bar", length_mm=60, width_mm=80, height_mm=6),
    Pelott(centre_mm=NOWHERE, shape="drop", length_mm=22, width_mm=18, height_mm=4),
])  # fmt: skip
@pytest.mark.parametrize("behind_mm", [6.0, 8.0, 11.0])
def test_front_edge_lies_behind_the_heads(
    foot: Foot, landmarks: Landmarks, pad: Pelott, behind_mm: float
) -> None:
    put = placed_pad(pad, "metatarsal_line", foot.side, landmarks, behind_mm)
    line = np.array([landmarks[f"metatarsal_head_{n}"].point[:2] for n in (2, 3, 4)])
    assert clearance(put, line).distance_mm == pytest.approx(behind_mm, abs=0.1)


@pytest.mark.parametrize(("length_mm", "width_mm"), [(50, 35), (70, 50)])
def test_a_pelott_lies_behind_the_third_head(
    foot: Foot, landmarks: Landmarks, length_mm: float, width_mm: float
) -> None:
    pad = Pelott(centre_mm=NOWHERE, length_mm=length_mm, width_mm=width_mm)
    put = placed_pad(pad, "metatarsal_line", foot.side, landmarks, 8.0)
    assert put.centre_mm[0] == pytest.approx(landmarks["metatarsal_head_3"].point[0], abs=0.01)


def test_a_bar_lies_along_the_heads(foot: Foot, landmarks: Landmarks) -> None:
    bar = Pelott(centre_mm=NOWHERE, shape="bar", length_mm=60, width_mm=80)
    put = placed_pad(bar, "metatarsal_line", foot.side, landmarks, 8.0)
    # The 5th head lies behind the 1st: the bar falls back to the lateral side.
    assert put.turn_deg * foot.side.medial_sign > 1


def test_the_arch_support_is_flat_on_the_medial_side(foot: Foot, landmarks: Landmarks) -> None:
    put = laid(foot, landmarks, "arch")
    across = (pad_outline(put)[:, 0] - put.centre_mm[0]) * foot.side.medial_sign
    assert across.max() < -across.min()  # the flat side is nearer to the apex
    assert put.centre_mm == pytest.approx(landmarks["arch_apex"].point[:2], abs=0.01)


def test_mortons_extension_reaches_from_behind_the_head_below_the_toe(
    foot: Foot, landmarks: Landmarks
) -> None:
    put = laid(foot, landmarks, "first_ray")
    y = pad_outline(put)[:, 1]
    head, toe = (landmarks[name].point for name in ("metatarsal_head_1", "toe_tip_1"))
    assert y.min() < head[1] - 8
    assert head[1] + 25 < y.max() < toe[1] + 5
    assert put.centre_mm[0] * foot.side.medial_sign > 0


def mirror(landmarks: Landmarks) -> Landmarks:
    flip = np.array([-1.0, 1.0, 1.0])
    return {name: replace(mark, point=mark.point * flip) for name, mark in landmarks.items()}


@pytest.mark.parametrize("pad", load_pads(), ids=lambda pad: pad.kind + pad.size)
def test_pads_of_a_mirrored_foot_are_mirrored(
    foot: Foot, landmarks: Landmarks, pad: LibraryPad
) -> None:
    here = placed_pad(pad.template, pad.place, foot.side, landmarks, 8.0)
    there = placed_pad(pad.template, pad.place, foot.side.other, mirror(landmarks), 8.0)
    mirrored = here.mirrored()
    assert isinstance(mirrored, Pelott)
    assert there.centre_mm == pytest.approx(mirrored.centre_mm, abs=1e-9)
    assert (there.turn_deg - mirrored.turn_deg) % 360 == pytest.approx(0, abs=1e-6)
    assert (there.length_mm, there.width_mm) == (mirrored.length_mm, mirrored.width_mm)
    assert there.outline_mm == mirrored.outline_mm


def test_every_place_is_used_by_the_library() -> None:
    assert {pad.place for pad in load_pads()} == set(PLACES)


@pytest.mark.parametrize(("eversion", "post"), [
    (-6.0, 0.0), (1.9, 0.0), (2.0, 3.0), (4.9, 3.0),
    (5.0, 5.0), (7.9, 5.0), (8.0, 7.0), (14.0, 7.0),
])  # fmt: skip
def test_the_posting_follows_the_degree_of_eversion(eversion: float, post: float) -> None:
    assert proposed_post_deg(eversion, load_rules().pronation) == post
