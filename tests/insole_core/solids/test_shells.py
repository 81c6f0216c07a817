"""Shells: posts, pitch, taper, edges, walls, cover; every combination is a sound solid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, product
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial import KDTree

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import HeelCup, Pelott, Posting
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.prescription.template import mirrored
from insole_core.resources import resource_path
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, make_part
from insole_core.solids.shell_body import made_surface
from insole_core.solids.solid import SolidOptions, insole_solid, make_solid
from insole_core.solids.solid_outline import outline_of
from tests.insole_core.solids.soundness import faults

SHORT = Outline(extent="three_quarter")
CUP = HeelCup(depth_mm=12.0)
SQUARE = np.array([(-20.0, 60), (20, 60), (20, 160), (-20, 160)])


def cupped(side: Side = Side.LEFT, outline: Outline = SHORT, **shell: Any) -> InsoleDesign:
    return InsoleDesign(side, (CUP,), bottom="following", outline=outline, shell=Shell(**shell))


def faces(solid: TriangleMesh) -> tuple[FloatArray, FloatArray]:
    """Vertices of the top, and those of the bottom below them."""
    count = len(solid.vertices) // 2
    return solid.vertices[:count], solid.vertices[count:]


def rim(solid: TriangleMesh) -> FloatArray:
    """Indices of the top's vertices at which the walls begin."""
    count = len(solid.vertices) // 2
    on_top = solid.triangles < count
    used = np.unique(solid.triangles[on_top.any(axis=1) & ~on_top.all(axis=1)])
    return used[used < count]


# --- Every combination ------------------------------------------------------------------------

REAR, FORE = Post(angle_deg=4.0), Post(region="forefoot", angle_deg=-3.0, edge_radius_mm=0.0)
FACTORS: dict[str, tuple[Any, ...]] = {
    "side": (Side.LEFT, Side.RIGHT),
    "bottom": ("flat", "following"),
    "posts": ((), (REAR,), (FORE,), (REAR, FORE)),
    "taper_mm": (0.5, 1.0, 4.0),
    "taper_length_mm": (5.0, 18.0, 60.0),
    "edge_radius_mm": (0.0, 1.0, 5.0),
    "draft_deg": ((0.0, 0.0), (12.0, 3.0), (-10.0, 5.0), (30.0, -15.0)),
    "chamfer_mm": (0.0, 2.5),
    "cover_mm": (0.0, 3.0),
    "trim": ("full", "usual", "own"),
    "grid_mm": (1.0, 2.0),
    "heel_pitch_mm": (0.0, 25.0),
    "pad_mm": (0.0, 5.0, -1.5),
}


def pairwise() -> Iterator[dict[str, Any]]:
    """Combinations in which every two values of two factors meet at least once."""
    rng = np.random.default_rng(0)
    left = {
        frozenset(((a, i), (b, k)))
        for (a, x), (b, y) in combinations(FACTORS.items(), 2)
        for i, k in product(range(len(x)), range(len(y)))
    }

    def grown() -> list[tuple[str, int]]:
        """Take of each factor the value that meets most others that it has not met."""
        row: list[tuple[str, int]] = []
        for name in rng.permutation(list(FACTORS)).tolist():
            values = [(name, number) for number in rng.permutation(len(FACTORS[name])).tolist()]
            row.append(max(values, key=lambda one: sum({one, other} in left for other in row)))
        return row

    while left:
        tried = [grown() for _ in range(5)]
        row = max(tried, key=lambda row: len(left & set(map(frozenset, combinations(row, 2)))))
        left -= set(map(frozenset, combinations(row, 2)))
        yield {name: FACTORS[name][number] for name, number in row}


