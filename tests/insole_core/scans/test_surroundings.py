"""What a scanner sees beside a foot is left out, and said; a sound foot stays as it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.geometry.mesh import TriangleMesh
from insole_core.scans.cleaning import without_spikes
from insole_core.scans.surroundings import second_foot, without_surroundings


def joined(*meshes: TriangleMesh) -> TriangleMesh:
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    triangles = [mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(triangles).astype(np.int32),
    )


def solid(shape: trimesh.Trimesh, place: tuple[float, float, float]) -> TriangleMesh:
    return TriangleMesh(
        np.array(shape.vertices, float) + place, np.array(shape.faces, dtype=np.int32)
    )


def floor(height_mm: float, size_mm: float = 600.0, step_mm: float = 6.0) -> TriangleMesh:
    count = int(size_mm / step_mm) + 1
    along = np.linspace(-size_mm / 2, size_mm / 2, count)
    x, y = np.meshgrid(along, along, indexing="ij")
    z = height_mm + 0.3 * np.random.default_rng(1).standard_normal(x.shape)
    index = np.arange(count * count).reshape(count, count)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    triangles = [np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    return TriangleMesh(
        np.column_stack([x.ravel(), y.ravel(), z.ravel()]),
        np.concatenate(triangles).astype(np.int32),
    )


def standing(mesh: TriangleMesh) -> TriangleMesh:
    """The foot with a sole that is pressed flat."""
    heights = np.maximum(mesh.vertices[:, 2], 3.0)
    return TriangleMesh(np.column_stack([mesh.vertices[:, :2], heights]), mesh.triangles)


def welded_floor(foot: TriangleMesh) -> TriangleMesh:
    """A foot and the floor with triangles between them all around the contact."""
    ground = floor(3.0)
    low = np.flatnonzero(foot.vertices[:, 2] < 6.0)
    near = cKDTree(ground.vertices).query(foot.vertices[low])[1] + len(foot.vertices)
    whole = joined(foot, ground)
    between = np.column_stack([low, near, np.roll(near, 1)]).astype(np.int32)
    return TriangleMesh(whole.vertices, np.concatenate([whole.triangles, between]))


def assert_is(mesh: TriangleMesh, foot: TriangleMesh, *, extra: float = 0.01) -> None:
    """The surface holds all of the foot, and nearly nothing else."""
    assert cKDTree(mesh.vertices).query(foot.vertices)[0].max() < 3.0
    beside = cKDTree(foot.vertices).query(mesh.vertices)[0] > 4.0
    assert beside.mean() <= extra


def test_a_sound_foot_stays_as_it_is(left_mesh):
    for foot in (left_mesh, standing(left_mesh)):
        scan = without_surroundings(foot)
        assert scan.mesh is foot
        assert scan.left_out == ()


@pytest.mark.parametrize("turn", [0, 1, 2])
def test_a_floor_is_cut_off_in_any_direction(left_mesh, turn):
    foot = standing(left_mesh)
    pose = trimesh.transformations.rotation_matrix(1.0 + turn, [1, turn, 2 - turn], [9, 9, 9])
    scan = without_surroundings(joined(foot, floor(3.0)).transformed(pose))
    assert_is(scan.mesh, foot.transformed(pose), extra=0.0)
    assert len(scan.left_out) == 1
    assert "floor, table or glass" in scan.left_out[0]


def test_a_floor_that_is_joined_to_the_sole_is_cut_off_and_the_sole_stays(left_mesh):
    foot = standing(left_mesh)
    scan = without_surroundings(welded_floor(foot))
    assert_is(scan.mesh, foot)
    assert "floor, table or glass" in scan.left_out[0]


def test_something_low_on_a_plane_stays_unless_it_is_said_to_be_a_foot(left_mesh):
    sole = left_mesh.part(left_mesh.vertices[:, 2] < 30)
    scan = joined(sole, floor(0.0))
    assert without_surroundings(scan).left_out == ()
    assert_is(without_surroundings(scan, is_foot=True).mesh, sole)


@pytest.mark.parametrize(
    ("thing", "words"),
    [
        (solid(trimesh.creation.cylinder(15, 500), (150, 0, 250)), "leg of a table"),
        (solid(trimesh.creation.box([60, 60, 60]), (300, 0, 30)), "far from the foot"),
        (solid(trimesh.creation.box([86, 54, 1]), (0, 0, 260)), "it is flat"),
    ],
    ids=["leg", "box", "card"],
)
def test_furniture_is_left_out(left_mesh, thing, words):
    scan = without_surroundings(joined(left_mesh, thing))
    assert_is(scan.mesh, left_mesh, extra=0.0)
    assert len(scan.left_out) == 1
    assert words in scan.left_out[0]


def test_of_a_double_surface_the_outer_one_is_kept(left_mesh):
    inner = left_mesh.vertices - 2.5 * left_mesh.vertex_normals
    double = joined(left_mesh, TriangleMesh(inner, left_mesh.triangles).flipped())
    scan = without_surroundings(double)
    assert_is(scan.mesh, left_mesh, extra=0.0)
    assert "the inner side of a shell" in scan.left_out[0]


def test_two_feet_are_told_from_a_foot_and_its_parts(left_mesh, right_mesh):
    beside = replace(right_mesh, vertices=right_mesh.vertices + np.array([150, 20, 0]))
    is_second = second_foot(joined(left_mesh, beside))
    assert is_second is not None
    assert is_second.sum() == len(left_mesh.vertices)
    assert second_foot(left_mesh) is None
    low = left_mesh.vertices[:, 2] < 40
    assert second_foot(joined(left_mesh.part(low), left_mesh.part(~low))) is None


def test_spikes_are_drawn_back_and_the_surface_stays_closed(left_mesh):
    rng = np.random.default_rng(4)
    stray = rng.random(len(left_mesh.vertices)) < 0.05
    moved = left_mesh.vertices + stray[:, None] * rng.normal(0, 12, left_mesh.vertices.shape)
    mesh, count = without_spikes(replace(left_mesh, vertices=moved))
    across = np.einsum("ij,ij->i", mesh.vertices - left_mesh.vertices, left_mesh.vertex_normals)
    assert count > 0.9 * stray.sum()
    assert mesh.is_closed
    assert np.quantile(np.abs(across), 0.99) < 0.5
    assert (np.abs(across) > 3).mean() < 0.001


def test_a_foot_without_spikes_keeps_every_vertex(left_mesh, right_mesh):
    for foot in (left_mesh, right_mesh):
        assert without_spikes(foot) == (foot, 0)
