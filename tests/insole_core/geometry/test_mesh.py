"""The triangle mesh: known figures of a box."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about


@pytest.fixture
def box() -> TriangleMesh:
    made = trimesh.creation.box((2.0, 3.0, 4.0))
    return TriangleMesh(np.array(made.vertices), np.array(made.faces, np.int32))


def test_box_has_its_volume_and_area(box: TriangleMesh) -> None:
    assert box.volume_mm3 == pytest.approx(24)
    assert box.area_mm2 == pytest.approx(2 * (6 + 8 + 12))
    assert box.is_closed


def test_normals_point_outwards(box: TriangleMesh) -> None:
    centres = box.vertices[box.triangles].mean(axis=1)
    assert (np.einsum("ij,ij->i", box.triangle_normals, centres) > 0).all()
    assert (np.einsum("ij,ij->i", box.vertex_normals, box.vertices) > 0).all()
    np.testing.assert_allclose(np.linalg.norm(box.vertex_normals, axis=1), 1)


def test_flipped_box_has_negative_volume(box: TriangleMesh) -> None:
    assert box.flipped().volume_mm3 == pytest.approx(-24)
    assert box.flipped().is_closed


def test_a_missing_or_turned_triangle_opens_the_box(box: TriangleMesh) -> None:
    assert not TriangleMesh(box.vertices, box.triangles[1:]).is_closed
    turned = box.triangles.copy()
    turned[0] = turned[0, ::-1]
    assert not TriangleMesh(box.vertices, turned).is_closed
    assert not TriangleMesh(box.vertices, box.triangles[:0]).is_closed


def test_moving_keeps_volume_and_colour(box: TriangleMesh) -> None:
    colored = TriangleMesh(box.vertices, box.triangles, np.arange(24, dtype=np.uint8).reshape(8, 3))
    moved = colored.transformed(rigid(rotation_about(np.array([1.0, 2, 3]), 50), np.arange(3.0)))
    assert moved.volume_mm3 == pytest.approx(24)
    assert moved.colors is colored.colors


def test_degenerate_triangle_has_no_normal() -> None:
    mesh = TriangleMesh(np.zeros((3, 3)), np.array([[0, 1, 2]], np.int32))
    np.testing.assert_array_equal(mesh.triangle_normals, 0)
    np.testing.assert_array_equal(mesh.vertex_normals, 0)