def design_of(row: dict[str, Any], foot: Foot) -> InsoleDesign:
    side, length = foot.side, foot.length_mm
    own = tuple(
        (side.medial_sign * x, share * length) for x, share in ((38, 0.62), (5, 0.68), (-30, 0.58))
    )
    medial, lateral = row["draft_deg"]
    pad = Pelott(centre_mm=(0.0, 0.5 * length), height_mm=row["pad_mm"])
    return InsoleDesign(
        side,
        (CUP, pad) if row["pad_mm"] else (CUP,),
        grid_mm=row["grid_mm"],
        bottom=row["bottom"],
        outline=Outline(extent="full" if row["trim"] == "full" else "three_quarter"),
        layers=Layers(cover_mm=row["cover_mm"], cover_is_taken_off=True),
        shell=Shell(
            draft_medial_deg=medial,
            draft_lateral_deg=lateral,
            trim_mm=own if row["trim"] == "own" else None,
            **{
                key: row[key]
                for key in (
                    "posts", "taper_mm", "taper_length_mm", "edge_radius_mm", "chamfer_mm",
                    "heel_pitch_mm",
                )
            },
        ),
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    "row", [*pairwise(), {**next(pairwise()), "grid_mm": 0.5}], ids=lambda _: ""
)
def test_every_combination_is_a_sound_solid(row, left_foot: Foot, right_foot: Foot):
    foot = left_foot if row["side"] is Side.LEFT else right_foot
    insole = build_insole(foot, design_of(row, foot))
    solid = insole_solid(insole)
    assert faults(solid) == []
    area = np.ptp(outline_of(insole), axis=0).prod()
    assert 0.3 * area * insole.design.made_thickness_mm < solid.volume_mm3 < 25 * area


