from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.primitives.height_field import HeightField

FIELD = HeightField(-2.0, 10.0, 0.5, np.arange(12.0).reshape(3, 4))


def test_nodes_give_their_own_height():
    xy = FIELD.nodes[:, :2]
    assert FIELD.height_at(xy) == pytest.approx(FIELD.nodes[:, 2])
    assert FIELD.nodes[5] == pytest.approx([-1.5, 10.5, 5.0])


def test_height_between_nodes_is_bilinear():
    # h = 2 (x + 2) + 8 (y - 10) at the nodes
    assert FIELD.height_at(np.array([-1.8, 10.3])) == pytest.approx(0.4 + 2.4)


def test_beyond_the_field_there_is_no_height():
    outside = np.array([[-2.01, 10.2], [-0.49, 10.2], [-1.0, 9.9], [-1.0, 11.1]])
    assert np.isnan(FIELD.height_at(outside)).all()


def test_weights_of_points_give_the_heights_there_whatever_the_nodes_have():
    xy = np.array([[-1.8, 10.3], [-0.5, 11.0], [-2.0, 10.0], [-1.1, 10.9], [-2.01, 10.2]])
    for heights in (FIELD.heights_mm, FIELD.heights_mm**2):
        field = HeightField(-2.0, 10.0, 0.5, heights)
        found = FIELD.weights_at(xy) @ heights.ravel()
        np.testing.assert_allclose(found, field.height_at(xy), atol=1e-12)


def test_mesh_faces_up_and_covers_the_field():
    mesh = TriangleMesh(FIELD.nodes, FIELD.triangles())
    assert len(mesh.triangles) == 2 * 2 * 3
    assert (mesh.triangle_normals[:, 2] > 0).all()
    shadow = TriangleMesh(mesh.vertices * [1, 1, 0], mesh.triangles)
    assert shadow.area_mm2 == pytest.approx(1.5 * 1.0)
