"""Insole, mould and block: closed, in their frame, as the design says."""

from __future__ import annotations

from dataclasses import replace

import manifold3d
import numpy as np
import pytest
from scipy.spatial import KDTree

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import (
    KINDS,
    SolidOptions,
    insole_solid,
    make_solid,
    positive_solid,
)

PAD = Pelott(centre_mm=(5.2, 150.3), height_mm=5)


@pytest.fixture(scope="module")
def insole(left_foot: Foot) -> Insole:
    design = InsoleDesign(Side.LEFT, (PAD, Posting(rearfoot_deg=3)))
    return build_insole(left_foot, design)


@pytest.fixture(scope="module")
def coarse(insole: Insole) -> Insole:
    return build_insole(insole.foot, replace(insole.design, grid_mm=2.0))


def manifold_of(mesh: TriangleMesh) -> manifold3d.Manifold:
    return manifold3d.Manifold(
        manifold3d.Mesh(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32))
    )


def check_manifold(mesh: TriangleMesh) -> None:
    assert mesh.is_closed
    solid = manifold_of(mesh)
    assert solid.status() == manifold3d.Error.NoError
    assert solid.volume() == pytest.approx(mesh.volume_mm3, rel=1e-3)
    assert mesh.volume_mm3 > 0


@pytest.mark.slow
@pytest.mark.parametrize("draft_deg", [-8, 0, 3, 25])
@pytest.mark.parametrize("bottom", ["flat", "following"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_solid_is_a_manifold(coarse, kind, bottom, draft_deg):
    shaped = replace(coarse, design=replace(coarse.design, bottom=bottom))
    check_manifold(make_solid(shaped, kind, SolidOptions(draft_deg=draft_deg, chamfer_mm=1)))


def test_mould_fills_the_insole(insole):
    """Turned back, the mould's sole lies on the insole's contact surface."""
    mould = positive_solid(insole, SolidOptions(draft_deg=0))
    turned = mould.vertices * [-1, 1, -1]
    level = insole.contact.heights_mm.max() + SolidOptions().mould_base_mm
    places = turned[turned[:, 2] < 0] + [0, 0, level]
    nodes = np.isclose(places[:, :2] % 1, 0, atol=1e-9).all(axis=1) | np.isclose(
        places[:, :2] % 1, 1, atol=1e-9
    ).all(axis=1)
    expected = insole.contact.height_at(places[nodes, :2])
    assert nodes.sum() > 10_000
    np.testing.assert_allclose(places[nodes, 2], expected, rtol=0, atol=1e-9)
    assert mould.bounds_mm[0, 2] == 0


def test_pelott_is_a_hollow_in_the_mould_on_the_other_side(insole):
    without = replace(insole.design, corrections=insole.design.corrections[1:])
    plain = build_insole(insole.foot, without)
    place = np.array([-PAD.centre_mm[0], PAD.centre_mm[1]])
    heights = []
    for one in (insole, plain):
        mould = positive_solid(one)
        top = mould.vertices[mould.vertices[:, 2] > 0]
        nearest = np.argmin(np.linalg.norm(top[:, :2] - place, axis=1))
        heights.append(top[nearest, 2] - one.contact.heights_mm.max())
    assert heights[0] - heights[1] == pytest.approx(-PAD.height_mm, abs=0.3)


def test_apex_is_a_vertex(insole):
    mesh = insole_solid(insole)
    at = np.linalg.norm(mesh.vertices[:, :2] - PAD.centre_mm, axis=1)
    assert at.min() < 1e-9


def test_walls_lean_by_the_draft(insole):
    square = np.array([(-20.0, 60), (20, 60), (20, 160), (-20, 160)])
    for draft in (0, 10, 20):
        mesh = insole_solid(insole, SolidOptions(draft_deg=draft), square)
        floor = mesh.vertices[mesh.vertices[:, 2] == 0]
        side = np.abs(floor[:, 1] - 110.0) < 0.6
        height = insole.contact.height_at(np.array([20.0, 110.0]))
        lean = height * np.tan(np.radians(draft))
        assert floor[side, 0].max() - 20 == pytest.approx(lean, abs=0.15)


def test_rim_is_bevelled(insole):
    square = np.array([(-20.0, 60), (20, 60), (20, 160), (-20, 160)])
    plain, bevelled = (
        insole_solid(insole, SolidOptions(0, chamfer), square) for chamfer in (0.0, 3.0)
    )
    lowered = (plain.vertices - bevelled.vertices)[:, 2]
    inside = 20 - np.abs(plain.vertices[:, 0])
    middle = (np.abs(plain.vertices[:, 1] - 110) < 30) & (plain.vertices[:, 2] > 0)
    bevel = np.clip(3 - inside[middle], 0, None)
    np.testing.assert_allclose(lowered[middle], bevel, rtol=0, atol=0.05)


@pytest.mark.slow
def test_following_bottom_keeps_the_thickness_everywhere(insole):
    design = replace(insole.design, bottom="following", thickness_mm=4.0)
    shell = build_insole(insole.foot, design)
    mesh = insole_solid(shell, SolidOptions(draft_deg=0))
    top = shell.contact.nodes
    below = mesh.vertices[len(mesh.vertices) // 2 :]
    some = below[:: len(below) // 200]
    gaps, _ = KDTree(top).query(some)
    assert gaps.min() >= 4.0 - 0.1  # on a grid of 1 mm
    assert np.median(gaps) < 4.3


@pytest.mark.parametrize(
    ("outline", "sentence"),
    [
        ([(0, 100), (5, 100), (5, 105)], "leaves no insole"),
        ([(500, 0), (600, 0), (600, 200), (500, 200)], "lies beside the foot"),
    ],
)
def test_outline_that_leaves_no_insole(insole, outline, sentence):
    with pytest.raises(DesignError, match=sentence):
        insole_solid(insole, outline=np.array(outline, float))


def test_jagged_outline_beyond_the_surface_still_gives_a_solid(insole):
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    radius = np.where(np.arange(60) % 2, 170, 60)[:, None]
    star = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1) + [0, 120]
    check_manifold(insole_solid(insole, SolidOptions(draft_deg=25), star))


@pytest.mark.parametrize("key", ["draft_deg", "chamfer_mm", "mould_base_mm"])
def test_options_out_of_range(key):
    with pytest.raises(DesignError, match=key):
        SolidOptions(**{key: 300})
    with pytest.raises(DesignError, match=key):
        SolidOptions(**{key: float("nan")})
