from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.simulate import FootModel, FootShape, build_foot
from insole_core.simulate.foot_shape import vary_shape

from .conftest import COARSE_MM

MIRROR = np.array([-1.0, 1.0, 1.0])


def _build(shape: FootShape) -> FootModel:
    return build_foot(shape, np.random.default_rng(3), COARSE_MM)


def _heel_width_mm(foot: FootModel) -> float:
    vertices = foot.mesh.vertices
    share = vertices[:, 1] / foot.shape.length_mm + 0.5
    heel = vertices[(share > 0.1) & (share < 0.22) & (vertices[:, 2] < 30)]
    return float(np.ptp(heel[:, 0]))


def _arch_height_mm(foot: FootModel) -> float:
    """Highest point of the sole on the line from the heel to the first head."""
    heel, head = (foot.landmarks_mm[name] for name in ("pternion", "metatarsal_head_1"))
    points = heel + np.linspace(0.15, 0.9, 40)[:, None] * (head - heel)
    points[:, 2] = -50
    mesh = trimesh.Trimesh(foot.mesh.vertices, foot.mesh.triangles, process=False)
    places, _, _ = mesh.ray.intersects_location(
        points, np.tile([0.0, 0.0, 1.0], (40, 1)), multiple_hits=False
    )
    return float(places[:, 2].max())


def test_the_foot_stands_in_the_reference_frame(left_foot: FootModel) -> None:
    low, high = left_foot.mesh.vertices.min(0), left_foot.mesh.vertices.max(0)

    np.testing.assert_allclose([low[1], high[1]], [-122.5, 122.5], atol=1e-9)
    assert low[2] == pytest.approx(0, abs=1e-9)
    assert 175 < high[2] < 190


def test_the_surface_is_closed_and_faces_outwards(left_foot: FootModel) -> None:
    assert left_foot.mesh.is_closed
    assert 0.7e6 < left_foot.mesh.volume_mm3 < 1.4e6


def test_the_default_surface_is_fine_enough_to_show_a_pen_mark() -> None:
    foot = build_foot(FootShape(), np.random.default_rng(1))

    assert 70_000 < len(foot.mesh.triangles) < 150_000
    colors = foot.mesh.colors
    assert colors is not None
    inked = colors.astype(int).sum(axis=1) < 150
    assert 30 < inked.sum() < 2000
    assert (foot.mesh.vertices[inked, 2] < 25).all()


def test_the_right_foot_is_the_mirror_image_of_the_left_one(left_foot: FootModel) -> None:
    right = _build(replace(left_foot.shape, side=Side.RIGHT))

    np.testing.assert_array_equal(right.mesh.vertices, left_foot.mesh.vertices * MIRROR)
    np.testing.assert_array_equal(right.mesh.colors, left_foot.mesh.colors)
    for name, point in left_foot.landmarks_mm.items():
        np.testing.assert_array_equal(right.landmarks_mm[name], point * MIRROR)
    assert right.mesh.volume_mm3 == pytest.approx(left_foot.mesh.volume_mm3)


def test_the_big_toe_is_on_the_medial_side(left_foot: FootModel) -> None:
    toes = np.array([left_foot.landmarks_mm[f"toe_tip_{number}"] for number in range(1, 6)])

    assert (np.diff(toes[:, 0]) < 0).all(), "medial is +x for a left foot"
    assert toes[0, 0] > 15 > -15 > toes[4, 0]


def test_the_toe_tips_lie_on_the_surface(left_foot: FootModel) -> None:
    tips = np.array([left_foot.landmarks_mm[f"toe_tip_{number}"] for number in range(1, 6)])
    distance = np.linalg.norm(left_foot.mesh.vertices[None] - tips[:, None], axis=2).min(axis=1)

    assert distance.max() < 3.0


