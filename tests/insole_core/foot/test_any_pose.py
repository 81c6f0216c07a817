"""A foot with its leg, in any pose; what is doubtful is said, what is none is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from benchmarks._random_designs import random_foot
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.foot.foot_placement import (
    find_foot,
    is_of_other_side,
    place_foot,
    placed_foot,
)
from insole_core.foot.foot_proportions import ProportionsError
from insole_core.foot.side_check import seen_side, side_doubt
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_angle_deg, transform
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape
from insole_core.workflows.import_scan import examine_scan, take_foot


def thrown(mesh: TriangleMesh, seed: int) -> tuple[TriangleMesh, np.ndarray]:
    """The mesh in a pose of chance, and the transform to it."""
    rng = np.random.default_rng(seed)
    a2b = rigid(Rotation.random(rng=rng).as_matrix(), rng.uniform(-300, 300, 3))
    return mesh.transformed(a2b), a2b


def pointed(foot: Foot, degrees: float) -> TriangleMesh:
    """The foot with its leg three times as long and turned back at the ankle."""
    ankle = 0.26 * foot.length_mm
    x, y, z = foot.mesh.vertices.T
    turn = np.radians(degrees) * np.clip((z - 0.8 * ankle) / (0.5 * ankle), 0, 1)
    turn = np.where(y < 2 * ankle, turn, 0)
    over = np.where(z > 1.5 * ankle, 3 * z - 4 * ankle, z - ankle)
    back = ankle + np.cos(turn) * (y - ankle) - np.sin(turn) * over
    up = ankle + 0.3 * np.sin(turn) * (y - ankle) + np.cos(turn) * over
    return foot.mesh.moved(np.column_stack([x, back, up]))


@pytest.mark.parametrize("degrees", [0, 30, 60])
def test_a_foot_with_a_long_leg_is_found_and_the_leg_cut_off_square_to_itself(
    left_foot: Foot, degrees: float
) -> None:
    scan, a2b = thrown(pointed(left_foot, degrees), 5)
    found = find_foot(scan)
    likely = found.candidates[0]
    assert (likely.side, found.doubts) == (Side.LEFT, ())
    assert likely.length_mm == pytest.approx(left_foot.length_mm, rel=0.01)
    assert rotation_angle_deg((likely.source2insole @ a2b)[:3, :3]) < 3
    leg = likely.leg
    assert leg is not None
    assert leg.ankle_deg == pytest.approx(90 + degrees, abs=10)
    foot = placed_foot(found, likely)
    beyond = (foot.mesh.vertices - np.array(leg.end)) @ np.array(leg.axis)
    assert beyond.max() < 0.01
    assert foot.mesh.vertices[:, 2].max() > 0.4 * foot.length_mm  # the ankle is still there


def test_a_foot_whose_leg_is_short_stays_whole(left_foot: Foot) -> None:
    scan, _ = thrown(left_foot.mesh, 5)
    found = find_foot(scan)
    assert found.candidates[0].leg is None
    assert len(placed_foot(found, found.candidates[0]).mesh.vertices) == len(scan.vertices)


def on_floor(mesh: TriangleMesh, cut_mm: float, floor_mm: float) -> TriangleMesh:
    """The mesh as seen from above; beside it, as wide as told, some of the floor has stayed."""
    height = mesh.vertices[:, 2] - mesh.vertices[:, 2].min()
    faces_down = (mesh.vertex_normals[:, 2] < -0.7) & (height < 30)
    foot = mesh.part((height > cut_mm) & ~faces_down)
    ends = foot.links.ends[(foot.vertices[foot.links.ends, 2] < 40).all(axis=1)]
    used, index = np.unique(ends, return_inverse=True)
    count = len(foot.vertices)
    floor = foot.vertices[used] + floor_mm * foot.vertex_normals[used]
    floor[:, 2] = mesh.vertices[:, 2].min() + cut_mm
    start, end = ends.T
    far_start, far_end = (count + index.reshape(-1, 2)).T
    beside = np.concatenate(
        [np.column_stack([start, far_start, end]), np.column_stack([end, far_start, far_end])]
    )
    return TriangleMesh(
        np.vstack([foot.vertices, floor]),
        np.vstack([foot.triangles, beside]).astype(np.int32),
    )


@pytest.mark.parametrize(("degrees", "floor_mm"), [(60, 0.1), (0, 6.0)])
def test_a_foot_that_stood_has_its_sole_closed(
    left_foot: Foot, degrees: float, floor_mm: float
) -> None:
    scan, a2b = thrown(on_floor(pointed(left_foot, degrees), 3.0, floor_mm), 6)
    found = find_foot(scan)
    likely = found.candidates[0]
    assert (likely.side, found.doubts) == (Side.LEFT, ())
    assert "shows no sole" in " ".join(found.warnings)
    assert likely.length_mm == pytest.approx(left_foot.length_mm, rel=0.015)
    assert rotation_angle_deg((likely.source2insole @ a2b)[:3, :3]) < 3
    assert likely.second_toe_found or floor_mm > 1  # by its back, where no floor is at it
    foot = placed_foot(found, likely)
    sole = foot.mesh.vertices[foot.mesh.vertex_normals[:, 2] < -0.9]
    assert np.ptp(sole[:, 1]) > 0.8 * foot.length_mm
    assert np.percentile(sole[:, 2], 90) < 3


def test_a_hole_between_the_toes_is_not_taken_for_the_sole() -> None:
    rng = np.random.default_rng(43)
    mesh = build_foot(vary_shape(rng, Side.RIGHT), rng, cell_mm=3.0).mesh
    foot = place_foot(mesh, Side.RIGHT, frame="reference")
    height = foot.mesh.vertices[:, 2]
    faces_down = foot.mesh.vertex_normals[:, 2] < -0.7
    stood = foot.mesh.part((height > 2.5) & ~(faces_down & (height < 30)))
    found = find_foot(stood)
    assert (found.told_side, len(found.warnings)) == (Side.RIGHT, 1)
    assert found.candidates[0].length_mm == pytest.approx(foot.length_mm, rel=0.01)


@pytest.mark.shared
def test_two_scans_of_a_standing_foot_agree(shared_data: Path) -> None:
    folder = shared_data / "feet" / "foot3d_0044"
    feet = [find_foot(read_mesh(folder / name).mesh) for name in ("mesh.obj", "colmap_mesh.obj")]
    assert [(found.candidates[0].side, found.doubts) for found in feet] == [(Side.LEFT, ())] * 2
    first, second = (found.candidates[0] for found in feet)
    turn = first.source2insole[:3, :3] @ second.source2insole[:3, :3].T
    assert rotation_angle_deg(turn) < 3
    # The photogrammetry is 4 mm thicker at the heel and 7 mm longer at the toes, at all heights.
    assert second.length_mm == pytest.approx(first.length_mm, rel=0.04)


def test_three_clicks_some_millimetres_off_tell_the_pose(left_foot: Foot) -> None:
    scan, a2b = thrown(left_foot.mesh, 7)
    length_mm = left_foot.length_mm
    places = np.array(
        [[6, 4, 30], [24, length_mm - 4, 22], [-4, 0.7 * length_mm, 5]], dtype=np.float64
    )
    heel, toe, sole = (tuple(map(float, place)) for place in transform(a2b, places))
    found = find_foot(scan, pose=PoseClicks(heel, toe, sole))
    likely = found.candidates[0]
    assert likely.side is Side.LEFT
    assert rotation_angle_deg((likely.source2insole @ a2b)[:3, :3]) < 1
    assert "were clicked" in found.notes[0]


def test_clicks_on_one_place_are_refused(left_foot: Foot) -> None:
    with pytest.raises(InputError, match="Heel and toe were clicked 5 mm from each other"):
        find_foot(left_foot.mesh, pose=PoseClicks((0, 0, 0), (0, 5, 0), (0, 2, -3)))


def test_a_foot_without_toes_is_taken_of_either_side_or_doubted(left_foot: Foot) -> None:
    short = left_foot.mesh.part(left_foot.mesh.vertices[:, 1] < 0.6 * left_foot.length_mm)
    found = find_foot(thrown(short, 5)[0])
    assert found.doubts
    assert all("mm" in doubt for doubt in found.doubts)


@pytest.mark.parametrize(("medial", "lateral"), [(0.75, 0.95), (0.74, 0.84)])
def test_a_stump_without_single_toes_is_of_no_side_and_shows_no_big_toe(
    medial: float, lateral: float
) -> None:
    """Its front slopes as the toes of the other foot do, so that its outline tells too little."""
    foot = random_foot(4)
    x, y, _ = foot.mesh.vertices.T
    across = np.clip(x * foot.side.medial_sign / 50, -1, 1)
    front = ((medial + lateral) / 2 + (medial - lateral) / 2 * across) * foot.length_mm
    stump = foot.mesh.part(y < front)
    assert seen_side(stump) is None
    assert all(side_doubt(stump, side) == "" for side in Side)
    found = find_foot(thrown(stump, 5)[0])
    assert found.told_side is None
    assert any("does not tell left from right" in doubt for doubt in found.doubts)
    for side in Side:
        candidate = found.best(side)
        assert candidate is not None
        placed = placed_foot(found, candidate)
        assert not is_of_other_side(placed)
        notes = placed.notes
        assert any("does not tell left from right" in note for note in notes)
        assert not any("big toe" in note for note in notes)


@pytest.mark.slow
@pytest.mark.shared
def test_a_residual_limb_is_no_foot(shared_data: Path) -> None:
    examination = examine_scan(shared_data / "feet" / "limb" / "stl_file.stl")
    found = examination.feet[0]
    for side in Side:
        candidate = found.best(side)
        assert candidate is not None
        with pytest.raises(ProportionsError, match="mm"):
            take_foot(examination, found, candidate)


@pytest.mark.slow
@pytest.mark.shared
def test_real_feet_are_sure(scanned_mesh: Callable[[str], TriangleMesh]) -> None:
    for name, side in [
        ("dupontgu/left_foot.stl", Side.LEFT),
        ("dupontgu/right_foot.stl", Side.RIGHT),
        ("focus_template/template.obj", Side.LEFT),
        ("plantar_scan.obj", Side.RIGHT),
    ]:
        found = find_foot(thrown(scanned_mesh(name), 1)[0])
        assert (found.told_side, found.doubts) == (side, ()), name
