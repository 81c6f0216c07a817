"""A tape laid on forms of which the shortest ways are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import trimesh

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.surface_path import path_length_mm, shortest_path
from insole_core.insole.primitives.height_field import HeightField

FLAT = HeightField(0.0, 0.0, 1.0, np.zeros((121, 101)))
RADIUS_MM = 40.0


def rolled(flat: FloatArray) -> FloatArray:
    """Roll points (..., 3) of a plane round a cylinder."""
    angle = flat[..., 0] / RADIUS_MM
    x, z = RADIUS_MM * np.cos(angle), RADIUS_MM * np.sin(angle)
    return np.stack([x, flat[..., 1], z], axis=-1)


@pytest.mark.parametrize("form", [np.asarray, rolled], ids=["plane", "cylinder"])
@pytest.mark.parametrize(
    ("start", "end"),
    [((3.3, 4.1), (96.2, 57.7)), ((50.0, 10.0), (50.0, 110.0)), ((9.4, 80.2), (9.9, 80.6))],
)
def test_the_way_is_as_long_as_known(
    form: Callable[[FloatArray], FloatArray], start: tuple[float, ...], end: tuple[float, ...]
) -> None:
    mesh = TriangleMesh(form(FLAT.nodes), FLAT.triangles())
    places = np.array([(*start, 0.0), (*end, 0.0)])
    way = shortest_path(mesh, *form(places))
    assert way is not None
    assert way[[0, -1]] == pytest.approx(form(places), abs=1e-9)
    known_mm = float(np.hypot(*np.subtract(end, start)))
    assert path_length_mm(way) == pytest.approx(known_mm, abs=0.01)
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    assert steps.max() < 1.01


def test_over_the_arch_of_a_thin_shell_the_way_stays_on_its_side() -> None:
    top, faces = rolled(FLAT.nodes), FLAT.triangles()
    back = rolled(FLAT.nodes) * (1 - 1.2 / RADIUS_MM, 1.0, 1 - 1.2 / RADIUS_MM)
    round_edge = trimesh.Trimesh(FLAT.nodes, faces).outline().entities[0].points
    a, b = round_edge[:-1], round_edge[1:]
    wall = np.concatenate(
        [np.stack([a, a + len(top), b], 1), np.stack([b, a + len(top), b + len(top)], 1)]
    )
    shell = TriangleMesh(
        np.concatenate([top, back]),
        np.concatenate([faces, faces[:, ::-1] + len(top), wall]).astype(np.int32),
    )
    ends = rolled(np.array([(20.0, 60.0, 0.0), (75.0, 60.0, 0.0)]))
    way = shortest_path(shell, *ends)
    assert way is not None
    assert path_length_mm(way) == pytest.approx(55.0, abs=0.01)


def test_the_way_goes_round_a_foot_and_never_through_it(left_foot: Foot) -> None:
    mesh = left_foot.mesh
    ends = mesh.vertices[[mesh.vertices[:, 0].argmin(), mesh.vertices[:, 0].argmax()]]
    way = shortest_path(mesh, *ends)
    back = shortest_path(mesh, *ends[::-1])
    assert way is not None
    assert back is not None
    straight_mm = np.linalg.norm(ends[1] - ends[0])
    assert path_length_mm(way) > straight_mm + 2.0
    assert path_length_mm(back) == pytest.approx(path_length_mm(way), rel=0.003)


def test_parts_that_do_not_hang_together_have_no_way() -> None:
    apart = FLAT.nodes + np.array([0.0, 0.0, 30.0])
    vertices = np.concatenate([FLAT.nodes, apart])
    corners = np.concatenate([FLAT.triangles(), FLAT.triangles() + len(FLAT.nodes)])
    mesh = TriangleMesh(vertices, corners.astype(np.int32))
    assert shortest_path(mesh, FLAT.nodes[50], apart[9000]) is None
    way = shortest_path(mesh, apart[50], apart[9000])
    assert way is not None
    assert np.ptp(way[:, 2]) == pytest.approx(0.0, abs=1e-9)
