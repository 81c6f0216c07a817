"""Where the insole ends: the allowances, the shoe's size and the drawn curve act to the number."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.design import InsoleDesign, Outline
from insole_core.insole.limits import check_design
from insole_core.insole.outline import insole_outline, outline_points
from insole_core.solids.solid import SolidOptions, insole_solid

LENGTH_MM, HALF_WIDTH_MM = 250.0, 40.0
NONE = Outline(toe_allowance_mm=0, ball_allowance_mm=0, heel_allowance_mm=0)


@pytest.fixture(scope="module")
def plate() -> Foot:
    """A flat sole of 80 × 250 mm."""
    x, y = np.meshgrid([-HALF_WIDTH_MM, HALF_WIDTH_MM], np.linspace(0, LENGTH_MM, 126))
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    row = 2 * np.arange(125, dtype=np.int32)[:, None]
    triangles = np.concatenate([row + np.array(corners) for corners in ((0, 2, 1), (1, 2, 3))])
    return Foot(Side.LEFT, TriangleMesh(vertices, triangles.astype(np.int32)), np.eye(4), LENGTH_MM)


def curve(foot: Foot, outline: Outline) -> np.ndarray:
    return insole_outline(foot, InsoleDesign(foot.side, outline=outline), {})


def sides_at(foot: Foot, outline: Outline, low_mm: float, high_mm: float) -> np.ndarray:
    """x of the places that the curve runs through, between two distances from the heel."""
    places = np.array(outline_points(foot, outline, {}))
    return np.sort(places[(places[:, 1] > low_mm) & (places[:, 1] < high_mm), 0])


@pytest.mark.parametrize("toes", [-5.0, 0.0, 5.0, 15.0, 30.0])
def test_toe_allowance_lengthens_the_insole_by_itself(plate: Foot, toes: float) -> None:
    longest = curve(plate, replace(NONE, toe_allowance_mm=toes))[:, 1].max()
    assert longest == pytest.approx(LENGTH_MM + toes, abs=0.05)


@pytest.mark.parametrize("heel", [0.0, 2.0, 12.0])
def test_heel_allowance_acts_behind_and_beside_the_heel(plate: Foot, heel: float) -> None:
    points = curve(plate, replace(NONE, heel_allowance_mm=heel))
    assert points[:, 1].min() == pytest.approx(-heel, abs=0.05)
    outline = replace(NONE, heel_allowance_mm=heel)
    at_heel, at_ball = sides_at(plate, outline, 40, 70), sides_at(plate, outline, 145, 190)
    assert np.abs(at_heel) == pytest.approx(HALF_WIDTH_MM + heel, abs=1e-6)
    assert np.abs(at_ball) == pytest.approx(HALF_WIDTH_MM, abs=1e-6)


@pytest.mark.parametrize("ball", [-3.0, 2.0, 12.0])
def test_ball_allowance_acts_on_both_sides_of_the_ball(plate: Foot, ball: float) -> None:
    outline = replace(NONE, ball_allowance_mm=ball)
    at_heel, at_ball = sides_at(plate, outline, 40, 70), sides_at(plate, outline, 145, 190)
    assert np.abs(at_ball) == pytest.approx(HALF_WIDTH_MM + ball, abs=1e-6)
    assert at_ball.sum() == pytest.approx(0.0, abs=1e-6)
    assert np.abs(at_heel) == pytest.approx(HALF_WIDTH_MM, abs=1e-6)


@pytest.mark.parametrize("outline", [
    Outline(toe_allowance_mm=30, ball_allowance_mm=20, heel_allowance_mm=20),
    Outline(source="shoe_size", shoe_size_eu=45),
    Outline(source="drawn", points_mm=((-70, -30), (70, -30), (70, 290), (-70, 290))),
])  # fmt: skip
def test_the_solid_reaches_its_outline_however_far_that_lies(plate: Foot, outline: Outline) -> None:
    design = InsoleDesign(Side.LEFT, outline=outline)
    solid = insole_solid(build_insole(plate, design), SolidOptions(draft_deg=0.0))
    asked = insole_outline(plate, design, {})
    low, high = solid.bounds_mm
    assert low[:2] == pytest.approx(asked.min(axis=0), abs=0.1)
    assert high[:2] == pytest.approx(asked.max(axis=0), abs=0.1)


@pytest.mark.parametrize("size", [36.0, 40.5, 44.0])
def test_shoe_size_gives_the_length_in_paris_points(plate: Foot, size: float) -> None:
    points = curve(plate, Outline(source="shoe_size", shoe_size_eu=size))
    assert np.ptp(points[:, 1]) == pytest.approx(size * 20 / 3, abs=0.05)


def test_a_drawn_outline_runs_through_its_points(plate: Foot) -> None:
    begun = outline_points(plate, Outline(), {})
    points = curve(plate, Outline(source="drawn", points_mm=begun))
    for place in begun:
        assert np.hypot(*(points - place).T).min() < 1e-9
    assert points == pytest.approx(curve(plate, Outline()), abs=1e-9)


def test_an_outline_that_crosses_itself_between_its_points_is_refused() -> None:
    # The polygon through the points does not cross itself, the curve does.
    points = ((0.0, 0.0), (40.0, 0.0), (40.0, 100.0), (1.0, 100.0), (0.5, 3.0), (0.0, 100.0))
    drawn = Outline(source="drawn", points_mm=points)
    with pytest.raises(DesignError, match="crosses itself"):
        check_design(InsoleDesign(Side.LEFT, outline=drawn))
