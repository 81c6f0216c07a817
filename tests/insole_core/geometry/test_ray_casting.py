from __future__ import annotations

import numpy as np

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster

# A floor at z = 100 and a smaller plate before it, at z = 60.
CORNERS = np.array(
    [[0.0, 0, 100], [90, 0, 100], [0, 70, 100], [0, 0, 60], [20, 0, 60], [0, 20, 60]]
)
SCENE = TriangleMesh(CORNERS, np.array([[0, 1, 2], [3, 4, 5]], np.int32))


def test_a_ray_meets_the_nearest_surface_at_the_right_place() -> None:
    origin = np.array([5.0, 4.0, 0.0])
    ways = np.array([[0.0, 0, 1], [0.5, 0.1, 1], [-1, 0, 0]])
    hits = RayCaster(SCENE).cast(origin, ways)
    np.testing.assert_array_equal(hits.ray, [0, 1])
    np.testing.assert_array_equal(hits.triangle, [1, 0])
    place = np.einsum("nk,nkc->nc", hits.weights, CORNERS[SCENE.triangles[hits.triangle]])
    np.testing.assert_allclose(place, [[5, 4, 60], [55, 14, 100]], atol=1e-3)


def test_what_stands_between_blocks_but_the_own_surface_does_not() -> None:
    points = np.array([[4.0, 4, 100], [40, 10, 100], [5, 5, 60]])
    blocked = RayCaster(SCENE).is_blocked(points, np.array([4.0, 4, 0]), 0.5)
    np.testing.assert_array_equal(blocked, [True, False, False])
