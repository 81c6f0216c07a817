"""Pose and measures come from the surface: other triangles of the same surface change nothing."""

from __future__ import annotations

from collections.abc import Callable

import manifold3d
import numpy as np
import pytest
import trimesh

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import DEFINITIONS, doubts, measure
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import inverse, transform

MOST = {"mm": 0.2, "degrees": 0.2, "": 0.01}
SIZES = ("shoe_size_eu", "shoe_size_uk", "shoe_size_us", "mondopoint")  # rounded


def subdivided(mesh: TriangleMesh) -> TriangleMesh:
    vertices, triangles = trimesh.remesh.subdivide(mesh.vertices, mesh.triangles)
    return TriangleMesh(np.asarray(vertices), np.asarray(triangles, np.int32))


def split(mesh: TriangleMesh) -> TriangleMesh:
    """Three triangles for each one, of all shapes."""
    weights = np.random.default_rng(1).dirichlet([1, 1, 1], len(mesh.triangles))
    inner = np.einsum("mk,mkc->mc", weights, mesh.vertices[mesh.triangles])
    number = np.arange(len(inner)) + len(mesh.vertices)
    a, b, c = mesh.triangles.T
    parts = [
        np.stack(corners, axis=1) for corners in ((a, b, number), (b, c, number), (c, a, number))
    ]
    return TriangleMesh(
        np.concatenate([mesh.vertices, inner]), np.concatenate(parts).astype(np.int32)
    )


def solid(mesh: TriangleMesh) -> manifold3d.Manifold:
    return manifold3d.Manifold(
        manifold3d.Mesh64(mesh.vertices.astype(np.float64), mesh.triangles.astype(np.uint64))
    )


def triangles_of(body: manifold3d.Manifold) -> TriangleMesh:
    mesh = body.to_mesh64()
    return TriangleMesh(np.array(mesh.vert_properties[:, :3]), np.array(mesh.tri_verts, np.int32))


def decimated(mesh: TriangleMesh) -> TriangleMesh:
    fewer = triangles_of(solid(mesh).simplify(0.05))
    assert len(fewer.triangles) < 0.75 * len(mesh.triangles)
    return fewer


def remeshed(mesh: TriangleMesh) -> TriangleMesh:
    return triangles_of(solid(mesh).simplify(0.01).refine_to_length(2.3))


Remesh = Callable[[TriangleMesh], TriangleMesh]
OPEN: list[Remesh] = [subdivided, split]
COARSER: list[Remesh] = [decimated, remeshed]
CLOSED: list[Remesh] = [*OPEN, *COARSER]


def check_same(foot: Foot, again: Foot) -> None:
    moved = transform(again.source2insole @ inverse(foot.source2insole), foot.mesh.vertices)
    assert np.abs(moved - foot.mesh.vertices).max() < 0.2
    assert again.length_mm == pytest.approx(foot.length_mm, abs=0.2)
    known, got = (measure(one, find_landmarks(one)) for one in (foot, again))
    for name in DEFINITIONS.keys() - set(SIZES):
        assert (got[name] is None) == (known[name] is None), name
        if known[name] is not None:
            assert got[name] == pytest.approx(known[name], abs=MOST[DEFINITIONS[name].unit]), name


@pytest.mark.parametrize("remesh", CLOSED)
def test_triangles_of_a_simulated_foot_do_not_matter(
    left_mesh: TriangleMesh, left_foot: Foot, remesh: Remesh
) -> None:
    check_same(left_foot, place_foot(remesh(left_mesh), Side.LEFT, frame="reference"))


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize(("side", "remesh"), list(zip(Side, COARSER, strict=True)))
def test_triangles_of_a_real_foot_do_not_matter(
    scanned_mesh: Callable[[str], TriangleMesh],
    real_foot: Callable[[str, Side], Foot],
    side: Side,
    remesh: Remesh,
) -> None:
    name = f"dupontgu/{side}_foot.stl"
    check_same(real_foot(name, side), place_foot(remesh(scanned_mesh(name)), side, frame="unknown"))


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize("remesh", OPEN)
def test_triangles_of_a_real_plantar_scan_do_not_matter(
    scanned_mesh: Callable[[str], TriangleMesh],
    real_foot: Callable[[str, Side], Foot],
    remesh: Remesh,
) -> None:
    name = "plantar_scan.obj"
    again = place_foot(remesh(scanned_mesh(name)), Side.RIGHT, frame="unknown")
    check_same(real_foot(name, Side.RIGHT), again)


def coarse(mesh: TriangleMesh) -> TriangleMesh:
    """A few hundred triangles: vertices merged in cells of 20 mm."""
    cells, cell = np.unique(np.floor(mesh.vertices / 20), axis=0, return_inverse=True)
    sums = [np.bincount(cell, column, minlength=len(cells)) for column in mesh.vertices.T]
    means = np.stack(sums, axis=1) / np.bincount(cell)[:, None]
    triangles = cell[mesh.triangles].astype(np.int32)
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return TriangleMesh(means, triangles[whole])


def coarse_subdivided(mesh: TriangleMesh) -> TriangleMesh:
    return subdivided(subdivided(coarse(mesh)))


@pytest.mark.parametrize("remesh", [coarse, coarse_subdivided])
def test_a_surface_too_coarse_lowers_the_confidence(
    left_mesh: TriangleMesh, left_foot: Foot, remesh: Remesh
) -> None:
    found = find_landmarks(place_foot(remesh(left_mesh), Side.LEFT, frame="reference"))
    for name in ("heel_medial", "heel_lateral"):
        assert find_landmarks(left_foot)[name].confidence > 0.9
        assert found[name].confidence < 0.5
    assert "too coarse" in doubts(found)["heel_width"]
    assert doubts(find_landmarks(left_foot)) == {}
