"""Where the insole ends: the allowances, the shoe's size and the drawn curve act to the number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks, with_places
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.outline.insole_outline import insole_outline, outline_points
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.outline_curve import crosses_itself
from insole_core.solids.solid import SolidOptions, insole_solid

LENGTH_MM, HALF_WIDTH_MM = 250.0, 40.0
NONE = Outline(toe_allowance_mm=0, ball_allowance_mm=0, heel_allowance_mm=0)


@pytest.fixture(scope="module")
def plate() -> Foot:
    """A flat sole of 80 × 250 mm with round ends."""
    y = LENGTH_MM / 2 * (1 - np.cos(np.linspace(0, np.pi, 126)))
    to_end = np.minimum(np.minimum(y, LENGTH_MM - y), HALF_WIDTH_MM)
    half = np.sqrt(HALF_WIDTH_MM**2 - (HALF_WIDTH_MM - to_end) ** 2)
    x = np.column_stack([-half, half])
    vertices = np.stack([x.ravel(), np.repeat(y, 2), np.zeros(x.size)], axis=1)
    row = 2 * np.arange(125, dtype=np.int32)[:, None]
    triangles = np.concatenate([row + np.array(corners) for corners in ((0, 2, 1), (1, 2, 3))])
    return Foot(Side.LEFT, TriangleMesh(vertices, triangles.astype(np.int32)), np.eye(4), LENGTH_MM)


def curve(foot: Foot, outline: Outline) -> np.ndarray:
    return insole_outline(foot, InsoleDesign(foot.side, outline=outline), {})


def half_width(foot: Foot, outline: Outline, low_mm: float, high_mm: float) -> float:
    """Of the curve between two distances from the heel."""
    places = curve(foot, outline)
    return float(np.median(np.abs(places[(places[:, 1] > low_mm) & (places[:, 1] < high_mm), 0])))


@pytest.mark.parametrize("toes", [-5.0, 0.0, 5.0, 15.0, 30.0])
def test_toe_allowance_lengthens_the_insole_by_itself(plate: Foot, toes: float) -> None:
    longest = curve(plate, replace(NONE, toe_allowance_mm=toes))[:, 1].max()
    assert longest == pytest.approx(LENGTH_MM + toes, abs=0.05)


@pytest.mark.parametrize("heel", [0.0, 2.0, 6.0])
def test_heel_allowance_acts_behind_and_beside_the_heel(plate: Foot, heel: float) -> None:
    outline = replace(NONE, heel_allowance_mm=heel)
    assert curve(plate, outline)[:, 1].min() == pytest.approx(-heel, abs=0.05)
    assert half_width(plate, outline, 40, 70) == pytest.approx(HALF_WIDTH_MM + heel, abs=1.5)
    assert half_width(plate, outline, 160, 190) == pytest.approx(HALF_WIDTH_MM, abs=1.5)


@pytest.mark.parametrize("ball", [-3.0, 2.0, 12.0])
def test_ball_allowance_acts_on_both_sides_of_the_ball(plate: Foot, ball: float) -> None:
    outline = replace(NONE, ball_allowance_mm=ball)
    assert half_width(plate, outline, 40, 70) == pytest.approx(HALF_WIDTH_MM, abs=1.5)
    assert half_width(plate, outline, 160, 190) == pytest.approx(HALF_WIDTH_MM + ball, abs=1.5)


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


def test_a_drawn_outline_begins_as_it_was(plate: Foot) -> None:
    begun = outline_points(plate, InsoleDesign(plate.side), {})
    points = curve(plate, Outline(source="drawn", points_mm=begun))
    for place in begun:
        assert np.hypot(*(points - place).T).min() < 1e-9
    assert np.abs(outwards(curve(plate, Outline()), points)).max() < 0.3


def test_an_outline_that_crosses_itself_between_its_points_is_refused() -> None:
    # The polygon through the points does not cross itself, the curve does.
    points = ((0.0, 0.0), (40.0, 0.0), (40.0, 100.0), (1.0, 100.0), (0.5, 3.0), (0.0, 100.0))
    drawn = Outline(source="drawn", points_mm=points)
    with pytest.raises(DesignError, match="crosses itself"):
        check_design(InsoleDesign(Side.LEFT, outline=drawn))


@pytest.fixture(scope="module", params=["left_foot", "right_foot"])
def foot(request: pytest.FixtureRequest) -> Foot:
    found: Foot = request.getfixturevalue(request.param)
    return found


@pytest.fixture(params=["full", "three_quarter"])
def extent(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def marked(foot: Foot, outline: Outline) -> np.ndarray:
    return insole_outline(foot, InsoleDesign(foot.side, outline=outline), find_landmarks(foot))


def outwards(curve: np.ndarray, places: np.ndarray) -> np.ndarray:
    """How far places lie outside a dense closed curve, mm; inside < 0."""
    nearest = cKDTree(curve).query(places)[1]
    along = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    outside = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]
    return np.asarray(((places - curve[nearest]) * outside[nearest]).sum(axis=1))


def curvature(curve: np.ndarray) -> np.ndarray:
    """Per mm, > 0 where a counter-clockwise curve bends outwards."""
    slope = (np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)) / 2
    bend = np.roll(curve, -1, axis=0) - 2 * curve + np.roll(curve, 1, axis=0)
    cross = slope[:, 0] * bend[:, 1] - slope[:, 1] * bend[:, 0]
    return np.asarray(cross / np.hypot(*slope.T) ** 3)


@pytest.mark.parametrize(("ball", "toes"), [(2.0, 5.0), (0.0, 0.0), (8.0, 15.0)])
def test_it_is_fair(foot: Foot, extent: str, ball: float, toes: float) -> None:
    line = marked(foot, Outline(extent=extent, ball_allowance_mm=ball, toe_allowance_mm=toes))
    bend, share = curvature(line), line[:, 1] / foot.length_mm
    turns = np.flatnonzero(np.sign(bend) != np.sign(np.roll(bend, 1)))
    assert len(turns) <= 4, "it turns from round to hollow at either waist at most"
    assert ((share[turns] > 0.18) & (share[turns] < 0.65)).all()
    assert bend.max() < (1 / 16 if extent == "full" else 1 / 9), "no corner"
    assert bend.min() > -1 / 40, "no notch"
    way_mm = np.hypot(*(np.roll(line, -1, axis=0) - line).T)
    assert (np.abs(np.roll(bend, -1) - bend) / way_mm).max() < 0.01, "no kink"


def test_it_holds_the_print_with_its_allowances(foot: Foot) -> None:
    vertices = foot.mesh.vertices
    line = marked(foot, Outline(heel_allowance_mm=4, ball_allowance_mm=4, toe_allowance_mm=8))
    print_mm = vertices[vertices[:, 2] < 3.0]
    assert outwards(line, print_mm[:, :2]).max() < -2.5
    border = vertices[vertices[:, 2] < 20.0]
    assert outwards(line, border[:, :2]).max() < 0.0


def test_the_mirrored_foot_has_the_mirrored_outline(
    left_foot: Foot, right_foot: Foot, extent: str
) -> None:
    left, right = (marked(foot, Outline(extent=extent)) for foot in (left_foot, right_foot))
    assert np.abs(outwards(left * [-1, 1], right)).max() < 1e-3
    assert right[0] * [-1, 1] == pytest.approx(left[0], abs=1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_noise_of_the_scan_hardly_moves_it(left_foot: Foot, extent: str, seed: int) -> None:
    marks = find_landmarks(left_foot)
    noise = np.random.default_rng(seed).normal(0, 0.5, left_foot.mesh.vertices.shape)
    rough = replace(left_foot.mesh, vertices=left_foot.mesh.vertices + noise)
    design = InsoleDesign(left_foot.side, outline=Outline(extent=extent))
    calm = insole_outline(left_foot, design, marks)
    moved = outwards(calm, insole_outline(replace(left_foot, mesh=rough), design, marks))
    assert np.abs(moved).max() < 0.5


def test_the_short_one_ends_behind_all_heads(foot: Foot) -> None:
    marks = find_landmarks(foot)
    heads = np.array([marks[name].point[:2] for name in HEADS])
    ahead = outwards(marked(foot, Outline(extent="three_quarter")), heads)
    assert ahead.min() == pytest.approx(8.0, abs=4.0)


@pytest.mark.parametrize(("name", "place"), [
    ("metatarsal_head_1", (-30.0, 90.0, 0.0)),
    ("metatarsal_head_5", (0.0, 400.0, 0.0)),
    ("metatarsal_head_3", (0.0, -50.0, 0.0)),
])  # fmt: skip
def test_heads_put_to_odd_places_still_give_an_outline(
    left_foot: Foot, name: str, place: tuple[float, float, float]
) -> None:
    marks = with_places(left_foot, find_landmarks(left_foot), {name: place})
    design = InsoleDesign(left_foot.side, outline=Outline(extent="three_quarter"))
    line = insole_outline(left_foot, design, marks)
    assert not crosses_itself(line[::4])
    assert np.ptp(line[:, 1]) > left_foot.length_mm / 4


@pytest.mark.shared
@pytest.mark.parametrize("extent", ["full", "three_quarter"])
def test_it_is_fair_about_a_real_sole(real_foot: Callable[[str, Side], Foot], extent: str) -> None:
    foot = real_foot("plantar_scan.obj", Side.RIGHT)
    bend = curvature(marked(foot, Outline(extent=extent)))
    assert (np.sign(bend) != np.sign(np.roll(bend, 1))).sum() <= 4
    assert bend.max() < (1 / 16 if extent == "full" else 1 / 9)
