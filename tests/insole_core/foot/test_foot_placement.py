"""Bringing feet to the insole frame: from any pose, of either side, whole or in part."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from insole_core.errors import InputError
from insole_core.foot.foot_placement import (
    SideMismatchError,
    find_foot,
    place_foot,
    placed_foot,
)
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import is_rotation, rigid, transform
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape


def thrown(mesh: TriangleMesh, seed: int) -> TriangleMesh:
    """The mesh in a pose of chance."""
    rng = np.random.default_rng(seed)
    rotation = Rotation.random(rng=rng).as_matrix()
    return mesh.transformed(rigid(rotation, rng.uniform(-500, 500, 3)))


def mirrored(mesh: TriangleMesh) -> TriangleMesh:
    return replace(mesh, vertices=mesh.vertices * [-1, 1, 1]).flipped()


def check_frame(mesh: TriangleMesh, side: Side) -> None:
    """The insole frame of the contract, seen on the surface itself."""
    low = mesh.vertices[mesh.vertices[:, 2] < 45]
    assert mesh.vertices[:, 2].min() == pytest.approx(0, abs=1e-6)
    assert low[:, 1].min() == pytest.approx(0, abs=0.05)
    front = low[low[:, 1] > 0.93 * low[:, 1].max(), 0]
    assert front.mean() * side.medial_sign > 2  # the big toe, longest, lies medially
    sole = mesh.vertices[mesh.vertex_normals[:, 2] < -0.5]
    arch = sole[np.abs(sole[:, 1] - 0.42 * low[:, 1].max()) < 5]
    medial = arch[:, 0] * side.medial_sign > 10
    lateral = arch[:, 0] * side.medial_sign < -15
    assert arch[medial, 2].mean() > arch[lateral, 2].mean() + 2


def check_near(mesh: TriangleMesh, vertices: np.ndarray, limit_mm: float) -> None:
    np.testing.assert_allclose(mesh.vertices, vertices, rtol=0, atol=limit_mm)


def test_foot_of_a_session_is_levelled(left_mesh, left_foot):
    check_frame(left_foot.mesh, Side.LEFT)
    assert left_foot.length_mm == pytest.approx(245, abs=2)
    assert is_rotation(left_foot.source2insole[:3, :3])
    moved = transform(left_foot.source2insole, left_mesh.vertices)
    assert np.abs(moved - left_foot.mesh.vertices).max() < 1e-9


def test_mirror_image_is_placed_as_mirror_image(left_foot, right_foot):
    check_frame(right_foot.mesh, Side.RIGHT)
    check_near(right_foot.mesh, left_foot.mesh.vertices * [-1, 1, 1], 1e-6)


@pytest.mark.parametrize(("side", "seed"), [(Side.LEFT, 0), (Side.RIGHT, 1)])
def test_pose_of_a_mesh_does_not_matter(left_mesh, left_foot, side, seed):
    mesh = left_mesh if side is Side.LEFT else mirrored(left_mesh)
    foot = place_foot(thrown(mesh, seed), side, frame="unknown")
    expected = left_foot.mesh.vertices * [side.medial_sign, 1, 1]
    assert np.linalg.norm(foot.mesh.vertices - expected, axis=1).max() < 0.1
    assert any("does not say how the foot lies" in note for note in foot.notes)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_feet_of_other_shapes_keep_their_side(seed):
    rng = np.random.default_rng(seed)
    side = [Side.LEFT, Side.RIGHT][seed % 2]
    mesh = thrown(build_foot(vary_shape(rng, side), rng, cell_mm=3.5).mesh, seed)
    found = find_foot(mesh)
    own, other = found.best(side), found.best(side.other)
    assert own is not None
    assert other is not None
    check_frame(placed_foot(found, own).mesh, side)
    with pytest.raises(SideMismatchError):
        placed_foot(found, other)


@pytest.mark.parametrize("frame", ["reference", "unknown"])
def test_wrong_side_is_refused_and_can_be_forced(left_mesh, left_foot, frame):
    with pytest.raises(SideMismatchError, match=r"looks like a left foot.*take it as"):
        place_foot(left_mesh, Side.RIGHT, frame=frame)
    forced = place_foot(left_mesh, Side.RIGHT, frame=frame, force=True)
    assert forced.side is Side.RIGHT
    assert "by force" in forced.notes[0]
    places = [transform(foot.source2insole, left_mesh.vertices) for foot in (forced, left_foot)]
    apart = np.linalg.norm(places[0] - places[1], axis=1)
    assert apart.max() < 45  # the same way up and round, whatever its name


def sole(mesh: TriangleMesh) -> TriangleMesh:
    return mesh.part((mesh.vertex_normals[:, 2] < -0.3) & (mesh.vertices[:, 2] < 30))


def slipper(mesh: TriangleMesh) -> TriangleMesh:
    return mesh.part(mesh.vertices[:, 2] < 35)


def without_toes(mesh: TriangleMesh) -> TriangleMesh:
    return mesh.part(mesh.vertices[:, 1] < 60)


def with_hole(mesh: TriangleMesh) -> TriangleMesh:
    x, y, z = mesh.vertices.T
    return mesh.part((np.hypot(x - 10, y) > 20) & (z < 35))


@pytest.mark.parametrize(
    ("cut", "limit_mm"),
    # The rearmost point of an open sole lies further ahead than that of the heel.
    [(sole, 6.0), (slipper, 0.5), (without_toes, 6.0), (with_hole, 0.5)],
)
def test_part_of_a_foot_finds_its_place(left_mesh, left_foot, cut, limit_mm):
    part = cut(left_mesh)
    scan = thrown(part, 5)
    foot = place_foot(scan, Side.LEFT, frame="unknown")
    low = part.vertices[:, 2] < 40
    apart = (
        transform(foot.source2insole, scan.vertices)
        - transform(left_foot.source2insole, part.vertices)
    )[low]
    assert np.abs(apart).max() < limit_mm


def test_missing_toes_are_said(left_mesh):
    foot = place_foot(without_toes(left_mesh), Side.LEFT, frame="reference")
    assert any("toes are missing" in note for note in foot.notes)
    assert foot.length_mm > np.ptp(foot.mesh.vertices[:, 1])


def as_wide(mesh: TriangleMesh, times: float) -> TriangleMesh:
    return replace(mesh, vertices=mesh.vertices * [times, 1, 1])


@pytest.mark.parametrize(
    ("times", "frame"),
    [
        (0.75, "reference"),
        (1.15, "reference"),
        (1.25, "reference"),
        (1.35, "reference"),
        (0.75, "unknown"),
        (1.35, "unknown"),
    ],
)
def test_toes_are_seen_on_feet_of_any_width(left_foot, times, frame):
    whole = place_foot(as_wide(left_foot.mesh, times), Side.LEFT, frame=frame, force=True)
    assert whole.length_mm == pytest.approx(left_foot.length_mm, abs=2)
    assert not any("toes are missing" in note for note in whole.notes)


@pytest.mark.parametrize("times", [0.75, 1.0, 1.35])
@pytest.mark.parametrize("cut", [0.77, 0.82, 0.87])
def test_missing_toes_are_said_of_feet_of_any_width(left_foot, times, cut):
    mesh = left_foot.mesh
    behind = mesh.part(mesh.vertices[:, 1] < cut * left_foot.length_mm)
    foot = place_foot(as_wide(behind, times), Side.LEFT, frame="reference", force=True)
    assert any("toes are missing" in note for note in foot.notes)


@pytest.mark.parametrize("cut_mm", [20.0, 35.0, 50.0])
def test_a_missing_heel_is_said(left_mesh, left_foot, cut_mm):
    part = left_mesh.part(left_foot.mesh.vertices[:, 1] > cut_mm)
    foot = place_foot(part, Side.LEFT, frame="reference")
    assert any("heel is missing" in note for note in foot.notes)
    assert not any("heel is missing" in note for note in left_foot.notes)


def test_scraps_are_left_out_and_said(left_mesh, left_foot):
    scrap = trimesh.creation.icosphere(radius=4)
    mesh = TriangleMesh(
        np.concatenate([left_mesh.vertices, scrap.vertices + np.array([40, 0, -60])]),
        np.concatenate([left_mesh.triangles, scrap.faces + len(left_mesh.vertices)]).astype(
            np.int32
        ),
    )
    foot = place_foot(mesh, Side.LEFT, frame="unknown")
    check_near(foot.mesh, left_foot.mesh.vertices, 0.1)
    assert any("1 small piece" in note for note in foot.notes)


@pytest.mark.parametrize(
    "thing", [trimesh.creation.icosphere(radius=60), trimesh.creation.box((250, 250, 250))]
)
def test_what_is_no_foot_is_refused(thing):
    mesh = TriangleMesh(np.array(thing.vertices), np.array(thing.faces, np.int32))
    with pytest.raises(InputError, match="looks like no foot"):
        place_foot(mesh, Side.LEFT, frame="unknown")


def test_sole_without_rim_may_come_inside_out(left_mesh):
    x, y, z = left_mesh.vertices.T
    patch = left_mesh.part(
        (left_mesh.vertex_normals[:, 2] < -0.6) & (z < 25) & (x > -30) & (y > -110)
    )
    foot = place_foot(thrown(patch, 2), Side.LEFT, frame="unknown")
    turned = place_foot(thrown(patch.flipped(), 2), Side.LEFT, frame="unknown")
    assert any("inside out" in note for note in turned.notes)
    check_near(turned.mesh, foot.mesh.vertices, 1e-3)
    assert turned.mesh.triangle_normals[:, 2].mean() < -0.5


def test_a_foot_held_turned_out_and_tilted_is_placed(left_mesh, left_foot):
    held = Rotation.from_euler("xyz", [20, 12, -18], degrees=True).as_matrix()
    mesh = left_mesh.transformed(rigid(held, np.array([-6.0, 6.0, 22.0])))
    foot = place_foot(mesh, Side.LEFT, frame="reference")
    assert foot.length_mm == pytest.approx(left_foot.length_mm, abs=0.1)
    assert np.linalg.norm(foot.mesh.vertices - left_foot.mesh.vertices, axis=1).max() < 0.1


def test_flat_surface_is_refused():
    corners = np.array([[0, 0, 0], [100, 0, 0], [100, 250, 0], [0, 250, 0]], float)
    mesh = TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    with pytest.raises(InputError, match="flat"):
        place_foot(mesh, Side.LEFT, frame="unknown")


def test_back_of_a_foot_alone_is_refused(left_mesh):
    back = left_mesh.part(left_mesh.vertex_normals[:, 2] > 0.2)
    with pytest.raises(InputError, match="has no sole"):
        place_foot(back, Side.LEFT, frame="reference")


@pytest.mark.slow
@pytest.mark.shared
def test_real_plantar_scan_is_a_right_foot(scanned_mesh):
    mesh = scanned_mesh("plantar_scan.obj")
    found = find_foot(mesh)
    own, other = found.best(Side.RIGHT), found.best(Side.LEFT)
    assert own is not None
    assert other is not None
    foot = placed_foot(found, own)
    with pytest.raises(SideMismatchError, match="looks like a right foot"):
        placed_foot(found, other)
    check_frame(foot.mesh, Side.RIGHT)
    assert any("does not say how the foot lies" in note for note in foot.notes)
    again = place_foot(thrown(mirrored(mesh), 1), Side.LEFT, frame="unknown")
    check_near(again.mesh, foot.mesh.vertices * [-1, 1, 1], 0.1)


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize(("session", "side"), [("left_a", Side.LEFT), ("right_b", Side.RIGHT)])
def test_true_foot_of_a_session(true_mesh, true_foot, session: str, side: Side):
    foot = true_foot(session, side)
    check_frame(foot.mesh, side)
    again = place_foot(thrown(true_mesh(session), 3), side, frame="unknown")
    assert np.linalg.norm(again.mesh.vertices - foot.mesh.vertices, axis=1).max() < 0.1
