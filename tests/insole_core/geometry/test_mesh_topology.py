"""How vertices are joined: on two triangles, and after they were moved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh

# A square of two triangles, a fifth vertex that nothing joins.
CORNERS = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [9, 9, 9]], dtype=float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)


@pytest.fixture
def square() -> TriangleMesh:
    return TriangleMesh(CORNERS, TRIANGLES)


def test_edges_with_their_triangles(square: TriangleMesh) -> None:
    ends, sharing = square.links.edges
    assert ends.tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert sharing.tolist() == [1, 2, 1, 1, 1]


def test_the_border_runs_as_its_triangles_do(square: TriangleMesh) -> None:
    assert square.links.ends.tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert square.links.is_boundary.tolist() == [True, True, True, True, False]


def test_the_laplacian_points_to_the_mean_of_the_neighbours(square: TriangleMesh) -> None:
    mean = square.links.laplacian @ CORNERS + CORNERS
    np.testing.assert_allclose(mean[0], [4 / 3, 4 / 3, 0])
    np.testing.assert_allclose(mean[1], [1, 1, 0])
    np.testing.assert_allclose(square.links.mean @ CORNERS, mean)
    np.testing.assert_allclose(mean[4], 0)


def test_a_moved_mesh_is_joined_alike_and_has_its_own_normals(square: TriangleMesh) -> None:
    assert square.vertex_normals[0].tolist() == [0, 0, 1]
    links = square.links
    upright = square.moved(CORNERS[:, [0, 2, 1]])
    assert upright.links is links
    assert upright.vertex_normals[0].tolist() == [0, -1, 0]


def test_a_dressed_mesh_keeps_what_is_known_of_its_surface(square: TriangleMesh) -> None:
    red = np.tile(np.array([200, 0, 0], np.uint8), (5, 1))
    normals = square.vertex_normals
    dressed = square.with_attributes(colors=red)
    assert dressed.colors is red
    assert dressed.vertex_normals is normals
    assert square.colors is None
    assert replace(dressed, vertices=2 * CORNERS).vertex_areas[1] == pytest.approx(8 / 3)
