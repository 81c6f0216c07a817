"""Contour lines show the form of the contact surface, and leave out its walls."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_studio.scene.coloring import ContourLines, contour_lines


def bowl(steep: float) -> TriangleMesh:
    """100 × 100 mm, gently sloped to x = 80 mm and with a wall of a slope from there on."""
    x, y = np.meshgrid(np.arange(101.0), np.arange(101.0))
    z = 0.1 * x + np.maximum(x - 80, 0) * steep
    index = np.arange(x.size, dtype=np.int32).reshape(x.shape)
    a, b, c, d = (
        part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    )
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return TriangleMesh(np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1), triangles)


@pytest.fixture
def lines() -> ContourLines:
    mesh = bowl(steep=2.0)
    return contour_lines(mesh.vertices, mesh.vertex_normals, mesh.triangles, mesh.links.is_boundary)


def test_a_line_stands_every_millimetre_and_every_fifth_is_strong(lines: ContourLines) -> None:
    assert set(np.round(lines.strong[..., 2].ravel(), 6)) == {5.0}
    thin = set(np.round(lines.thin[..., 2].ravel(), 6))
    assert thin - {8.0} == {1.0, 2.0, 3.0, 4.0, 6.0, 7.0}  # the wall begins at 8 mm


def test_the_wall_has_no_lines(lines: ContourLines) -> None:
    for segments in (lines.thin, lines.strong):
        assert segments[..., 0].max() <= 82.0


def test_strong_lines_are_labelled_where_there_is_room(lines: ContourLines) -> None:
    ((place, text),) = lines.labels
    assert text == "5"
    assert place[2] == pytest.approx(5.0)
    assert 5.0 < place[1] < 95.0  # not at the rim


def test_where_there_is_no_room_there_is_no_label() -> None:
    mesh = bowl(steep=0.0)
    strip = mesh.part(mesh.vertices[:, 1] < 8)
    lines = contour_lines(
        strip.vertices, strip.vertex_normals, strip.triangles, strip.links.is_boundary
    )
    assert len(lines.strong) > 0
    assert lines.labels == ()
