"""From foot and design to the surface: thickness, posting, pads, sides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import binary_erosion, maximum_filter, minimum_filter

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import apply_pads, build_insole
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.contact import base_key, contact_base
from insole_core.progress import Cancelled, Progress

PAD = Pelott(centre_mm=(12.3, 150.4), height_mm=6.0, turn_deg=10)


def plate(side: Side, slope: tuple[float, float] = (0.0, 0.0)) -> Foot:
    """A flat sole of 100 x 240 mm that faces the ground: two large triangles."""
    corners = np.array([[-50, 0], [50, 0], [50, 240], [-50, 240]], float)
    z = corners @ slope
    vertices = np.column_stack([corners, z - z.min()])
    mesh = TriangleMesh(vertices, np.array([[0, 2, 1], [0, 3, 2]], np.int32))
    return Foot(side, mesh, np.eye(4), 240.0)


def plane_of(field, where) -> np.ndarray:
    """Slopes (x, y) and offset of the plane through the nodes that `where` picks."""
    x, y = np.meshgrid(field.x_mm, field.y_mm)
    a = np.column_stack([x[where], y[where], np.ones(where.sum())])
    return np.linalg.lstsq(a, field.heights_mm[where], rcond=None)[0]


@pytest.mark.parametrize("thickness", [0.5, 3.0, 7.25])
def test_lowest_point_is_the_thickness(left_foot, thickness):
    design = InsoleDesign(Side.LEFT, (Posting(rearfoot_deg=5),), thickness_mm=thickness)
    assert build_insole(left_foot, design).contact.heights_mm.min() == pytest.approx(thickness)


def test_flat_sole_is_met_exactly():
    insole = build_insole(plate(Side.LEFT, (0.05, -0.02)), InsoleDesign(Side.LEFT, grid_mm=1.0))
    inside = binary_erosion(insole.measured, iterations=5)
    slope_x, slope_y, offset = plane_of(insole.contact, inside)
    assert (slope_x, slope_y) == pytest.approx((0.05, -0.02), abs=1e-9)
    plane = offset + insole.contact.nodes[:, :2] @ [0.05, -0.02]
    off = np.abs(insole.contact.heights_mm.ravel() - plane)[insole.measured.ravel()]
    assert off.max() < 0.07, "evened at the rim only, by hardly more than a step of it"
    assert insole.measured.sum() == pytest.approx(101 * 241, rel=0.01)


def test_a_flank_that_ends_in_shreds_leaves_no_pits(left_foot):
    """Of the steep flanks half of the triangles are missing, as where a scan frays out."""
    mesh, design = left_foot.mesh, InsoleDesign(Side.LEFT, grid_mm=1.0)
    steep = mesh.triangle_normals[:, 2] > -0.7
    gone = steep & (np.random.default_rng(3).random(len(steep)) < 0.5)
    frayed = replace(left_foot, mesh=replace(mesh, triangles=mesh.triangles[~gone]))
    whole, torn = (build_insole(foot, design) for foot in (left_foot, frayed))
    heights = torn.contact.heights_mm
    others = np.ones((3, 3), bool)
    others[1, 1] = False
    pit_mm = minimum_filter(heights, footprint=others, mode="nearest") - heights
    assert pit_mm.max() < 0.3
    spike_mm = heights - maximum_filter(heights, footprint=others, mode="nearest")
    assert spike_mm.max() < 0.6
    inside = binary_erosion(torn.measured, iterations=6)
    assert inside.sum() > 0.4 * whole.measured.sum()
    np.testing.assert_allclose(heights[inside], whole.contact.heights_mm[inside], atol=0.01)


def test_surface_follows_the_foot(left_foot):
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT, grid_mm=1.0))
    sole = left_foot.mesh.vertices[
        (left_foot.mesh.vertex_normals[:, 2] < -0.7) & (left_foot.mesh.vertices[:, 2] < 25)
    ]
    gap = insole.contact.height_at(sole[:, :2]) - (sole[:, 2] + 3.0)
    assert np.abs(gap).mean() < 0.1
    assert np.quantile(np.abs(gap), 0.99) < 0.5


def test_surface_goes_on_to_the_edges_without_step(left_foot):
    insole = build_insole(left_foot, InsoleDesign(Side.LEFT))
    field = insole.contact
    assert np.isfinite(field.heights_mm).all()
    assert field.heights_mm.max() <= 3.0 + 30.0 + 0.5
    low = left_foot.mesh.vertices[left_foot.mesh.vertices[:, 2] < 45]
    assert field.x_mm[0] == pytest.approx(low[:, 0].min() - 10, abs=1)
    assert field.y_mm[-1] == pytest.approx(low[:, 1].max() + 10, abs=1)
    outside = ~insole.measured
    flat = outside[:, 1:] & outside[:, :-1]
    assert np.abs(np.diff(field.heights_mm, axis=1)[flat]).max() < 3


def test_arch_is_kept_and_max_height_holds(left_foot):
    full = build_insole(left_foot, InsoleDesign(Side.LEFT)).contact
    low = build_insole(left_foot, InsoleDesign(Side.LEFT, max_height_mm=8)).contact
    arch, lateral = full.height_at(np.array([[25.0, 100.0], [-25.0, 100.0]]))
    assert arch > lateral + 5
    assert low.heights_mm.max() < 3 + 8.5


def test_nodes_lie_at_multiples_of_the_step(left_foot):
    for grid_mm in (0.7, 1.0, 2.5):
        field = contact_base(left_foot, InsoleDesign(Side.LEFT, grid_mm=grid_mm)).surface
        for origin in (field.x0_mm, field.y0_mm):
            assert origin / grid_mm == pytest.approx(round(origin / grid_mm), abs=1e-9)


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("angle", [-6.0, 4.0, 12.0])
def test_equal_angles_tilt_a_plane_by_the_angle(side, angle):
    posting = Posting(rearfoot_deg=angle, forefoot_deg=angle)
    insole = build_insole(plate(side), InsoleDesign(side, (posting,)))
    slope = plane_of(insole.contact, insole.measured)[0]
    assert np.degrees(np.arctan(slope)) * side.medial_sign == pytest.approx(angle, abs=0.01)


def fine_plate(side: Side) -> Foot:
    x, y = np.meshgrid(np.arange(-50.0, 50.1, 2), np.arange(0.0, 240.1, 2))
    index = np.arange(x.size, dtype=np.int32).reshape(x.shape)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    triangles = np.concatenate(
        [np.stack([a, c, b], -1).reshape(-1, 3), np.stack([a, d, c], -1).reshape(-1, 3)]
    )
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    return Foot(side, TriangleMesh(vertices, triangles), np.eye(4), 240.0)


@pytest.mark.parametrize("side", list(Side))
def test_twist_between_rearfoot_and_forefoot(side):
    posting = Posting(rearfoot_deg=5, forefoot_deg=-3)
    insole = build_insole(fine_plate(side), InsoleDesign(side, (posting,)))
    y = np.broadcast_to(insole.contact.y_mm[:, None], insole.measured.shape)
    for where, angle in ((y < 58, 5), (y > 158, -3), (np.abs(y - 108) < 1, 1)):
        slope = plane_of(insole.contact, insole.measured & where)[0]
        assert np.degrees(np.arctan(slope)) * side.medial_sign == pytest.approx(angle, abs=0.05)


def test_postings_add_up_and_can_be_switched_off(left_foot):
    both = (Posting(rearfoot_deg=3, forefoot_deg=1), Posting(rearfoot_deg=-1, forefoot_deg=1))
    one = (Posting(rearfoot_deg=2, forefoot_deg=2), Posting(rearfoot_deg=9, enabled=False))
    a, b = (build_insole(left_foot, InsoleDesign(Side.LEFT, c)).contact for c in (both, one))
    assert np.abs(a.heights_mm - b.heights_mm).max() < 1e-9


@pytest.mark.parametrize("grid_mm", [0.5, 1.0])
def test_pad_changes_nothing_outside_and_is_exact_at_the_nodes(left_foot, grid_mm):
    design = InsoleDesign(Side.LEFT, grid_mm=grid_mm)
    without = build_insole(left_foot, design).contact
    with_pad = build_insole(left_foot, design.with_added(PAD)).contact
    added = with_pad.heights_mm - without.heights_mm
    row, column = np.unravel_index(added.argmax(), added.shape)
    place = np.array([without.x_mm[column], without.y_mm[row]])
    assert np.linalg.norm(place - PAD.centre_mm) <= grid_mm * np.sqrt(0.5) + 1e-9
    assert added.max() == pytest.approx(6, abs=0.01)
    (left, back), (right, front) = pad_outline(PAD).min(axis=0), pad_outline(PAD).max(axis=0)
    x, y = np.meshgrid(without.x_mm, without.y_mm)
    outside = (x < left) | (x > right) | (y < back) | (y > front)
    assert np.array_equal(with_pad.heights_mm[outside], without.heights_mm[outside])


def test_drag_of_a_pad_gives_what_a_rebuild_gives(left_foot):
    design = InsoleDesign(Side.LEFT, (PAD, Posting(rearfoot_deg=3)))
    base = contact_base(left_foot, design)
    moved = design.with_changed(replace(PAD, centre_mm=(-5.0, 130.0)))
    assert base_key(moved) == base_key(design)
    assert np.array_equal(
        apply_pads(base, moved).heights_mm, build_insole(left_foot, moved).contact.heights_mm
    )
    assert base_key(replace(design, thickness_mm=4)) != base_key(design)
    assert base_key(design.with_added(Posting(forefoot_deg=1))) != base_key(design)


def test_pad_over_the_edge_of_the_block_is_cut_there(left_foot):
    pad = Pelott(centre_mm=(60.0, 5.0), length_mm=150, width_mm=100)
    assert build_insole(left_foot, InsoleDesign(Side.LEFT, (pad,))).contact.heights_mm.max() < 45
    far = Pelott(centre_mm=(390.0, -300.0))
    with_far = build_insole(left_foot, InsoleDesign(Side.LEFT, (far,))).contact
    plain = build_insole(left_foot, InsoleDesign(Side.LEFT)).contact
    assert np.array_equal(with_far.heights_mm, plain.heights_mm)


def test_mirrored_design_of_a_mirrored_foot_gives_the_mirrored_insole(left_foot):
    mesh = replace(left_foot.mesh, vertices=left_foot.mesh.vertices * [-1, 1, 1]).flipped()
    right_foot = Foot(Side.RIGHT, mesh, np.eye(4), left_foot.length_mm)
    posting = Posting(rearfoot_deg=4, forefoot_deg=1)
    mirrored = replace(PAD, centre_mm=(-12.3, 150.4), turn_deg=-10)
    left = build_insole(left_foot, InsoleDesign(Side.LEFT, (PAD, posting))).contact
    right = build_insole(right_foot, InsoleDesign(Side.RIGHT, (mirrored, posting))).contact
    assert right.x_mm == pytest.approx(-left.x_mm[::-1])
    assert np.abs(right.heights_mm[:, ::-1] - left.heights_mm).max() < 1e-6


def test_design_for_the_other_side_is_refused(left_foot):
    with pytest.raises(DesignError, match="for a right foot and the scan is of a left one"):
        build_insole(left_foot, InsoleDesign(Side.RIGHT))


def test_recess_through_the_bottom_is_refused(left_foot):
    recess = replace(PAD, height_mm=-19.0, length_mm=150, width_mm=150)
    with pytest.raises(DesignError, match=r"only -?\d+\.\d mm thick at x = "):
        build_insole(left_foot, InsoleDesign(Side.LEFT, (recess,)))


def test_value_out_of_range_is_refused(left_foot):
    with pytest.raises(DesignError, match=r"thickness_mm is 0, and must be 0\.5 to 40 mm"):
        build_insole(left_foot, InsoleDesign(Side.LEFT, thickness_mm=0))


def test_foot_that_turns_its_back_to_the_ground_is_refused(left_foot):
    upside = replace(left_foot, mesh=plate(Side.LEFT).mesh.flipped())
    with pytest.raises(DesignError, match="No part of this foot faces the ground"):
        build_insole(upside, InsoleDesign(Side.LEFT))


def test_building_can_be_cancelled_and_reports_its_steps(left_foot):
    steps: list[float] = []
    build_insole(left_foot, InsoleDesign(Side.LEFT), Progress(lambda f, _: steps.append(f)))
    assert steps == sorted(steps)
    assert steps[-1] == 1.0
    with pytest.raises(Cancelled):
        build_insole(
            left_foot, InsoleDesign(Side.LEFT), Progress(is_cancelled=lambda: len(steps) > 0)
        )


@pytest.mark.slow
@pytest.mark.shared
def test_ankle_does_not_press_through_the_sole(true_foot):
    foot = true_foot("left_a", Side.LEFT)
    contact = build_insole(foot, InsoleDesign(Side.LEFT)).contact
    assert contact.heights_mm.max() < 3 + 31
    assert contact.height_at(np.array([0.0, 40.0])) < 3 + 4
