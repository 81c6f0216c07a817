"""No measure is given that the scan cannot carry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measure_table import measure_table, table_csv
from insole_core.foot.measures import MISSING, NOT_MARKED, doubts, measure
from insole_core.foot.spread import measure_foot
from insole_core.foot.tape import tape_length
from insole_core.geometry.arrays import BoolArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side

LEG = {"rearfoot_angle_deg", "achilles_angle_deg", "achilles_lean_deg"}
BACK = {"ball_girth", "instep_height", "arch_height_index"}
SIZES = {"shoe_size_eu", "shoe_size_uk", "shoe_size_us", "mondopoint"}


def missing(foot: Foot) -> set[str]:
    measures = measure(foot, find_landmarks(foot))
    return {name for name, value in measures.items() if value is None} - NOT_MARKED


def x_y_z(mesh: TriangleMesh) -> tuple[np.ndarray, ...]:
    return tuple(mesh.vertices.T)


def no_toes(mesh: TriangleMesh) -> BoolArray:
    return mesh.vertices[:, 1] < 55


def no_heel(mesh: TriangleMesh) -> BoolArray:
    return mesh.vertices[:, 1] > -60


def low_part(mesh: TriangleMesh) -> BoolArray:
    return mesh.vertices[:, 2] < 30


def half_back(mesh: TriangleMesh) -> BoolArray:
    x, _, z = x_y_z(mesh)
    return (z < 20) | (x < 0)


def hole_in_arch(mesh: TriangleMesh) -> BoolArray:
    x, y, z = x_y_z(mesh)
    return (np.hypot(x - 10, y) > 20) | (z > 40)


def hole_in_heel(mesh: TriangleMesh) -> BoolArray:
    x, y, z = x_y_z(mesh)
    return (np.hypot(x, y + 80) > 15) | (z > 20)


def hole_beside_ball(mesh: TriangleMesh) -> BoolArray:
    x, y, z = x_y_z(mesh)
    return (x < 35) | (np.abs(y - 55) > 15) | (z > 60)


@pytest.mark.parametrize(
    ("kept", "absent"),
    [
        (no_toes, {"foot_length", "arch_index", "instep_height", "arch_height_index"} | SIZES),
        (
            no_heel,
            {"foot_length", "ball_length", "heel_width", "arch_height", "arch_index"}
            | {"instep_height", "arch_height_index", "forefoot_angle_deg"} | SIZES | LEG,
        ),
        (low_part, BACK | LEG),
        (half_back, BACK | LEG),
        (hole_in_arch, {"arch_height"}),
        (hole_in_heel, {"arch_height", "arch_index", "forefoot_angle_deg"}),
        (hole_beside_ball, {"ball_girth"}),
    ],
)  # fmt: skip
def test_what_was_not_scanned_is_not_measured(
    left_mesh: TriangleMesh, kept: Callable[[TriangleMesh], BoolArray], absent: set[str]
) -> None:
    foot = place_foot(left_mesh.part(kept(left_mesh)), Side.LEFT, frame="reference")
    assert missing(foot) == absent
    assert absent <= MISSING.keys()


def test_a_whole_foot_has_every_measure(left_foot: Foot) -> None:
    assert missing(left_foot) == set()


def test_it_is_not_compared_with_the_other_foot(left_foot: Foot, right_mesh: TriangleMesh) -> None:
    x, _, z = x_y_z(right_mesh)
    half = place_foot(right_mesh.part((z < 20) | (x > 0)), Side.RIGHT, frame="reference")
    rows = measure_table(
        {
            foot.side: measure_foot(foot, find_landmarks(foot), is_recorded=False)
            for foot in (left_foot, half)
        }
    )
    (girth,) = (row for row in rows if row.key == "ball_girth")
    assert girth.left == pytest.approx(236, abs=10)
    assert (girth.right, girth.difference, girth.percent) == (None, None, None)
    (line,) = (line for line in table_csv(rows).splitlines() if line.startswith("ball_girth"))
    assert line.endswith(",,,")


@pytest.mark.slow
@pytest.mark.shared
def test_girth_of_a_fused_foot_is_not_made_up(recorded_foot: Callable[[str], Foot]) -> None:
    assert missing(recorded_foot("right_b")) == BACK


def ring(shares: np.ndarray) -> np.ndarray:
    """Segments of a circle of 30 mm."""
    angle = 2 * np.pi * shares
    points = 30 * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.stack([points[:-1], points[1:]], axis=1)


@pytest.mark.parametrize(
    ("end", "length"), [(1.0, 2 * np.pi * 30), (0.96, 2 * np.pi * 30), (0.9, None), (0.4, None)]
)
def test_a_tape_bridges_small_gaps_only(end: float, length: float | None) -> None:
    found = tape_length(ring(np.linspace(0, end, 300)))
    assert found == (length if length is None else pytest.approx(length, abs=0.1))


def test_a_tape_lies_over_hollows() -> None:
    along = np.linspace(0, 1, 400)
    hollow = ring(along) * (1 - 0.2 * (np.abs(along[:-1] - 0.3) < 0.1))[:, None, None]
    assert tape_length(hollow) == pytest.approx(2 * np.pi * 30, abs=4)


CROPPED = {
    "medial": (0, 1.0, {"ball_width", "ball_width_across", "ball_length", "ball_girth"}),
    "lateral": (0, -1.0, {"ball_width", "ball_width_across", "ball_girth"}),
    "behind": (1, -1.0, {"foot_length", "ball_length"}),
}
"""Axis and end of the lower foot that is missing, and measures that lean on it."""


@pytest.mark.parametrize("cut_mm", [1.0, 12.0])
@pytest.mark.parametrize("end", CROPPED)
def test_an_end_that_was_cropped_is_told(left_mesh: TriangleMesh, end: str, cut_mm: float) -> None:
    axis, sign, leaning = CROPPED[end]
    along = sign * left_mesh.vertices[:, axis]
    most = along[left_mesh.vertices[:, 2] < 45].max()
    foot = place_foot(left_mesh.part(along < most - cut_mm), Side.LEFT, frame="reference")
    found = find_landmarks(foot)
    told = set(doubts(found)) | {name for name, value in measure(foot, found).items() if not value}
    assert leaning <= told


def test_no_end_of_a_whole_foot_or_of_one_cut_elsewhere_is_doubted(left_mesh: TriangleMesh) -> None:
    x, y, z = x_y_z(left_mesh)
    for kept in (z < 1000, z < 60, (np.hypot(x - 10, y) > 20) | (z > 40)):
        foot = place_foot(left_mesh.part(kept), Side.LEFT, frame="reference")
        assert not {"foot_length", "ball_width", "heel_width"} & set(doubts(find_landmarks(foot)))


@pytest.mark.parametrize(
    ("missing", "leaning"),
    [
        (lambda x, y: y < 12, {"ball_width", "ball_width_across", "ball_girth"}),
        (lambda x, y: y > 225, {"ball_width", "ball_girth", "forefoot_angle_deg"}),
        (lambda x, y: (y > 170) & (x > 22), {"foot_length", "instep_height", "shoe_size_eu"}),
    ],
    ids=["heel", "toes", "side of the big toe"],
)
def test_what_leans_on_a_missing_end_is_told(left_foot: Foot, missing, leaning: set[str]) -> None:
    x, y, _ = left_foot.mesh.vertices.T
    part = left_foot.mesh.part(~missing(x * left_foot.side.medial_sign, y))
    cut = replace(left_foot, mesh=part)
    found = find_landmarks(cut)
    told = set(doubts(found)) | {name for name, value in measure(cut, found).items() if not value}
    assert leaning <= told
