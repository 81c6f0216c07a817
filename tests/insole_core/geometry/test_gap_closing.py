"""Gaps are closed from their tips, and walls that face each other stay apart."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_boundary import gap_triangles


def sheet(points: FloatArray) -> TriangleMesh:
    """A grid (rows, columns, 3) of points as a mesh that faces up."""
    index = np.arange(points[..., 0].size, dtype=np.int32).reshape(points.shape[:2])
    a, b, c, d = (
        part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    )
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return TriangleMesh(points.reshape(-1, 3), triangles)


def flat(size_mm: int) -> TriangleMesh:
    x, y = np.meshgrid(np.arange(size_mm + 1.0), np.arange(size_mm + 1.0))
    return sheet(np.stack([x, y, 0 * x], axis=-1))


def without(mesh: TriangleMesh, gone: BoolArray) -> TriangleMesh:
    return mesh.part(~gone)


def closed(mesh: TriangleMesh, width_mm: float) -> TriangleMesh:
    added = gap_triangles(mesh, np.full(len(mesh.vertices), width_mm))
    return TriangleMesh(mesh.vertices, np.concatenate([mesh.triangles, added]))


def test_a_small_hole_is_closed_and_a_large_one_stays() -> None:
    mesh = flat(40)
    x, y, _ = mesh.vertices.T
    small, large = np.hypot(x - 10, y - 10) < 1.5, np.hypot(x - 28, y - 28) < 6.5
    whole = closed(without(mesh, small | large), 4.0)
    assert whole.area_mm2 > closed(without(mesh, large), 4.0).area_mm2 - 1e-6
    assert 1600 - whole.area_mm2 > 100.0
    assert (whole.links.edges[1] <= 2).all()
    assert (whole.triangle_normals[:, 2] > 0.99).all()


def test_an_inlet_is_closed_to_the_boundary() -> None:
    mesh = flat(30)
    x, y, _ = mesh.vertices.T
    notched = without(mesh, (np.abs(x - 15) < 1.5) & (y < 20))
    whole = closed(notched, 5.0)
    assert notched.area_mm2 < 900 - 60
    assert whole.area_mm2 > 900 - 8


def test_walls_that_face_each_other_stay_apart() -> None:
    along, up = np.meshgrid(np.arange(31.0), np.arange(11.0))
    left = sheet(np.stack([0 * along, along, up], axis=-1))
    right = left.moved(left.vertices + np.array([2.0, 0.0, 0.0])).flipped()
    both = TriangleMesh(
        np.concatenate([left.vertices, right.vertices]),
        np.concatenate([left.triangles, right.triangles + np.int32(len(left.vertices))]),
    )
    assert len(gap_triangles(both, np.full(len(both.vertices), 4.0))) == 0


def test_a_closed_surface_has_no_gap() -> None:
    tetrahedron = TriangleMesh(
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32),
    )
    assert len(gap_triangles(tetrahedron, np.full(4, 10.0))) == 0
