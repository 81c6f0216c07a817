"""Thinning keeps the surface, its sides and its colours."""

from __future__ import annotations

import numpy as np
import trimesh

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_resolution import thinned

RADIUS_MM = 30.0


def sphere(subdivisions: int = 6) -> TriangleMesh:
    ball = trimesh.creation.icosphere(subdivisions, RADIUS_MM)
    return TriangleMesh(np.asarray(ball.vertices), ball.faces.astype(np.int32))


def sheet(height_mm: float, *, facing_up: bool) -> TriangleMesh:
    x, y = np.meshgrid(np.arange(0, 20, 0.25), np.arange(0, 20, 0.25))
    corner = np.arange(x.size).reshape(x.shape)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    triangles = np.stack([[a, b, c], [a, c, d]]).transpose(0, 2, 3, 1).reshape(-1, 3)
    mesh = TriangleMesh(
        np.column_stack([x.ravel(), y.ravel(), np.full(x.size, height_mm)]),
        triangles.astype(np.int32),
    )
    return mesh if facing_up else mesh.flipped()


def test_a_thinned_sphere_stays_a_closed_sphere():
    thin = thinned(sphere(), 2.0)
    assert len(thin.triangles) < len(sphere().triangles) / 6
    assert thin.is_closed
    assert thin.volume_mm3 > 0
    radius = np.linalg.norm(thin.vertices, axis=1)
    assert radius.min() > RADIUS_MM - 0.05
    assert radius.max() < RADIUS_MM + 0.01


def test_every_vertex_of_a_thinned_mesh_has_a_triangle():
    thin = thinned(sphere(), 2.0)
    assert set(np.unique(thin.triangles)) == set(range(len(thin.vertices)))


def test_two_skins_that_nearly_touch_are_not_welded():
    lower, upper = sheet(0.0, facing_up=True), sheet(0.2, facing_up=False)
    both = TriangleMesh(
        np.concatenate([lower.vertices, upper.vertices]),
        np.concatenate([lower.triangles, upper.triangles + len(lower.vertices)]),
    )
    thin = thinned(both, 1.0)
    assert set(np.unique(np.round(thin.vertices[:, 2], 6))) == {0.0, 0.2}


def test_colours_are_averaged():
    mesh = sheet(0.0, facing_up=True)
    red = np.where(mesh.vertices[:, 0] < 10, 200, 100).astype(np.uint8)
    painted = mesh.with_attributes(colors=np.column_stack([red, red * 0, red * 0 + 7]))
    thin = thinned(painted, 1.0)
    assert thin.colors is not None
    assert set(np.unique(thin.colors[thin.vertices[:, 0] < 9, 0])) == {200}
    assert set(np.unique(thin.colors[thin.vertices[:, 0] > 11, 0])) == {100}
    assert (thin.colors[:, 2] == 7).all()
