"""Neighbours, borders, pieces, smoothing and subdivision, on shapes with known answers."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry import mesh_graph
from insole_core.geometry.mesh import ContourConstraints, TriangleMesh
from insole_core.geometry.mesh_boundary import extend_boundary
from insole_core.geometry.mesh_graph import noise_mm, without_noise
from insole_core.geometry.mesh_resolution import subdivided, thinned
from insole_core.geometry.surface_nets import surface_nets

RADIUS_MM = 9.3


@pytest.fixture(scope="module")
def ball() -> TriangleMesh:
    lattice = np.stack(np.mgrid[-12:13, -12:13, -12:13].astype(float), axis=-1)
    distance = np.linalg.norm(lattice, axis=-1) - RADIUS_MM
    return surface_nets(distance, np.ones(distance.shape, bool), np.full(3, -12.0), 1.0)


def test_a_ball_is_closed_faces_outwards_and_has_its_volume(ball: TriangleMesh) -> None:
    assert ball.is_closed
    assert ball.volume_mm3 == pytest.approx(4 / 3 * np.pi * RADIUS_MM**3, rel=0.02)
    np.testing.assert_allclose(np.linalg.norm(ball.vertices, axis=1), RADIUS_MM, atol=0.2)


def test_the_surface_ends_where_the_lattice_is_unknown() -> None:
    values = np.broadcast_to(np.arange(6.0) - 2.4, (6, 6, 6)).copy()
    known = np.ones(values.shape, bool)
    known[4:] = False
    mesh = surface_nets(values, known, np.array([10.0, 20.0, 30.0]), 2.0)
    np.testing.assert_allclose(mesh.vertices[:, 2], 30 + 2 * 2.4)
    assert mesh.bounds_mm[1, 0] == pytest.approx(10 + 2 * 2.5)
    np.testing.assert_allclose(mesh.triangle_normals, [[0, 0, 1]] * len(mesh.triangles))


def test_a_ball_has_no_border_and_half_of_it_has_one(ball: TriangleMesh) -> None:
    assert not ball.links.is_boundary.any()
    half = ball.part(ball.vertices[:, 2] > 0)
    border = half.links.is_boundary
    assert 0 < half.vertices[border, 2].max() < 2.0


def test_only_large_pieces_remain(ball: TriangleMesh) -> None:
    low, high = ball.vertices[:, 2] < -8, ball.vertices[:, 2] > 0
    parts = ball.part(low | high)
    kept = mesh_graph.in_large_pieces(parts, 0.2)
    np.testing.assert_array_equal(kept, parts.vertices[:, 2] > 0)
    assert mesh_graph.in_large_pieces(parts, 0.001).all()


def test_relaxing_takes_steps_away_without_shrinking(ball: TriangleMesh) -> None:
    outwards = ball.vertices / np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    steps = np.random.default_rng(1).normal(0, 0.1, (len(outwards), 1))
    rough = TriangleMesh(ball.vertices + steps * outwards, ball.triangles)
    relaxed = TriangleMesh(mesh_graph.relaxed(rough, 10), ball.triangles)
    assert relaxed.volume_mm3 == pytest.approx(ball.volume_mm3, rel=0.01)
    before, after = (np.linalg.norm(m.vertices, axis=1).std() for m in (rough, relaxed))
    assert after < before / 2


def test_a_flat_mesh_grows_in_its_plane_on_all_sides() -> None:
    values = np.broadcast_to(np.arange(8.0) - 3.5, (8, 8, 8)).copy()
    mesh = surface_nets(values, np.ones(values.shape, bool), np.zeros(3), 1.0)
    larger = extend_boundary(mesh, 0.5)
    np.testing.assert_array_equal(larger.vertices[: len(mesh.vertices)], mesh.vertices)
    np.testing.assert_allclose(larger.vertices[:, 2], 3.5)
    np.testing.assert_allclose(larger.triangle_normals[:, 2], 1.0)
    added = larger.area_mm2 - mesh.area_mm2
    side = np.ptp(mesh.vertices[:, 0])
    assert added == pytest.approx(4 * 0.5 * side, rel=0.1)


def test_a_closed_mesh_does_not_grow(ball: TriangleMesh) -> None:
    assert len(extend_boundary(ball, 1.0).triangles) == len(ball.triangles)


def test_subdivision_rounds_edges_and_keeps_vertices(ball: TriangleMesh) -> None:
    fine, ends = subdivided(ball)
    assert fine.is_closed
    assert len(fine.triangles) == 4 * len(ball.triangles)
    np.testing.assert_array_equal(fine.vertices[: len(ball.vertices)], ball.vertices)
    straight = ball.vertices[ends].mean(1)
    exact = 4 / 3 * np.pi * RADIUS_MM**3
    flat = TriangleMesh(straight, fine.triangles).volume_mm3
    assert abs(fine.volume_mm3 - exact) < abs(flat - exact)


def test_a_narrow_gap_is_not_grown_over() -> None:
    def plate(left_mm: float) -> tuple[np.ndarray, np.ndarray]:
        v, u = np.mgrid[:5, :5].astype(float) * 2
        corner = (np.arange(4)[:, None] * 5 + np.arange(4)).ravel()
        return (
            np.column_stack([u.ravel() + left_mm, v.ravel(), np.zeros(25)]),
            np.concatenate(
                [
                    np.stack([corner, corner + 1, corner + 5], 1),
                    np.stack([corner + 1, corner + 6, corner + 5], 1),
                ]
            ),
        )

    (left, triangles), (right, _) = plate(0.0), plate(10.0)
    both = TriangleMesh(
        np.concatenate([left, right]),
        np.concatenate([triangles, triangles + 25]).astype(np.int32),
    )
    added = extend_boundary(both, 1.8).vertices[50:]
    within = (added[:, 1] > 0.5) & (added[:, 1] < 7.5)
    assert not (within & (added[:, 0] > 8.5) & (added[:, 0] < 9.5)).any()
    assert (within & (added[:, 0] < -1)).any(), "the free sides are grown"
    assert (within & (added[:, 0] > 19)).any()


def noisy(mesh: TriangleMesh, spread_mm: float) -> TriangleMesh:
    noise = np.random.default_rng(1).normal(0, spread_mm, (len(mesh.vertices), 1))
    return mesh.moved(mesh.vertices + noise * mesh.vertex_normals)


@pytest.mark.parametrize("spread_mm", [0.0, 0.3, 0.8])
def test_noise_is_told_from_shape(left_mesh: TriangleMesh, spread_mm: float) -> None:
    assert noise_mm(noisy(left_mesh, spread_mm)) == pytest.approx(spread_mm, abs=0.15)


def test_a_surface_with_little_noise_is_measured_as_it_is(left_mesh: TriangleMesh) -> None:
    assert without_noise(left_mesh) is left_mesh
    outlined = noisy(left_mesh, 0.3).with_attributes(
        touches=ContourConstraints(np.zeros((0, 3)), np.zeros((0, 3)))
    )
    assert without_noise(outlined) is outlined
    assert noise_mm(thinned(left_mesh, 12.0)) == 0.0
