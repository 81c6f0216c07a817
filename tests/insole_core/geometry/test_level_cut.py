"""A mesh is cut exactly along a level of a linear field."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sections import level_cut


@pytest.fixture
def square() -> TriangleMesh:
    """10 × 10 mm in 200 triangles."""
    x, y = np.meshgrid(np.arange(11.0), np.arange(11.0))
    index = np.arange(121, dtype=np.int32).reshape(11, 11)
    a, b, c, d = (
        part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    )
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return TriangleMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), triangles)


@pytest.mark.parametrize("level", [0.25, 3.7, 9.9])
def test_the_part_above_a_level_has_its_area(square: TriangleMesh, level: float) -> None:
    cut = level_cut(square, square.vertices[:, 0] - level)
    part = TriangleMesh(cut.extended(square.vertices), cut.triangles)
    assert part.area_mm2 == pytest.approx(10 * (10 - level), abs=1e-9)
    used = np.unique(part.triangles)
    assert part.vertices[used, 0].min() == pytest.approx(level, abs=1e-9)
    assert (part.triangle_normals[:, 2] > 0.99).all()
    assert (part.links.edges[1] <= 2).all()


def test_each_triangle_knows_its_source(square: TriangleMesh) -> None:
    cut = level_cut(square, square.vertices @ np.array([1.0, 0.7, 0.0]) - 6.3)
    vertices = cut.extended(square.vertices)
    middle = vertices[cut.triangles].mean(axis=1)
    away = np.abs(middle - square.vertices[square.triangles[cut.source]].mean(axis=1))
    assert away.max() < 0.7
