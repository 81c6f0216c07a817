from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sections import (
    ParallelSections,
    boundary_crossings,
    section_segments,
)

TETRAHEDRON = TriangleMesh(
    np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 8.0]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], dtype=np.int32),
)


def test_a_plane_cuts_a_closed_body_in_a_closed_line_of_known_length() -> None:
    segments = section_segments(TETRAHEDRON, np.array([0.0, 0.0, 4.0]), np.array([0.0, 0.0, 1.0]))
    lengths = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    assert len(segments) == 3
    assert lengths.sum() == pytest.approx(2.0 + 3.0 + np.hypot(2.0, 3.0))
    ends, counts = np.unique(np.round(segments.reshape(-1, 3), 9), axis=0, return_counts=True)
    assert len(ends) == 3
    assert (counts == 2).all()


def test_every_point_lies_in_an_oblique_plane_and_on_the_body() -> None:
    normal = np.array([1.0, 2.0, 2.0]) / 3
    origin = np.array([1.0, 1.0, 1.0])
    points = section_segments(TETRAHEDRON, origin, normal).reshape(-1, 3)
    assert (points - origin) @ normal == pytest.approx(0.0, abs=1e-12)
    assert (points >= -1e-12).all()
    assert (points @ [1 / 4, 1 / 6, 1 / 8] <= 1 + 1e-12).all()


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_plane_beside_the_body_cuts_nothing(side: float) -> None:
    origin = np.array([0.0, 0.0, 4.0 + 10 * side])
    assert section_segments(TETRAHEDRON, origin, np.array([0.0, 0.0, 1.0])).shape == (0, 2, 3)


@pytest.mark.parametrize("height", [0.5, 4.0, 7.5])
def test_segments_run_counter_clockwise_round_the_inside(height: float) -> None:
    up = np.array([0.0, 0.0, 1.0])
    segments = section_segments(TETRAHEDRON, np.array([0.0, 0.0, height]), up)
    start, end = segments[:, 0] - segments.mean(axis=(0, 1)), segments[:, 1] - segments[:, 0]
    assert (np.cross(start, end)[:, 2] > 0).all()
    below = section_segments(TETRAHEDRON, np.array([0.0, 0.0, height]), -up)
    assert (
        np.cross(below[:, 0] - below.mean(axis=(0, 1)), below[:, 1] - below[:, 0])[:, 2] < 0
    ).all()


def test_the_boundary_of_an_open_mesh_crosses_the_plane_where_its_section_ends() -> None:
    opened = TriangleMesh(TETRAHEDRON.vertices, TETRAHEDRON.triangles[:-1])
    origin, up = np.array([0.0, 0.0, 4.0]), np.array([0.0, 0.0, 1.0])
    ends = boundary_crossings(opened, origin, up)
    assert len(boundary_crossings(TETRAHEDRON, origin, up)) == 0
    points = section_segments(opened, origin, up).reshape(-1, 3)
    for end in ends:
        assert (np.linalg.norm(points - end, axis=1) < 1e-9).sum() == 1


def test_parallel_sections_are_those_of_single_planes() -> None:
    normal = np.array([1.0, 2.0, 2.0]) / 3
    sections = ParallelSections(TETRAHEDRON, normal)
    for origin in np.array([[1.0, 1.0, 1.0], [0.2, 0.1, 0.3], [0.0, 0.0, 7.0], [9.0, 9.0, 9.0]]):
        single = section_segments(TETRAHEDRON, origin, normal)
        np.testing.assert_allclose(sections.through(origin), single, atol=1e-12)
