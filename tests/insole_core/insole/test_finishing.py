"""Finished insoles: supporting zone, rim, toe zone, and what joins them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from benchmarks._insole_form import ASKED, measured_form, missed
from benchmarks._random_designs import random_design, random_finish, random_foot
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import HeelCup, Pelott, Posting
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.finishing.thin_plate import Plate
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.template import mirrored
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.insole.surface.contact import contact_base
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.resources import resource_path

BORDERS = ("medial", "lateral")
DEVICES = resource_path("devices")


def rim(cup: float = 12.0, arch: float = 16.0, head: float = 3.0) -> tuple[RimStation, ...]:
    toes = [RimStation(border="medial", along=1.0, height_mm=1.0, over="toes")]
    behind = [RimStation(border="medial", along=0.0, height_mm=cup)]
    sides = [
        RimStation(border=border, along=along, height_mm=height, over=over)
        for border in ("medial", "lateral")
        for along, height, over in ((0.2, cup, "heel"), (0.45, arch, "heel"), (0.7, head, "toes"))
    ]
    return (*behind, *sides, *toes)


def finished(foot: Foot, *corrections, grid_mm: float = 1.0, **keys) -> FinishedSurface:
    finish = Finish(**{"rim": rim(), **keys})
    base = contact_base(foot, InsoleDesign(foot.side, corrections, grid_mm=grid_mm, finish=finish))
    assert base.finished is not None
    return base.finished


def warnings(foot: Foot, *corrections, outline: Outline | None = None, **keys) -> str:
    design = InsoleDesign(
        foot.side,
        corrections,
        finish=Finish(**{"rim": rim(), **keys}),
        outline=outline or Outline(),
    )
    insole = build_insole(foot, design)
    found = design_warnings(insole, find_landmarks(foot), load_rules())
    return "\n".join(str(w.sentence) for w in found)


def test_a_short_insole_is_as_thin_as_asked_whatever_its_toes_would_need(left_foot: Foot):
    low_toes = Posting(forefoot_deg=10.0, blend_start=0.7, blend_end=0.85)
    design = InsoleDesign(
        left_foot.side,
        (low_toes,),
        finish=Finish(rim=rim(), toe_zone="as_scanned"),
        outline=Outline(extent="three_quarter"),
    )
    contact = build_insole(left_foot, design).contact
    curve = insole_outline(left_foot, design, find_landmarks(left_foot))
    inside = inside_curve(curve, contact.nodes[:, :2])
    assert contact.nodes[inside, 2].min() == pytest.approx(design.thickness_mm, abs=1.0)
    assert contact.heights_mm.min() >= design.thickness_mm


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))  # benchmarks/insole_form.py builds far more
def test_random_insoles_have_the_form_that_is_asked(seed: int):
    foot = random_foot(seed)
    rng = np.random.default_rng(seed)
    design = replace(random_design(foot, rng), finish=random_finish(rng), grid_mm=1.0)
    form = measured_form(foot, design)
    assert missed(form) == [], form


@pytest.mark.shared
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "side", "cup"),
    [
        ("dupontgu/left_foot.stl", Side.LEFT, 22.0),
        ("dupontgu/right_foot.stl", Side.RIGHT, 14.0),
        ("plantar_scan.obj", Side.RIGHT, 8.0),
        ("plantar_scan.obj", Side.RIGHT, 22.0),
    ],
)
def test_real_feet_get_the_form_that_is_asked(real_foot, name: str, side: Side, cup: float):
    design = InsoleDesign(side, finish=Finish(rim=rim(cup, cup + 3)))
    form = measured_form(real_foot(name, side), design)
    assert missed(form) == [], form


def test_a_mirrored_foot_has_the_mirrored_insole(left_foot, right_foot):
    rng = np.random.default_rng(5)
    design = replace(random_design(left_foot, rng), finish=random_finish(rng), grid_mm=1.0)
    left = build_insole(left_foot, design).contact.heights_mm
    right = build_insole(right_foot, mirrored(design)).contact.heights_mm
    assert np.abs(left - right[:, ::-1]).max() < 1e-6


@pytest.mark.parametrize("grid_mm", [0.5, 2.0])
def test_the_form_does_not_depend_on_the_grid(left_foot, grid_mm: float):
    usual, other = finished(left_foot), finished(left_foot, grid_mm=grid_mm)
    edge = usual.rim.edge.points_mm
    assert np.allclose(
        other.surface.height_at(edge) - other.heel_mm, other.curve.height_mm, atol=0.1
    )
    inside = usual.place.inside_mm > 2.0
    places = np.column_stack([usual.place.x_mm[inside], usual.place.y_mm[inside]])
    apart = other.surface.height_at(places) - usual.surface.heights_mm[inside]
    assert np.sqrt((apart**2).mean()) < 0.15


def test_pads_lie_on_the_finished_surface_as_high_as_prescribed(left_foot):
    pad = Pelott(centre_mm=(0.0, 140.0), height_mm=5.0)
    design = InsoleDesign(Side.LEFT, (pad,), finish=Finish(rim=rim()))
    bare = contact_base(left_foot, design).surface
    added = build_insole(left_foot, design).contact.heights_mm - bare.heights_mm
    row = round((140.0 - bare.y0_mm) / bare.step_mm)
    column = round(-bare.x0_mm / bare.step_mm)
    assert added[row, column] == pytest.approx(5.0, abs=1e-9)


@pytest.mark.parametrize(("zone", "lower_mm"), [("flat", 0.0), ("sulcus", 4.0)])
def test_the_floor_of_the_toes_is_level(left_foot, zone: str, lower_mm: float):
    surface = finished(left_foot, toe_zone=zone)
    far_ahead = surface.zones.floor & (surface.toes.ahead_mm > 25)
    floor = surface.surface.heights_mm[far_ahead]
    flat_mm = finished(left_foot).toes.level_mm
    assert np.ptp(floor) < 1e-9
    assert floor[0] == pytest.approx(flat_mm - lower_mm)


@pytest.mark.parametrize("seed", [5, 10])
def test_the_border_runs_out_where_the_toe_line_ends(seed: int):
    foot = random_foot(seed)
    high = (RimStation(border=b, along=0.7, height_mm=6.0, over="toes") for b in BORDERS)
    low = (RimStation(border=b, along=0.85, height_mm=2.0, over="toes") for b in BORDERS)
    others = (s for s in rim() if s.along != 0.7)
    form = measured_form(foot, InsoleDesign(foot.side, finish=Finish(rim=(*others, *high, *low))))
    assert form.toe_bump_mm < 0.6  # with sharp corners of the toe zone about 0.7
    assert form.toe_range_mm < ASKED["toe_range_mm"]


@pytest.mark.shared
@pytest.mark.parametrize("device", ["eva-full-length", "sport-full-length"])
def test_a_foot_with_high_flanks_has_no_knob_beside_its_toes(real_foot, device: str):
    foot = real_foot("plantar_scan.obj", Side.RIGHT)
    design = apply_device(read_device(DEVICES / f"{device}.json"), InsoleDesign(Side.RIGHT))
    assert measured_form(foot, design).toe_bump_mm < ASKED["toe_bump_mm"]


def test_a_toe_crest_lies_under_the_lesser_toes_only(left_foot):
    flat, crest = (finished(left_foot, toe_zone=zone).surface for zone in ("flat", "crest"))
    raised = crest.heights_mm - flat.heights_mm
    tips = {n: find_landmarks(left_foot)[f"toe_tip_{n}"].point for n in (1, 3)}
    heads = {n: find_landmarks(left_foot)[f"metatarsal_head_{n}"].point for n in (1, 3)}
    way = np.linspace(0.2, 0.8, 30)[:, None]
    under = {
        n: HeightField(flat.x0_mm, flat.y0_mm, flat.step_mm, raised)
        .height_at(heads[n][:2] + way * (tips[n] - heads[n])[:2])
        .max()
        for n in (1, 3)
    }
    assert under[3] == pytest.approx(4.0, abs=0.3)
    assert under[1] < 0.5


def test_toes_as_scanned_stay_as_the_finish_without_a_toe_zone_leaves_them(left_foot):
    surface = finished(left_foot, toe_zone="as_scanned", skin_smoothing_mm=0.0)
    plain = contact_base(left_foot, InsoleDesign(Side.LEFT)).surface.heights_mm
    toes = surface.zones.support & (surface.toes.ahead_mm > 20)
    assert toes.sum() > 500
    assert np.ptp((surface.surface.heights_mm - plain)[toes]) < 1e-9


def test_a_fill_lowers_the_arch_at_its_apex_and_nothing_at_its_ends(left_foot):
    base = contact_base(left_foot, InsoleDesign(Side.LEFT, finish=Finish(rim=rim())))
    full, filled = (finished(left_foot, skin_smoothing_mm=0.0, arch_fill_mm=f) for f in (0.0, 3.2))
    lower = replace(full.goal, heights_mm=full.goal.heights_mm - filled.goal.heights_mm)
    assert lower.height_at(np.array(base.arch_apex_mm)) == pytest.approx(3.2, abs=0.05)
    assert lower.heights_mm.max() < 3.2 + 1e-9
    marks = find_landmarks(left_foot)
    ends = np.array([marks[k].point[:2] for k in ("heel_centre", "metatarsal_head_1")])
    assert np.abs(lower.height_at(ends)).max() < 0.01
    lateral = lower.heights_mm[:, lower.x_mm < -20]
    assert np.abs(lateral).max() < 1e-9


def test_a_fill_is_not_deeper_than_the_arch_and_says_so():
    foot = random_foot(3)
    surface, full = (finished(foot, arch_fill_mm=f, skin_smoothing_mm=0.0) for f in (15.0, 0.0))
    lowered = (full.goal.heights_mm - surface.goal.heights_mm).max()
    assert full.arch.height_mm < 14.0
    assert lowered == pytest.approx(full.arch.height_mm, abs=0.05)
    assert "it is filled by" in warnings(foot, arch_fill_mm=15.0)


def test_an_expansion_widens_heel_and_lateral_border_only(left_foot):
    def borders(surface: FinishedSurface, y_mm: float) -> tuple[float, float]:
        """Return where the contact surface reaches 3 mm over its lowest place, -x and +x."""
        field = surface.goal
        row = field.heights_mm[round((y_mm - field.y0_mm) / field.step_mm)]
        low = int(row.argmin())
        level = row[low] + 3.0
        left = np.interp(level, row[: low + 1][::-1], field.x_mm[: low + 1][::-1])
        return float(left), float(np.interp(level, row[low:], field.x_mm[low:]))

    keys = {"skin_smoothing_mm": 0.0, "toe_zone": "as_scanned"}
    plain, wide = (finished(left_foot, expansion_mm=e, **keys) for e in (0.0, 3.0))
    length = left_foot.length_mm
    for share, lateral_mm, medial_mm in ((0.12, 1.2, 1.2), (0.45, 1.0, 0.0), (0.85, 0.0, 0.0)):
        before, after = (borders(surface, share * length) for surface in (plain, wide))
        lateral, medial = before[0] - after[0], after[1] - before[1]
        assert lateral_mm - 0.1 <= lateral <= (3.0 if lateral_mm else 0.1)
        assert medial_mm - 0.1 <= medial <= (3.0 if medial_mm else 0.1)


def test_smoothing_of_the_skin_takes_folds_away_and_keeps_the_level(left_foot):
    rough, even = (finished(left_foot, skin_smoothing_mm=s) for s in (0.0, 2.5))
    inside = rough.zones.support & even.zones.support
    change = (even.goal.heights_mm - rough.goal.heights_mm)[inside]
    assert abs(change.mean()) < 0.3
    bends = [np.abs(s.goal.laplacian()[inside]).mean() for s in (rough, even)]
    assert bends[1] < bends[0]


def test_a_heel_cup_sets_the_cup_of_the_rim(left_foot):
    with_cup = finished(left_foot, HeelCup(depth_mm=18.0))
    heel_mm = with_cup.rim.edge.heel_mm
    assert with_cup.curve.height_at(heel_mm) == pytest.approx(18.0, abs=0.5)
    behind = np.array(with_cup.rim.edge.point_at(heel_mm))
    height = with_cup.surface.height_at(behind) - with_cup.heel_mm
    assert height == pytest.approx(18.0, abs=0.5)


def test_a_switched_off_heel_cup_changes_nothing(left_foot):
    off = finished(left_foot, HeelCup(depth_mm=18.0, enabled=False))
    assert np.array_equal(off.surface.heights_mm, finished(left_foot).surface.heights_mm)


@pytest.mark.parametrize(
    ("corrections", "keys", "text"),
    [
        ((), {"heel_blend_mm": 25, "arch_blend_mm": 25, "forefoot_blend_mm": 25}, "has no room"),
        ((), {"rim": rim(22, 22)}, "too steep or bent too sharply"),
        ((), {"rim": rim(45, 45)}, "no foot carries"),
        ((), {"rim": rim(45, 45)}, "steep, and there is no room"),
        ((), {"rim": rim(-5, -5)}, "below the sole"),
        ((), {"expansion_mm": 4}, "widen the outline"),
        ((Pelott(centre_mm=(30.0, 150.0)),), {}, "on the transition to the rim"),
    ],
)
def test_what_is_not_done_as_asked_is_told(left_foot, corrections, keys, text):
    assert text in warnings(left_foot, *corrections, **keys)


def test_a_usual_finish_has_no_warning(left_foot):
    assert warnings(left_foot, Posting(rearfoot_deg=3)) == ""


def test_least_thickness_is_kept_by_raising(left_foot):
    low = InsoleDesign(Side.LEFT, (Posting(rearfoot_deg=-12),), finish=Finish(rim=rim(-5, -5)))
    insole = build_insole(left_foot, low)
    assert insole.contact.heights_mm.min() == pytest.approx(low.least_thickness_mm)
    support = insole.finished.zones.support
    assert insole.contact.heights_mm[support].min() > low.least_thickness_mm + 1.0


def test_the_plate_has_the_least_energy_of_all():
    rng = np.random.default_rng(1)
    field = HeightField(0.0, 0.0, 1.0, rng.uniform(0, 5, (24, 20)))
    nodes = np.ones((24, 20), bool)
    nodes[:3, :4] = False
    points = np.column_stack([np.linspace(5.2, 17.7, 13), np.full(13, 2.4)])
    plate = Plate.over(field, nodes, points)
    stiffness = np.zeros((24, 20))
    stiffness[15:] = np.inf
    stiffness[13:15] = 0.4
    edge_mm = rng.uniform(8, 9, 13)
    heights = plate.on_springs(stiffness).solve(field.heights_mm, edge_mm)
    goal, springs = field.heights_mm[nodes], stiffness[nodes]
    held = np.isinf(springs)
    assert np.array_equal(heights[held], goal[held])
    pull = plate.energy @ heights - plate.from_edge @ edge_mm
    pull += np.where(held, 0.0, springs) * (heights - goal)
    assert np.abs(pull[~held]).max() < 1e-8


def test_a_level_plate_stays_level():
    field = HeightField(0.0, 0.0, 0.5, np.full((30, 30), 4.0))
    points = np.column_stack([np.linspace(2, 12, 20), np.full(20, 1.1)])
    stiffness = np.where(np.arange(30)[:, None] > 20, np.inf, np.zeros((30, 30)))
    plate = Plate.over(field, np.ones((30, 30), bool), points).on_springs(stiffness)
    assert np.abs(plate.solve(field.heights_mm, np.full(20, 4.0)) - 4.0).max() < 1e-7