def test_the_toes_are_apart(left_foot: FootModel) -> None:
    """Between neighbouring toes there is air: a row of points across them leaves the foot."""
    mesh = trimesh.Trimesh(left_foot.mesh.vertices, left_foot.mesh.triangles, process=False)
    tips = [left_foot.landmarks_mm[f"toe_tip_{number}"] for number in range(1, 6)]
    for inner, outer in pairwise(tips):
        y = min(inner[1], outer[1]) - 6.0
        x = np.linspace(inner[0], outer[0], 40)
        points = np.stack([x, np.full(40, y), np.full(40, 9.0)], axis=1)
        inside = mesh.contains(points)
        assert inside[0]
        assert inside[-1]
        assert not inside.all()


@pytest.mark.parametrize(
    "shape",
    [
        FootShape(),
        FootShape(length_mm=270, ball_width_mm=105, heel_width_mm=72, arch_height_mm=28),
        FootShape(length_mm=215, ball_width_mm=82, heel_width_mm=56, arch_height_mm=12),
    ],
)
def test_the_measures_are_those_asked_for(shape: FootShape) -> None:
    foot = _build(shape)
    inner, outer = (
        foot.landmarks_mm[name] for name in ("metatarsale_tibiale", "metatarsale_fibulare")
    )

    assert np.ptp(foot.mesh.vertices[:, 1]) == pytest.approx(shape.length_mm, abs=1e-6)
    assert np.linalg.norm(inner - outer) == pytest.approx(shape.ball_width_mm, abs=2.0)
    assert _heel_width_mm(foot) == pytest.approx(shape.heel_width_mm, abs=2.0)
    assert _arch_height_mm(foot) == pytest.approx(shape.arch_height_mm, abs=2.0)


def test_an_everted_heel_leans_medially_going_up() -> None:
    shape = FootShape(rearfoot_eversion_deg=8.0)
    everted, neutral = _build(shape), _build(replace(shape, rearfoot_eversion_deg=0.0))

    assert _lean_deg(everted) - _lean_deg(neutral) == pytest.approx(8.0, abs=1.0)


def _lean_deg(foot: FootModel) -> float:
    """Inclination of the line through the middle of the heel, heights 15 to 45 mm, from behind."""
    mesh = trimesh.Trimesh(foot.mesh.vertices, foot.mesh.triangles, process=False)
    rear_mm = foot.mesh.vertices[:, 1].min() + 22
    heights = np.arange(15, 46, 5)
    middles = []
    for height in heights:
        outline = trimesh.intersections.mesh_plane(mesh, [0, 0, 1], [0, 0, height]).reshape(-1, 3)
        x = outline[outline[:, 1] < rear_mm, 0]
        middles.append((x.min() + x.max()) / 2)
    return float(np.degrees(np.arctan(np.polyfit(heights, middles, 1)[0])))


def test_the_heel_is_redder_than_the_arch(left_foot: FootModel) -> None:
    mesh = left_foot.mesh
    assert mesh.colors is not None
    plantar = mesh.vertex_normals[:, 2] < -0.8
    y = mesh.vertices[:, 1]
    redness = mesh.colors[:, 0].astype(float) - mesh.colors[:, 1]

    assert redness[plantar & (y < -75)].mean() > redness[plantar & (abs(y) < 20)].mean() + 8


@pytest.mark.slow
@settings(max_examples=5, deadline=None)
@given(st.integers(0, 10_000))
def test_every_drawn_foot_is_closed(seed: int) -> None:
    rng = np.random.default_rng(seed)

    assert build_foot(vary_shape(rng, Side.LEFT), rng, 5.0).mesh.is_closed


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"length_mm": 24.5}, "length"),
        ({"arch_height_mm": float("nan")}, "arch height"),
        ({"rearfoot_eversion_deg": 40.0}, "eversion"),
    ],
)
def test_a_shape_that_is_none_of_a_foot_is_refused(values: dict[str, float], words: str) -> None:
    with pytest.raises(UsageError, match=f"{words}.*choose a value from"):
        FootShape(**values)
