"""A foot with its leg, in any pose; what is doubtful is said, what is none is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.foot.foot_placement import find_foot, place_foot
from insole_core.foot.foot_proportions import ProportionsError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_angle_deg, transform
from insole_core.scans.mesh_file import read_mesh


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


@pytest.mark.parametrize("degrees", [0, 60])
def test_a_foot_with_a_long_leg_is_found(left_foot: Foot, degrees: float) -> None:
    scan, a2b = thrown(pointed(left_foot, degrees), 4)
    found = find_foot(scan)
    likely = found.candidates[0]
    assert (likely.side, found.doubts) == (Side.LEFT, ())
    assert likely.length_mm == pytest.approx(left_foot.length_mm, rel=0.01)
    assert rotation_angle_deg((likely.source2insole @ a2b)[:3, :3]) < 3


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


def test_a_candidate_found_before_is_taken_as_it_is(left_foot: Foot) -> None:
    before = find_foot(thrown(left_foot.mesh, 2)[0]).candidates[0]
    again = find_foot(thrown(left_foot.mesh, 2)[0], pose=before)
    assert again.candidates == (before,)
    assert again.doubts == ()


def test_a_foot_without_toes_is_taken_of_either_side_or_doubted(left_foot: Foot) -> None:
    short = left_foot.mesh.part(left_foot.mesh.vertices[:, 1] < 0.6 * left_foot.length_mm)
    found = find_foot(thrown(short, 5)[0])
    assert found.doubts
    assert all("mm" in doubt for doubt in found.doubts)


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize("side", list(Side))
def test_a_residual_limb_is_no_foot(shared_data: Path, side: Side) -> None:
    mesh = read_mesh(shared_data / "feet" / "limb" / "stl_file.stl").mesh
    with pytest.raises(ProportionsError, match="mm"):
        place_foot(mesh, side, frame="unknown")


@pytest.mark.slow
@pytest.mark.shared
def test_real_feet_are_sure(shared_data: Path) -> None:
    for name, side in [
        ("dupontgu/left_foot.stl", Side.LEFT),
        ("dupontgu/right_foot.stl", Side.RIGHT),
        ("focus_template/template.obj", Side.LEFT),
        ("plantar_scan.obj", Side.RIGHT),
    ]:
        found = find_foot(thrown(read_mesh(shared_data / "feet" / name).mesh, 1)[0])
        assert (found.told_side, found.doubts) == (side, ()), name