@pytest.mark.slow
@given(row=st.fixed_dictionaries({name: st.sampled_from(v) for name, v in FACTORS.items()}))
@settings(
    max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_any_combination_is_a_sound_solid(row, left_foot: Foot, right_foot: Foot):
    foot = left_foot if row["side"] is Side.LEFT else right_foot
    assert faults(insole_solid(build_insole(foot, design_of(row, foot)))) == []


def test_a_posted_shell_is_sound_and_has_its_mirror_image(left_foot: Foot, right_foot: Foot):
    design = cupped(
        posts=(REAR, FORE), draft_medial_deg=4.0, draft_lateral_deg=-4.0, heel_pitch_mm=10.0,
        trim_mm=((38.0, 150.0), (5.0, 165.0), (-30.0, 142.0)),
    )  # fmt: skip
    design = replace(design, layers=Layers(cover_mm=2.0, cover_is_taken_off=True))
    left = insole_solid(build_insole(left_foot, design))
    right = insole_solid(build_insole(right_foot, mirrored(design)))
    assert faults(left) == []
    image = left.vertices * [-1, 1, 1]
    for a, b in ((image, right.vertices), (right.vertices, image)):
        assert KDTree(a).query(b)[0].max() < 1e-6


# --- Posts ------------------------------------------------------------------------------------


def test_a_rearfoot_post_stands_level_over_its_length(left_foot: Foot):
    plain, posted = (
        insole_solid(build_insole(left_foot, cupped(posts=posts)))
        for posts in ((), (Post(length_mm=60.0),))
    )
    on_ground = faces(posted)[1][:, 2] == 0
    stood_on = faces(posted)[1][on_ground]
    heel = posted.bounds_mm[0, 1]
    assert stood_on[:, 1].min() == pytest.approx(heel + 5, abs=4)  # rounded by 4
    assert stood_on[:, 1].max() == pytest.approx(heel + 60, abs=4)
    assert np.ptp(stood_on[:, 0]) > 35
    assert on_ground.sum() > 1500 > 15 * (faces(plain)[1][:, 2] == 0).sum()
    beyond = faces(posted)[1][:, 1] > heel + 70
    assert np.array_equal(faces(posted)[1][beyond], faces(plain)[1][beyond])
    assert posted.volume_mm3 > plain.volume_mm3 + 5000
    assert np.array_equal(faces(posted)[0], faces(plain)[0])


@pytest.mark.parametrize("device", ["ucbl-child", "functional-three-quarter"])
def test_the_front_of_a_post_runs_out_into_the_flank_of_the_shell(left_foot: Foot, device: str):
    design = apply_device(
        read_device(resource_path("devices") / f"{device}.json"), InsoleDesign(Side.LEFT)
    )
    bottom = faces(insole_solid(build_insole(left_foot, design)))[1]
    front = bottom[:, 1].min() + 0.25 * left_foot.length_mm
    near = (np.abs(bottom[:, 1] - front) < 18) & (bottom[:, :2] == np.rint(bottom[:, :2])).all(1)
    height = {(x, y): z for x, y, z in bottom[near]}
    bent = [
        abs(height[x, y + 1] - 2 * z + height[x, y - 1])
        for (x, y), z in height.items()
        if z > 3.0 and (x, y + 1) in height and (x, y - 1) in height
    ]
    assert len(bent) > 100
    assert max(bent) < 0.6  # 1/mm; a wall of 65° that meets a level shell within 1 mm has 2.1


@pytest.mark.parametrize(("region", "key"), [("rearfoot", 1), ("forefoot", -1)])
def test_a_post_turns_the_foot_as_an_extrinsic_posting(left_foot: Foot, region: str, key: int):
    posted = build_insole(left_foot, cupped(posts=(Post(region=region, angle_deg=5.0),)))
    turned = Posting(**{f"{region}_deg": 5.0})
    asked = build_insole(left_foot, cupped().with_added(turned))
    assert np.array_equal(posted.contact.heights_mm, asked.contact.heights_mm)
    level = build_insole(left_foot, cupped())
    row = round((0.1 if key == 1 else 0.68) * left_foot.length_mm) - round(level.contact.y0_mm)
    tilt = (posted.contact.heights_mm - level.contact.heights_mm)[row]
    middle = np.abs(level.contact.x_mm) < 10
    slope = np.polyfit(level.contact.x_mm[middle], tilt[middle], 1)[0]
    assert slope * Side.LEFT.medial_sign == pytest.approx(np.tan(np.radians(5)), rel=0.25)


def test_a_forefoot_post_ends_at_the_trim_line(left_foot: Foot):
    posts = (Post(region="forefoot", angle_deg=6.0, length_mm=30.0, edge_radius_mm=2.0),)
    insole = build_insole(left_foot, cupped(posts=posts))
    bottom = faces(insole_solid(insole))[1]
    medial = bottom[(bottom[:, 2] == 0) & (np.abs(bottom[:, 0] - 15) < 3) & (bottom[:, 1] > 90)]
    outline = outline_of(insole)
    front = outline[np.abs(outline[:, 0] - 15) < 3, 1].max()
    assert medial[:, 1].max() == pytest.approx(front - 7, abs=3)
    assert medial[:, 1].min() == pytest.approx(front - 30, abs=5)


def test_the_identification_stands_on_the_rearfoot_post(left_foot: Foot):
    rules = read_rules().only(("watertight",))
    insole = build_insole(left_foot, cupped(posts=(REAR,)))
    part = make_part(insole, Order(mark=("P-0412", "left")), rules)
    assert part.findings[0].passed
    plain = insole_solid(insole)
    assert 20 < plain.volume_mm3 - part.solid.volume_mm3 < 400
    with pytest.raises(DesignError, match="does not lie wholly on a flat bottom"):
        make_part(build_insole(left_foot, cupped()), Order(mark=("P-0412",)), rules)


def test_posts_and_postings_count_together(left_foot: Foot):
    design = cupped(posts=(Post(angle_deg=10.0),)).with_added(Posting(rearfoot_deg=8.0))
    with pytest.raises(DesignError, match="turn the foot by 18° together"):
        build_insole(left_foot, design)


# --- Heel pitch -------------------------------------------------------------------------------


def test_a_pitched_underside_has_the_shape_of_the_last(left_foot: Foot):
    design = InsoleDesign(Side.LEFT, shell=Shell(heel_pitch_mm=20.0))
    length = left_foot.length_mm
    heights = last_heights_mm(design, np.array([0.15, 0.7, 0.45, 0.0, 0.9]) * length, length)
    heel, ball, waist, rear, toes = heights
    assert heel == pytest.approx(toes, abs=1e-9)
    assert ball == pytest.approx(heel, abs=0.3)  # rounded where it bends
    assert waist < heel - 1.0
    assert rear < heel - 2.0
    level, pitched = (
        build_insole(left_foot, each) for each in (replace(design, shell=Shell()), design)
    )
    bottom = faces(insole_solid(pitched))[1]
    expected = last_heights_mm(design, bottom[:, 1], length)
    assert bottom[:, 2] == pytest.approx(expected, abs=0.02)
    assert bottom[:, 2].min() == pytest.approx(0, abs=0.02)
    ground = last_heights_mm(design, pitched.contact.y_mm, length)[:, None]
    assert (pitched.contact.heights_mm - ground).min() == pytest.approx(design.thickness_mm)
    # The foot stands as it stood: its surface is only raised.
    assert np.ptp(pitched.contact.heights_mm - level.contact.heights_mm) < 1e-9


# --- Taper, least thickness -------------------------------------------------------------------


@pytest.mark.parametrize("bottom", ["flat", "following"])
def test_the_front_edge_tapers_without_a_kink(left_foot: Foot, bottom: str):
    shell = Shell(edge_radius_mm=0.0, taper_mm=1.0, taper_length_mm=18.0)
    design = replace(cupped(), bottom=bottom, shell=shell, thickness_mm=4.0)
    insole = build_insole(left_foot, design)
    top, under = faces(insole_solid(insole))
    middle = np.abs(top[:, 0]) < 0.5
    y, thickness = top[middle, 1], (top - under)[middle, 2]
    order = np.argsort(y)
    behind, thickness = y.max() - y[order], thickness[order]
    assert thickness[-1] == pytest.approx(1.0, abs=0.1)
    assert thickness[(behind > 20) & (behind < 30)] == pytest.approx(
        (insole.contact.height_at(top[middle][order, :2]) - (under[middle][order, 2]))[
            (behind > 20) & (behind < 30)
        ],
        abs=1e-9,
    )
    even = np.interp(np.arange(0.0, 30.0), behind[::-1], thickness[::-1])
    assert np.abs(np.diff(even, 2)).max() < 0.25
    assert np.abs(np.diff(even)).max() < 1.0


def test_a_following_shell_tapers_from_below(left_foot: Foot):
    insole = build_insole(left_foot, cupped(edge_radius_mm=0.0))
    top, _ = faces(insole_solid(insole))
    assert top[:, 2] == pytest.approx(insole.contact.height_at(top[:, :2]), abs=1e-9)


@pytest.mark.parametrize(
    ("material", "bottom", "thickness_mm", "pad_mm"),
    [
        ("EVA", "flat", 3.0, -2.5),
        ("polypropylene", "flat", 3.0, -2.5),
        ("polypropylene", "following", 1.0, 4.0),
        ("PA12, printed", "following", 2.0, -1.5),
        ("balsa", "flat", 1.0, -0.5),
    ],
)
def test_the_least_thickness_of_the_material_is_kept(
    left_foot: Foot, material: str, bottom: str, thickness_mm: float, pad_mm: float
):
    pad = Pelott(centre_mm=(5.0, 110.0), height_mm=pad_mm, length_mm=30, width_mm=25)
    design = InsoleDesign(
        Side.LEFT, (CUP, pad), bottom=bottom, thickness_mm=thickness_mm, outline=SHORT,
        shell=Shell(material=material, taper_mm=0.5, draft_medial_deg=-5.0, posts=(REAR,)),
    )  # fmt: skip
    part = make_part(build_insole(left_foot, design), Order(), read_rules().only(("thickness",)))
    (finding,) = part.findings
    assert finding.passed
    assert finding.limit >= 1.0


def test_the_check_knows_what_the_material_needs(left_foot: Foot):
    thin = InsoleDesign(Side.LEFT, thickness_mm=1.5, bottom="following")
    rules = read_rules().only(("thickness",))
    (plain,) = make_part(build_insole(left_foot, thin), Order(), rules).findings
    assert (plain.passed, plain.limit) == (True, 1.0)
    shelled = replace(thin, shell=Shell(material="EVA"))
    (of_eva,) = make_part(build_insole(left_foot, shelled), Order(), rules).findings
    assert (of_eva.passed, of_eva.limit) == (True, 2.0)


# --- Cover, edges, walls ----------------------------------------------------------------------


def test_a_cover_that_is_taken_off_leaves_the_underside(left_foot: Foot):
    with_cover, without = (
        build_insole(
            left_foot,
            replace(
                cupped(edge_radius_mm=0.0), thickness_mm=thickness,
                layers=Layers(cover_mm=2.0, cover_is_taken_off=off),
            ),
        )
        for thickness, off in ((5.0, False), (3.0, True))
    )  # fmt: skip
    assert np.array_equal(with_cover.contact.heights_mm, without.contact.heights_mm)
    top, under = faces(insole_solid(without))
    assert np.array_equal(under[:, :2], faces(insole_solid(with_cover))[1][:, :2])
    behind = under[:, 1] < 100
    assert under[behind, 2] == pytest.approx(faces(insole_solid(with_cover))[1][behind, 2])
    gap = KDTree(fine(without)).query(top[(top[:, 1] > 60) & (top[:, 1] < 90)])[0]
    assert gap == pytest.approx(2.0, abs=0.15)
    assert np.median(gap) == pytest.approx(2.0, abs=0.03)


def fine(insole: Insole) -> FloatArray:
    """Points of the contact surface between y = 50 and 100, 0.2 mm apart."""
    field = insole.contact
    x, y = np.meshgrid(np.arange(field.x_mm[0], field.x_mm[-1], 0.2), np.arange(50.0, 100, 0.2))
    places = np.stack([x.ravel(), y.ravel()], axis=1)
    return np.column_stack([places, field.height_at(places)])


@pytest.mark.parametrize("kind", ["block", "positive"])
def test_block_and_mould_are_made_for_the_surface_without_cover(left_foot: Foot, kind):
    plain = cupped()
    design = replace(plain, layers=Layers(cover_mm=2.0, cover_is_taken_off=True))
    insole = build_insole(left_foot, design)
    bare = replace(insole, contact=made_surface(insole), design=replace(plain, thickness_mm=3.0))
    assert np.array_equal(make_solid(insole, kind).vertices, make_solid(bare, kind).vertices)


@pytest.mark.parametrize("radius_mm", [0.5, 1.0, 4.0])
def test_a_rounded_edge_oblique_to_the_grid_has_no_facets(left_foot: Foot, radius_mm: float):
    turn = np.radians(27.0)
    spin = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    design = InsoleDesign(
        Side.LEFT, thickness_mm=10.0, shell=Shell(edge_radius_mm=radius_mm, taper_length_mm=5.0)
    )
    insole = build_insole(left_foot, design)
    flat = replace(insole.contact, heights_mm=np.full_like(insole.contact.heights_mm, 12.0))
    solid = insole_solid(
        replace(insole, contact=flat), outline=(SQUARE - [0, 110]) @ spin + [0, 110]
    )
    assert faults(solid) == []
    rng = np.random.default_rng(3)
    inside = rng.uniform(0.03, radius_mm, 2000)
    there = np.column_stack([20 - inside, rng.uniform(80.0, 140.0, 2000)])  # the medial side
    places = (there - [0, 110]) @ spin + [0, 110]
    down = np.broadcast_to([0.0, 0.0, -1.0], (len(places), 3))
    hits = RayCaster(solid).cast(np.column_stack([places, np.full(len(places), 30.0)]), down)
    corners = solid.vertices[solid.triangles[hits.triangle], 2]
    lowered = 12.0 - (hits.weights * corners).sum(axis=1)
    rounded = radius_mm - np.sqrt(radius_mm**2 - (radius_mm - inside[hits.ray]) ** 2)
    beside = np.hypot(1.0, (radius_mm - inside[hits.ray]) / (radius_mm - rounded))  # 1/cos slope
    assert len(hits.ray) == len(places)
    assert np.abs((lowered - rounded) / beside).max() < 0.06


def test_the_walls_of_the_order_give_way_to_those_of_the_shell(left_foot: Foot):
    rules = read_rules().only(())
    insole = build_insole(left_foot, cupped(edge_radius_mm=0.0))
    usual, asked = (
        make_part(insole, Order(options=options), rules)
        for options in (SolidOptions(), SolidOptions(draft_deg=10.0))
    )
    assert np.array_equal(usual.solid.vertices, asked.solid.vertices)
    assert usual.notes == ()
    assert [str(note)[:36] for note in asked.notes] == ["Draft and chamfer of the walls are t"]


def test_drafts_differ_between_the_borders(left_foot: Foot):
    shell = Shell(draft_medial_deg=20.0, draft_lateral_deg=5.0, edge_radius_mm=0.0)
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, thickness_mm=8.0, shell=shell))
    top, under = faces(insole_solid(insole, SolidOptions(draft_deg=0.0), SQUARE))
    sign = Side.LEFT.medial_sign
    for border, draft in ((sign, 20.0), (-sign, 5.0)):
        at = (np.abs(top[:, 0] - 20 * border) < 0.05) & (np.abs(top[:, 1] - 100) < 20)
        lean = border * (under - top)[at, 0]
        assert at.sum() > 30
        assert lean == pytest.approx(top[at, 2] * np.tan(np.radians(draft)), abs=0.1)
