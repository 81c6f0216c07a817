"""Corrections of the whole surface: posting with its rim, twist, skive, lift and cup."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    Correction,
    ForefootTwist,
    FullLift,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
)
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_totals import check_totals, heel_lift_mm
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.template import mirrored
from insole_core.insole.surface.contact import contact_base

PLATE_HALF, PLATE_LENGTH = 50.0, 240.0


@cache
def plate(side: Side) -> Foot:
    half, length = PLATE_HALF, PLATE_LENGTH
    corners = np.array([[-half, 0, 0], [half, 0, 0], [half, length, 0], [-half, length, 0]])
    mesh = TriangleMesh(corners, np.array([[0, 2, 1], [0, 3, 2]], np.int32))
    return Foot(side, mesh, np.eye(4), length)


def heights(foot: Foot, *corrections: Correction, **keys) -> np.ndarray:
    return contact_base(foot, InsoleDesign(foot.side, corrections, **keys)).surface


def tilt_deg(field, y_mm: float, reach_mm: float) -> float:
    """Slope across, in degrees, > 0 where it rises to +x."""
    places = np.stack([np.linspace(-reach_mm, reach_mm, 50), np.full(50, y_mm)], axis=1)
    return float(np.degrees(np.arctan(np.polyfit(places[:, 0], field.height_at(places), 1)[0])))


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("angle", [-6.0, 4.0, 12.0])
@pytest.mark.parametrize("method", ["extrinsic", "intrinsic"])
def test_posting_has_its_angle(side, angle, method):
    posting = Posting(rearfoot_deg=angle, forefoot_deg=angle, method=method)
    field = heights(plate(side), posting)
    for y_mm in (20.0, 120.0, 230.0):
        assert side.medial_sign * tilt_deg(field, y_mm, 30) == pytest.approx(angle, abs=0.05)


def test_blend_zone_of_a_posting_can_be_set():
    posting = Posting(rearfoot_deg=6, forefoot_deg=-2, blend_start=0.4, blend_end=0.6)
    field = heights(plate(Side.LEFT), posting)
    for y_mm, angle in ((94.0, 6.0), (120.0, 2.0), (146.0, -2.0)):
        assert tilt_deg(field, y_mm, 40) == pytest.approx(angle, abs=0.05)


def test_intrinsic_posting_leaves_the_rim(left_foot):
    plain = heights(left_foot)
    tilted = heights(left_foot, Posting(rearfoot_deg=6, forefoot_deg=6, method="intrinsic"))
    added = tilted.heights_mm - plain.heights_mm
    middle = plain.y_mm < 0.7 * left_foot.length_mm
    outside = ~contact_base(left_foot, InsoleDesign(Side.LEFT)).measured[middle]
    assert np.ptp(added[middle][outside]) < 1e-9
    assert np.ptp(added) > 3


def test_twist_turns_the_forefoot_only():
    field = heights(plate(Side.RIGHT), ForefootTwist(angle_deg=4, blend_start=0.4, blend_end=0.7))
    assert tilt_deg(field, 90.0, 40) == pytest.approx(0, abs=1e-6)
    assert tilt_deg(field, 175.0, 40) == pytest.approx(-4, abs=0.05)


@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("border", ["medial", "lateral"])
def test_skive_adds_its_depth_at_its_border(side, border):
    skive = HeelSkive(border=border, depth_mm=4, slope_deg=15)
    added = heights(plate(side), skive).heights_mm - heights(plate(side)).heights_mm
    field = heights(plate(side))
    outward = side.medial_sign * (1 if border == "medial" else -1)
    row = int(np.searchsorted(field.y_mm, 30))
    at = field.x_mm * outward
    assert added[row, np.isclose(at, 50)] == pytest.approx(4, abs=0.05)
    assert added[row, at < 50 - 4 / np.tan(np.radians(15)) - 5].max() == 0
    slope = np.polyfit(at[(at > 42) & (at < 49)], added[row, (at > 42) & (at < 49)], 1)[0]
    assert np.degrees(np.arctan(slope)) == pytest.approx(15, abs=0.2)
    assert added[field.y_mm > 0.33 * PLATE_LENGTH].max() == 0


def test_skive_of_a_real_heel_raises_the_medial_side(left_foot):
    field = heights(left_foot)
    added = heights(left_foot, HeelSkive(depth_mm=3)).heights_mm - field.heights_mm
    assert added.max() == pytest.approx(3, abs=0.01)
    column = np.unravel_index(added.argmax(), added.shape)[1]
    assert field.x_mm[column] > 5


def test_lift_raises_the_heel_by_its_height():
    field = heights(plate(Side.LEFT), HeelLift(height_mm=5), thickness_mm=3)
    assert field.height_at(np.array([[0.0, 30.0], [0.0, 200.0]])) == pytest.approx([8, 3])


@pytest.mark.parametrize("depth", [8.0, 12.0])
def test_cup_is_as_deep_as_asked(left_foot, depth):
    field = heights(left_foot, HeelCup(depth_mm=depth))
    heel = field.heights_mm[field.y_mm < 0.2 * left_foot.length_mm]
    assert heel.max() - heel.min() == pytest.approx(depth, abs=0.05)
    plain = heights(left_foot)
    ahead = field.y_mm > 0.46 * left_foot.length_mm
    assert np.array_equal(field.heights_mm[ahead], plain.heights_mm[ahead])


def test_layers_together_are_a_least_thickness():
    thin = heights(plate(Side.LEFT), thickness_mm=2, layers=Layers(shell_mm=3, base_mm=2.5))
    assert thin.heights_mm.min() == pytest.approx(5.5)


EVERYTHING = (
    Posting(rearfoot_deg=4, forefoot_deg=1),
    Posting(rearfoot_deg=2, method="intrinsic"),
    ForefootTwist(angle_deg=2),
    HeelSkive(depth_mm=3),
    HeelLift(height_mm=2),
    HeelCup(depth_mm=14),
    ArchRaise(height_mm=2),
    Pelott(centre_mm=(5.3, 150.2), turn_deg=12),
    Pelott(centre_mm=(0.0, 40.0), shape="horseshoe", length_mm=60, width_mm=60, height_mm=3),
    Pelott(centre_mm=(30.0, 100.0), shape="arch_support", length_mm=90, width_mm=45, turn_deg=8),
    Pelott(
        centre_mm=(5.0, 140.0),
        shape="outline",
        outline_mm=((-15.0, -20.0), (15.0, -22.0), (18.0, 20.0), (-14.0, 22.0)),
    ),
    Pelott(centre_mm=(20.0, 180.0), shape="cut_out", length_mm=30, width_mm=25, height_mm=-1),
    BrushStroke(points_mm=((0.0, 50.0), (10.0, 80.0))),
    BrushStroke(mode="smooth", strength=0.8, points_mm=((0.0, 150.0), (10.0, 180.0))),
)


def test_mirrored_design_of_a_mirrored_foot_gives_the_mirrored_insole(left_foot):
    mesh = replace(left_foot.mesh, vertices=left_foot.mesh.vertices * [-1, 1, 1]).flipped()
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    source2insole = mirror @ left_foot.source2insole @ mirror
    right_foot = Foot(Side.RIGHT, mesh, source2insole, left_foot.length_mm)
    design = InsoleDesign(Side.LEFT, EVERYTHING)
    left = build_insole(left_foot, design).contact
    right = build_insole(right_foot, mirrored(design)).contact
    assert right.x_mm == pytest.approx(-left.x_mm[::-1])
    assert np.abs(right.heights_mm[:, ::-1] - left.heights_mm).max() < 1e-3


def test_mirrored_twice_is_the_design_itself():
    design = InsoleDesign(Side.LEFT, EVERYTHING)
    assert mirrored(mirrored(design)) == design
    assert mirrored(design).side is Side.RIGHT


@pytest.mark.parametrize("depth", [6.0, 12.0, 20.0, 28.0])
def test_cup_is_deep_where_the_scan_ends_low(depth):
    outline = Outline(heel_allowance_mm=6)
    low = InsoleDesign(Side.LEFT, corrections=(HeelCup(depth_mm=depth),), outline=outline)
    insole = build_insole(plate(Side.LEFT), low)
    bare = build_insole(plate(Side.LEFT), replace(low, corrections=()))
    field = insole.contact
    heel = field.y_mm < 0.25 * 240
    floor = field.heights_mm[heel][insole.measured[heel]].min()
    # 5 mm beside the foot, within the outline, the rim stands as high as it is asked.
    column = int(np.argmin(np.abs(field.x_mm - 55.0)))
    row = int(np.argmin(np.abs(field.y_mm - 40.0)))
    assert field.heights_mm[row, column] - floor == pytest.approx(depth, abs=0.05)
    raised = field.heights_mm - bare.contact.heights_mm
    assert np.abs(raised[insole.measured]).max() < 1e-9
    assert np.abs(raised[field.y_mm > 0.46 * 240]).max() < 1e-9


@pytest.mark.parametrize(("share", "heads_mm"), [(0.0, 0.0), (0.5, 4.0), (1.0, 8.0)])
def test_a_full_lift_is_whole_at_the_heel_a_share_of_it_at_the_heads_and_gone_at_the_toes(
    share: float, heads_mm: float
) -> None:
    field = heights(plate(Side.LEFT), FullLift(height_mm=8.0, heads_share=share))
    places = np.array([[0.0, at * PLATE_LENGTH] for at in (0.05, 0.25, 0.7, 1.0)])
    lifted = field.height_at(places) - field.height_at(places[-1])
    assert lifted == pytest.approx([8.0, 8.0, heads_mm, 0.0], abs=0.02)
    falls = np.diff(field.heights_mm[:, field.heights_mm.shape[1] // 2])
    assert falls.max() < 1e-9


def test_a_full_lift_and_a_heel_lift_add_up() -> None:
    both = InsoleDesign(Side.LEFT, (FullLift(height_mm=10.0), HeelLift(height_mm=12.0)))
    with pytest.raises(DesignError, match="add up to 22 mm, and must be -10 to 20 mm"):
        check_totals(both)
    assert heel_lift_mm(both) == 22.0
