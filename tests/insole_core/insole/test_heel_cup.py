"""The heel cup of every depth: no needle in its bowl and no step at its wall."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import maximum_filter, minimum_filter

from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import HeelCup, HeelLift, Posting
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.outline_curve import inside_curve

DEPTHS = [0.0, 6.0, 12.0, 20.0, 30.0]
CUP_END = 0.46
"""Share of the length behind which a cup changes the surface, and a little more."""
NEIGHBOURS = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]], bool)


def bounds(depth_mm: float) -> tuple[float, float]:
    """Return the steepest slope, and the greatest second difference in steps of 1 mm.

    A deep cup must rise by its depth between the flank and the edge, a few millimetres apart.
    """
    if depth_mm <= 12.0:
        return 3.5, 3.0
    return (7.0, 5.5) if depth_mm <= 20.0 else (9.0, 9.0)


def cupped(foot: Foot, depth_mm: float, *others, grid_mm: float = 1.0) -> Insole:
    cup = HeelCup(depth_mm=depth_mm)
    return build_insole(foot, InsoleDesign(foot.side, (cup, *others), grid_mm=grid_mm))


def in_the_heel(insole: Insole) -> np.ndarray:
    """Pick the nodes of the insole, within its edge, in and around the cup."""
    field = insole.contact
    curve = insole_outline(insole.foot, insole.design, {})
    nodes = np.stack(np.meshgrid(field.x_mm, field.y_mm), axis=-1)
    return inside_curve(curve[::4], nodes) & (nodes[..., 1] < CUP_END * insole.foot.length_mm)


def assert_fair(insole: Insole, depth_mm: float) -> None:
    """Check slope, second difference and needles, whatever the grid."""
    field, heel = insole.contact, in_the_heel(insole)
    heights, stride = field.heights_mm, round(1.0 / field.step_mm)
    most_slope, most_bend = bounds(depth_mm)
    for axis in (0, 1):
        h, inside = (np.moveaxis(a, axis, 0) for a in (heights, heel))
        slope = np.abs(h[1:] - h[:-1])[inside[1:] & inside[:-1]] / field.step_mm
        assert slope.max() < most_slope
        bend = h[2 * stride :] - 2 * h[stride:-stride] + h[: -2 * stride]
        assert np.abs(bend)[inside[2 * stride :] & inside[: -2 * stride]].max() < most_bend
    around = {"footprint": NEIGHBOURS, "mode": "nearest"}
    assert (heights - maximum_filter(heights, **around))[heel].max() < 0.3, "a needle"
    assert (minimum_filter(heights, **around) - heights)[heel].max() < 0.3, "a pit"


def with_holes(foot: Foot) -> Foot:
    """A perfect surface that was not seen at sixty spots of 2 to 5 mm, nor at half of its flank."""
    mesh, rng = foot.mesh, np.random.default_rng(5)
    middles = mesh.vertices[mesh.triangles].mean(axis=1)
    spots = rng.uniform([-40, 0], [40, 110], (60, 2))
    radii = rng.uniform(1.0, 2.5, 60)
    away = np.hypot(*(middles[:, None, :2] - spots).transpose(2, 0, 1))
    gone = (away < radii).any(axis=1)
    gone |= (mesh.triangle_normals[:, 2] > -0.7) & (rng.random(len(gone)) < 0.5)
    return replace(foot, mesh=replace(mesh, triangles=mesh.triangles[~gone]))


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("grid_mm", [0.5, 1.0])
def test_cup_of_a_perfect_surface_is_fair(left_foot, depth, grid_mm):
    assert_fair(cupped(left_foot, depth, grid_mm=grid_mm), depth)


@pytest.fixture(scope="module")
def torn_foot(left_foot: Foot) -> Foot:
    return with_holes(left_foot)


@pytest.mark.parametrize("depth", DEPTHS)
def test_what_was_not_measured_is_no_wall(left_foot, torn_foot, depth):
    whole, torn = cupped(left_foot, depth), cupped(torn_foot, depth)
    assert_fair(torn, depth)
    bowl = in_the_heel(whole) & whole.measured
    x, y = np.meshgrid(whole.contact.x_mm, whole.contact.y_mm)
    bowl &= np.hypot(x, y - 35) < 22
    off = torn.contact.heights_mm - whole.contact.heights_mm
    assert np.abs(off[bowl]).max() < 0.5


@pytest.mark.parametrize("depth", [10.0, 14.0])
def test_cup_of_a_posted_and_lifted_heel_is_fair(torn_foot, depth):
    posting, lift = Posting(rearfoot_deg=6), HeelLift(height_mm=4)
    assert_fair(cupped(torn_foot, depth, posting, lift), depth)


@pytest.mark.parametrize("depth", [8.0, 12.0])
def test_rim_along_the_edge_has_the_depth(left_foot, depth):
    insole = cupped(left_foot, depth)
    field, length = insole.contact, left_foot.length_mm
    curve = insole_outline(left_foot, insole.design, {})
    edge = curve[curve[:, 1] < 0.28 * length]
    floor = field.heights_mm[field.y_mm < 0.22 * length].min()
    assert field.height_at(edge) - floor == pytest.approx(depth, abs=0.6)


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize(
    ("file", "side"),
    [
        ("dupontgu/left_foot.stl", Side.LEFT),
        ("dupontgu/right_foot.stl", Side.RIGHT),
        ("plantar_scan.obj", Side.RIGHT),
        ("focus_template/template.obj", Side.LEFT),
    ],
)
def test_cup_of_a_real_foot_is_fair(real_foot, file: str, side: Side, depth: float):
    assert_fair(cupped(real_foot(file, side), depth), depth)
