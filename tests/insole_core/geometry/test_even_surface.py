"""Evenly spread points of a surface: where they lie, and that triangles do not matter."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.transforms import rigid, rotation_about

RADIUS = 20.0


def ball(subdivisions: int) -> TriangleMesh:
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions, radius=RADIUS)
    return TriangleMesh(np.array(sphere.vertices), np.array(sphere.faces, np.int32))


@pytest.mark.parametrize("subdivisions", [4, 5, 6])
def test_points_lie_evenly_on_the_surface_with_its_normals(subdivisions: int) -> None:
    mesh = ball(subdivisions)
    even = EvenSurface.of(mesh)
    distance = np.linalg.norm(even.points, axis=1)
    assert distance == pytest.approx(RADIUS, abs=0.1)
    outwards = even.points / distance[:, None]
    assert np.einsum("nc,nc->n", even.normals, outwards).min() > 0.99
    assert even.area_mm2.sum() == pytest.approx(mesh.area_mm2, rel=0.02)
    assert len(even.points) == pytest.approx(mesh.area_mm2 / 1.5**2, rel=0.6)
    assert np.isinf(even.rim_mm).all()


def test_a_subdivided_surface_has_nearly_the_same_points() -> None:
    mesh = ball(1)
    vertices, triangles = trimesh.remesh.subdivide(mesh.vertices, mesh.triangles)
    fine = TriangleMesh(np.asarray(vertices), np.asarray(triangles, np.int32))
    coarse, again = EvenSurface.of(mesh), EvenSurface.of(fine)
    assert len(again.points) == pytest.approx(len(coarse.points), rel=0.03)
    for direction in np.eye(3):
        reach = [float(np.sort(even.points @ direction)[-9:].mean()) for even in (coarse, again)]
        assert reach[1] == pytest.approx(reach[0], abs=0.05)
    facets = [even.facet_mm2(np.array([0.0, 0.0, RADIUS])) for even in (coarse, again)]
    assert facets[1] == pytest.approx(facets[0], rel=0.3)
    assert facets[0] > EvenSurface.of(ball(5)).facet_mm2(np.array([0.0, 0.0, RADIUS])) + 10


def test_the_rim_of_an_open_surface_is_known() -> None:
    whole = ball(5)
    even = EvenSurface.of(whole.part(whole.vertices[:, 2] < 0.01))
    arc = RADIUS * np.arcsin(np.clip(-even.points[:, 2] / RADIUS, 0, 1))
    near = arc < 8
    assert even.rim_mm[near] == pytest.approx(arc[near], abs=0.8)
    assert (even.rim_mm[arc > 12] == np.inf).all()


def test_walls_that_touch_do_not_mix() -> None:
    plate = trimesh.creation.box((40.0, 40.0, 0.4))
    mesh = TriangleMesh(np.array(plate.vertices), np.array(plate.faces, np.int32))
    even = EvenSurface.of(mesh)  # both faces of the plate lie in the same cells, or nearly
    assert np.linalg.norm(even.normals, axis=1) == pytest.approx(1.0)


def test_points_move_with_their_surface() -> None:
    a2b = rigid(rotation_about(np.array([1.0, 2.0, 0.5]), 40.0), np.array([5.0, -3.0, 1.0]))
    even = EvenSurface.of(ball(4))
    moved = even.transformed(a2b)
    assert moved.points == pytest.approx(even.points @ a2b[:3, :3].T + a2b[:3, 3])
    assert moved.normals == pytest.approx(even.normals @ a2b[:3, :3].T)
    kept = moved.part(moved.points[:, 2] > 0)
    assert 0 < len(kept.points) < len(even.points)


def test_a_surface_far_larger_than_a_foot_takes_larger_cells() -> None:
    mesh = ball(4)
    huge = EvenSurface.of(TriangleMesh(mesh.vertices * 50, mesh.triangles))
    assert len(huge.points) < 500_000
