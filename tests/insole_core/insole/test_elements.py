"""Elements of the library by landmarks with known places: where each lies, and what it leaves free.

The landmarks are those of an asymmetric foot in whole millimetres, so that places are exact.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.landmarks import HEADS, TOE_TIPS, Landmark
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.pads.pad_heights import pad_heights, pad_outline
from insole_core.insole.pads.pad_shapes import pad_size, resized
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.workflows.pad_library import LibraryPad, load_pads

LEFT_MM = {
    "pternion": (0, 0), "heel_centre": (1, 40), "heel_medial": (32, 40), "heel_lateral": (-28, 40),
    "metatarsale_tibiale": (42, 186), "metatarsale_fibulare": (-52, 160), "arch_apex": (16, 120),
    "metatarsal_head_1": (26, 190), "metatarsal_head_2": (6, 194), "metatarsal_head_3": (-9, 186),
    "metatarsal_head_4": (-23, 176), "metatarsal_head_5": (-37, 164),
    "toe_tip_1": (26, 255), "toe_tip_2": (2, 250), "toe_tip_3": (-15, 240),
    "toe_tip_4": (-31, 227), "toe_tip_5": (-46, 212),
}  # fmt: skip
PADS = {pad.kind: pad for pad in load_pads()}


def landmarks_of(side: Side) -> dict[str, Landmark]:
    return {
        name: Landmark(np.array([side.medial_sign * x, y, 0.0]), 1.0)
        for name, (x, y) in LEFT_MM.items()
    }


def at(name: str) -> FloatArray:
    return np.array(LEFT_MM[name], dtype=float)


def laid(kind: str, side: Side = Side.LEFT) -> Pelott:
    pad = PADS[kind]
    return placed_pad(pad.template, pad.place, side, landmarks_of(side), 8.0)


def height_at(pad: Pelott, *place: float) -> float:
    return float(pad_heights(pad, np.array(place)))


@pytest.mark.parametrize("pad", load_pads(), ids=lambda pad: pad.kind + pad.size)
def test_every_element_can_be_prescribed_on_either_foot(pad: LibraryPad) -> None:
    here, there = (
        placed_pad(pad.template, pad.place, side, landmarks_of(side), 8.0) for side in Side
    )
    for side, put in zip(Side, (here, there), strict=True):
        check_design(InsoleDesign(side, (put,)))
        assert height_at(put, *put.centre_mm) == pytest.approx(
            0.0 if pad.kind == "horseshoe" else pad.template.height_mm, abs=1e-9
        )
    mirrored = replace(here, id=there.id).mirrored()
    assert isinstance(mirrored, Pelott)
    places = np.stack(np.meshgrid(np.arange(-60, 60, 2.0), np.arange(0, 320, 2.0)), axis=-1)
    difference = pad_heights(mirrored, places) - pad_heights(there, places)
    assert np.abs(difference).max() < 1e-9


def test_a_reverse_mortons_extension_lies_under_heads_2_to_5_and_not_under_the_1st() -> None:
    pad = laid("reverse_mortons_extension")
    for head in HEADS[1:]:
        assert height_at(pad, *at(head)) > 0.8 * 3.0
    behind, ahead = (at(HEADS[2]) + np.array([0.0, off]) for off in (-12.5, 18.5))
    assert height_at(pad, *behind) == height_at(pad, *ahead) == 0.0
    outline = pad_outline(pad)
    assert not inside_curve(outline, at(HEADS[0]))
    # It ends halfway to the 2nd head, (16, 192), but for the rounding of the corners.
    assert outline[:, 0].max() == pytest.approx(16.0, abs=1.0)
    assert np.hypot(*(outline - at(HEADS[0])).T).min() > 8.0


def test_a_dancers_pad_goes_round_the_1st_head() -> None:
    pad = laid("dancers_pad")
    for head in HEADS[1:]:
        assert height_at(pad, *at(head)) == pytest.approx(5.0, abs=0.3)
    outline = pad_outline(pad)
    assert not inside_curve(outline, at(HEADS[0]))
    assert np.hypot(*(outline - at(HEADS[0])).T).min() > 8.0
    assert height_at(pad, *(at(HEADS[0]) - [0.0, 27.0])) == pytest.approx(5.0, abs=0.3)
    assert height_at(pad, *(at(HEADS[0]) - [0.0, 13.0])) == 0.0
    reverse = PADS["reverse_mortons_extension"].template
    assert pad.height_mm > reverse.height_mm


@pytest.mark.parametrize("number", range(1, 6))
def test_a_relief_lies_under_its_head_and_beside_the_next(number: int) -> None:
    reliefs = [laid(f"relief_head_{n}") for n in range(1, 6)]
    here = at(HEADS[number - 1])
    depths = [height_at(pad, *here) for pad in reliefs]
    assert depths == [pytest.approx(-2.0 if n == number else 0.0) for n in range(1, 6)]
    # Reliefs under all heads together are nowhere deeper than one.
    places = here + np.stack(np.meshgrid(np.arange(-15, 16.0), np.arange(-15, 16.0)), axis=-1)
    assert sum(pad_heights(pad, places) for pad in reliefs).min() >= -2.0 - 1e-9


def test_a_relief_is_no_wider_than_the_space_between_the_heads() -> None:
    room = np.hypot(*(at(HEADS[2]) - at(HEADS[1])))
    assert laid("relief_head_3").width_mm == round(float(room), 1) == 17.0


@pytest.mark.parametrize("number", range(1, 6))
def test_a_relief_ends_below_the_tip_of_its_toe(number: int) -> None:
    pad = laid(f"relief_toe_{number}")
    tip, head = at(TOE_TIPS[number - 1]), at(HEADS[number - 1])
    ray = (tip - head) / np.hypot(*(tip - head))
    assert np.array(pad.centre_mm) == pytest.approx(tip - pad.length_mm / 2 * ray, abs=0.01)
    along = (pad_outline(pad) - tip) @ ray
    assert along.max() == pytest.approx(0.0, abs=0.05)


def test_the_5th_ray_is_cut_out_under_its_head_along_its_toe() -> None:
    pad = laid("fifth_ray_cut_out")
    assert pad.centre_mm == LEFT_MM["metatarsal_head_5"]
    assert pad.turn_deg == pytest.approx(np.degrees(np.arctan2(9, 48)), abs=0.05)
    assert (pad.length_mm, pad.width_mm, pad.height_mm) == (45, 25, -2)


def test_the_base_of_the_5th_is_inside_the_middle_of_the_lateral_border() -> None:
    pad = laid("relief_base_5")
    heel, head = at("heel_lateral"), at("metatarsale_fibulare")
    offset = np.array(pad.centre_mm) - (heel + head) / 2
    along = (head - heel) / np.hypot(*(head - heel))
    assert offset @ along == pytest.approx(0.0, abs=0.01)
    assert offset @ [along[1], -along[0]] == pytest.approx(8.0, abs=0.01)  # to the medial side


def test_a_cuboid_raise_lies_behind_and_medial_of_the_base_of_the_5th() -> None:
    pad, base = laid("cuboid_raise"), np.array(laid("relief_base_5").centre_mm)
    heel, head = at("heel_lateral"), at("metatarsale_fibulare")
    along = (head - heel) / np.hypot(*(head - heel))
    local = (pad_outline(pad) - base) @ np.column_stack([along, [along[1], -along[0]]])
    assert local[:, 0].max() == pytest.approx(0.0, abs=0.05)
    assert local[:, 1].min() == pytest.approx(0.0, abs=0.05)
    assert height_at(pad, *base) == 0.0


def test_a_band_is_stretched_about_its_apex() -> None:
    pad = laid("dancers_pad")
    length, width = pad_size(pad)
    assert resized(pad, length, width) == pad
    stretched = resized(pad, 1.2 * length, 0.9 * width)
    assert pad_size(stretched) == pytest.approx((1.2 * length, 0.9 * width))
    own, other = (pad_outline(p) - np.array(pad.centre_mm) for p in (pad, stretched))
    assert other == pytest.approx(own * [0.9, 1.2])


def test_a_heel_spur_recess_lies_medial_of_the_heels_centre() -> None:
    assert laid("heel_spur_recess").centre_mm == (1 + 0.15 * 60, 40)
    assert laid("heel_spur_recess", Side.RIGHT).centre_mm == (-1 - 0.15 * 60, 40)


@pytest.mark.parametrize("number", range(1, 6))
def test_a_toe_filler_reaches_from_ahead_of_the_head_to_the_tip(number: int) -> None:
    pad = laid(f"toe_filler_{number}")
    tip, head = at(TOE_TIPS[number - 1]), at(HEADS[number - 1])
    ray = (tip - head) / np.hypot(*(tip - head))
    along = (pad_outline(pad) - head) @ ray
    assert along.min() == pytest.approx(12.0, abs=0.1)
    assert along.max() == pytest.approx(np.hypot(*(tip - head)), abs=0.1)
    assert height_at(pad, *head) == 0.0


def test_a_filler_of_a_toe_that_ends_at_its_head_has_room() -> None:
    stump = landmarks_of(Side.LEFT) | {"toe_tip_2": Landmark(np.array([6.0, 197.0, 0.0]), 1.0)}
    pad = PADS["toe_filler_2"]
    put = placed_pad(pad.template, pad.place, Side.LEFT, stump, 8.0)
    assert (put.centre_mm, put.length_mm, put.turn_deg) == ((6.0, 194.0 + 12.0 + 10.0), 20.0, 0.0)


def test_fillers_of_neighbouring_toes_make_one_level() -> None:
    third, fourth = laid("toe_filler_3"), laid("toe_filler_4")
    across = np.linspace(third.centre_mm, fourth.centre_mm, 200)
    together = pad_heights(third, across) + pad_heights(fourth, across)
    assert together.min() > 0.85 * 5.0
    assert together.max() < 1.15 * 5.0


def test_a_forefoot_filler_begins_at_the_end_of_the_foot() -> None:
    pad = laid("forefoot_filler")
    assert pad_outline(pad)[:, 1].min() == pytest.approx(255.0, abs=1e-6)
    assert pad.centre_mm[0] == (26 - 37) / 2


@pytest.mark.parametrize(
    "pad",
    [pad for pad in load_pads() if pad.kind != "arch_support"],  # its flat side ends at the flank
    ids=lambda pad: pad.kind + pad.size,
)
def test_no_element_has_a_step_or_is_steeper_than_60_degrees(pad: LibraryPad) -> None:
    put = placed_pad(pad.template, pad.place, Side.LEFT, landmarks_of(Side.LEFT), 8.0)
    x, y = np.meshgrid(np.arange(-75, 75, 0.5), np.arange(-10, 325, 0.5))
    heights = pad_heights(put, np.stack([x, y], axis=-1))
    steps = (np.diff(heights, axis=0), np.diff(heights, axis=1))
    assert max(np.abs(step).max() for step in steps) < 0.5 * np.tan(np.radians(60))


def test_a_pelott_of_the_library_is_4_mm_high() -> None:
    heights = {p.template.height_mm for p in load_pads() if p.kind in ("pelott", "bar", "drop")}
    assert heights == {4.0}
