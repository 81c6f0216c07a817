"""Pads and strokes on a base: in order, only where they reach, and the same for every drag."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.side import Side
from insole_core.insole.elements import ArchRaise, BrushStroke, HeelLift, Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.surface.contact import contact_base, with_rim
from insole_core.insole.surface.pads_on_surface import apply_pads, moved_pad

PAD = Pelott(centre_mm=(5.0, 150.0))
OTHER = Pelott(centre_mm=(-12.0, 140.0), shape="bar", length_mm=30, width_mm=30, height_mm=2)
PUSH = BrushStroke(points_mm=((0.0, 40.0), (10.0, 80.0)), radius_mm=12, strength=1.5)
ARCH = ArchRaise(target_mm=30.0, apex_mm=(20.0, 100.0))
SMOOTH = BrushStroke(mode="smooth", points_mm=((0.0, 130.0), (9.0, 165.0)), strength=0.7)
PLAIN = InsoleDesign(Side.LEFT)


def surface(foot, design):
    return apply_pads(contact_base(foot, design), design)


def all_normals(field):
    slopes = np.stack(
        [*np.gradient(-field.heights_mm, field.step_mm), np.ones(field.heights_mm.shape)]
    )
    return np.moveaxis(slopes / np.linalg.norm(slopes, axis=0), 0, -1)


@pytest.mark.parametrize(
    ("change", "reach"),
    [
        (lambda d: d.with_changed(replace(PAD, centre_mm=(7.5, 148.0))), 70),
        (lambda d: d.with_changed(replace(PAD, height_mm=2.0, turn_deg=40.0)), 70),
        (lambda d: d.with_changed(replace(PAD, enabled=False)), 70),
        (lambda d: d.with_removed(PAD.id), 70),
        (lambda d: d.with_changed(replace(ARCH, target_mm=36.0)), 110),
        (lambda d: d.with_changed(replace(PUSH, strength=-1.0, mode="pull")), 80),
        (lambda d: d.with_added(Pelott(centre_mm=(-5.0, 60.0), shape="cut_out", height_mm=-1)), 80),
        (lambda d: d.with_changed(replace(PAD, centre_mm=(900.0, 900.0))), 120),
        (lambda d: replace(d, corrections=d.corrections[::-1]), 400),
    ],
    ids=[
        "move",
        "reshape",
        "switch off",
        "remove",
        "arch",
        "stroke",
        "add",
        "off the foot",
        "reorder",
    ],
)
def test_update_is_what_a_rebuild_gives_to_the_bit(left_foot, change, reach):
    old = replace(PLAIN, corrections=(OTHER, PAD, PUSH, SMOOTH, ArchRaise(height_mm=2), ARCH))
    new = change(old)
    base = contact_base(left_foot, old)
    update = moved_pad(base, apply_pads(base, old), old, new)
    rebuilt = apply_pads(base, new)
    assert np.array_equal(update.surface.heights_mm, rebuilt.heights_mm)
    different = update.surface.heights_mm != apply_pads(base, old).heights_mm
    different |= (all_normals(update.surface) != all_normals(apply_pads(base, old))).any(axis=2)
    different[update.window.rows, update.window.columns] = False
    assert not different.any()
    assert update.window.end_row - update.window.first_row <= reach + 60


def test_nothing_changed_is_the_same_surface(left_foot):
    design = PLAIN.with_added(PAD)
    base = contact_base(left_foot, design)
    before = apply_pads(base, design)
    update = moved_pad(base, before, design, replace(design, bottom="following"))
    assert update.window.is_empty
    assert update.surface is before


def test_push_and_pull_are_opposite_and_end_at_the_radius(left_foot):
    plain = surface(left_foot, PLAIN)
    push, pull = (
        surface(left_foot, PLAIN.with_added(replace(PUSH, mode=mode))).heights_mm - plain.heights_mm
        for mode in ("push", "pull")
    )
    assert push == pytest.approx(-pull, abs=1e-9)
    assert push.max() == pytest.approx(1.5, abs=0.01)
    x, y = np.meshgrid(plain.x_mm, plain.y_mm)
    start, end = np.array(PUSH.points_mm)
    share = np.clip(((np.stack([x, y], -1) - start) @ (end - start)) / 1700.0, 0, 1)
    away = np.hypot(
        *np.moveaxis(np.stack([x, y], -1) - start - share[..., None] * (end - start), -1, 0)
    )
    assert np.all(push[away > 12.01] == 0)
    assert np.all(push[away < 10] > 0)


def test_smoothing_evens_out_where_it_is_and_nowhere_else(left_foot):
    rough = PLAIN.with_added(Pelott(centre_mm=(5, 150), length_mm=12, width_mm=12, height_mm=4))
    stroke = BrushStroke(mode="smooth", points_mm=((5.0, 150.0),), radius_mm=20, strength=1.0)
    before, after = surface(left_foot, rough), surface(left_foot, rough.with_added(stroke))
    top = np.array([5.0, 150.0])
    assert after.height_at(top) < before.height_at(top) - 1
    x, y = np.meshgrid(before.x_mm, before.y_mm)
    outside = np.hypot(x - 5, y - 150) > 20
    assert np.array_equal(before.heights_mm[outside], after.heights_mm[outside])


def test_order_matters_for_smoothing(left_foot):
    pad = Pelott(centre_mm=(5, 150), length_mm=14, width_mm=14, height_mm=4)
    stroke = BrushStroke(mode="smooth", points_mm=((5.0, 150.0),), radius_mm=20, strength=1.0)
    first, last = (
        surface(left_foot, replace(PLAIN, corrections=c)).height_at(np.array([5.0, 150.0]))
        for c in ((stroke, pad), (pad, stroke))
    )
    assert first > last + 1


def test_arch_raise_stands_where_it_was_put_or_on_the_foots_own_apex(left_foot):
    plain = surface(left_foot, PLAIN)
    own = surface(left_foot, PLAIN.with_added(ArchRaise(height_mm=4))).heights_mm - plain.heights_mm
    put = surface(left_foot, PLAIN.with_added(ArchRaise(height_mm=4, apex_mm=(20.0, 90.0))))
    row, column = np.unravel_index(own.argmax(), own.shape)
    assert own.max() == pytest.approx(4, abs=0.01)
    assert plain.x_mm[column] > 8
    assert 70 < plain.y_mm[row] < 150
    assert put.height_at(np.array([20.0, 90.0])) == pytest.approx(
        plain.height_at(np.array([20.0, 90.0])) + 4, abs=0.01
    )


@pytest.mark.parametrize("finish", [None, Finish(arch_fill_mm=3.2)], ids=["plain", "finished"])
@pytest.mark.parametrize("corrections", [(), (HeelLift(height_mm=5),), (Posting(rearfoot_deg=6),)])
def test_an_arch_reaches_its_target_whatever_is_below_it(left_foot, corrections, finish):
    apex = (18.0, 118.0)  # a node
    arch = ArchRaise(target_mm=31.0, height_mm=9.0, apex_mm=apex)
    design = replace(PLAIN, corrections=(*corrections, arch), finish=finish)
    base = contact_base(left_foot, design)
    raised = apply_pads(base, design)
    assert float(raised.height_at(np.array(apex))) == pytest.approx(31.0, abs=1e-9)
    change = raised.heights_mm - base.surface.heights_mm
    x, y = np.meshgrid(raised.x_mm, raised.y_mm)
    share = np.hypot((x - apex[0]) / 25.0, (y - apex[1]) / 50.0)
    assert np.all(change[share > 1.01] == 0)
    assert np.all(change[share < 0.9] > 0)


def test_an_arch_reaches_its_target_on_every_surface_of_the_same_foot(left_foot):
    apex = (18.0, 118.0)  # a node
    arch = ArchRaise(target_mm=31.0, apex_mm=apex)
    for thickness_mm in (3.0, 7.0):
        design = replace(PLAIN, thickness_mm=thickness_mm, corrections=(arch,))
        assert surface(left_foot, design).height_at(np.array(apex)) == pytest.approx(31.0, abs=1e-9)


def test_an_arch_reaches_its_target_beside_a_rim_that_moves(left_foot):
    apex = (26.0, 118.0)
    arch = ArchRaise(target_mm=40.0, apex_mm=apex)
    low, high = (
        replace(
            PLAIN,
            corrections=(arch,),
            finish=Finish(
                arch_blend_mm=25.0,
                rim=(
                    RimStation(border="medial", along=0.45, height_mm=height_mm),
                    RimStation(border="lateral", along=0.45, height_mm=8.0),
                ),
            ),
        )
        for height_mm in (12.0, 24.0)
    )
    base = contact_base(left_foot, low)
    apply_pads(base, low)
    moved = with_rim(base, left_foot, high)
    assert moved.surface.height_at(np.array(apex)) != base.surface.height_at(np.array(apex))
    raised = apply_pads(moved, high)
    assert raised.height_at(np.array(apex)) == pytest.approx(40.0, abs=1e-9)


def test_an_arch_above_its_target_stays_as_it_is(left_foot):
    design = PLAIN.with_added(ArchRaise(target_mm=4.0))
    base = contact_base(left_foot, design)
    assert np.array_equal(apply_pads(base, design).heights_mm, base.surface.heights_mm)


def test_an_arch_with_a_target_beside_the_grid_changes_nothing(left_foot):
    design = PLAIN.with_added(ArchRaise(target_mm=40.0, apex_mm=(399.0, 118.0)))
    base = contact_base(left_foot, design)
    assert np.array_equal(apply_pads(base, design).heights_mm, base.surface.heights_mm)


@pytest.mark.parametrize("side", ["left_foot", "right_foot"])
def test_without_a_place_the_foots_own_arch_reaches_the_target(request, side):
    foot = request.getfixturevalue(side)
    design = InsoleDesign(foot.side, (ArchRaise(target_mm=32.0),))
    apex = np.array(contact_base(foot, design).arch_apex_mm)
    assert apex[0] * foot.side.medial_sign > 8
    assert surface(foot, design).height_at(apex) == pytest.approx(32.0, abs=0.05)
