from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.reconstruct.markers.marker_matching import match_markers

# The sole side of a reference system of the usual kind, and not symmetric.
MARKERS = np.array(
    [
        [-96.0, -120, 19.2], [-96, -64, 19.2], [-88, -24, 9.6], [-96, 40, 28.8],
        [-88, 80, 9.6], [80, -104, 28.8], [88, -64, 28.8], [80, -24, 9.6],
        [80, 40, 28.8], [80, 96, -9.6], [-40, 160, 28.8], [48, 160, 19.2],
    ]
)  # fmt: skip

AWAY_MM = 15.0


def sensor_pose(rng: np.random.Generator) -> FloatArray:
    """A sensor that looks at the sole from up to 45 degrees aside, turned about its axis."""
    axis = np.array([rng.uniform(-0.7, 0.7), rng.uniform(-0.7, 0.7), 1.0])
    axis /= np.linalg.norm(axis)
    right = np.cross(rng.normal(size=3), axis)
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(axis, right), axis], axis=1)
    return rigid(rotation, -rng.uniform(600, 900) * axis)


def look(
    rng: np.random.Generator, hidden: int, clutter: int, noise_mm: float = 1.0
) -> tuple[FloatArray, IntArray]:
    """What the sensor sees: points in its frame, and the marker that each is (-1: none)."""
    seen = rng.permutation(len(MARKERS))[hidden:]
    measured = MARKERS[seen] + rng.normal(0, noise_mm, (len(seen), 3)).clip(-2.5, 2.5)
    others = rng.uniform(MARKERS.min(0) - 150, MARKERS.max(0) + 150, (clutter, 3))
    beside = np.linalg.norm(others[:, None] - MARKERS, axis=2).min(axis=1)
    others = others[beside > AWAY_MM]  # in the place of a hidden marker it would be that marker
    points = transform(inverse(sensor_pose(rng)), np.vstack([measured, others]))
    order = rng.permutation(len(points))
    return points[order], np.concatenate([seen, np.full(len(others), -1)])[order]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 4), st.integers(0, 10))
@example(65535, 2, 7)
def test_finds_who_is_who(seed: int, hidden: int, clutter: int) -> None:
    points, truth = look(np.random.default_rng(seed), hidden, clutter)
    found = match_markers(points, MARKERS)
    used = found.used
    np.testing.assert_array_equal(truth[found.points[used]], found.markers[used])
    assert used.sum() >= len(MARKERS) - hidden - 1


def test_exact_points_are_all_found() -> None:
    points, truth = look(np.random.default_rng(1), hidden=0, clutter=0, noise_mm=0)
    found = match_markers(points, MARKERS)
    np.testing.assert_array_equal(found.markers, np.arange(12))
    np.testing.assert_array_equal(truth[found.points], np.arange(12))
    assert found.used.all()


def test_the_answer_does_not_depend_on_chance() -> None:
    points, _ = look(np.random.default_rng(2), hidden=3, clutter=8)
    first, second = match_markers(points, MARKERS), match_markers(points, MARKERS)
    np.testing.assert_array_equal(first.points, second.points)
    np.testing.assert_array_equal(first.markers, second.markers)


def test_a_badly_measured_marker_is_found_but_not_used() -> None:
    points, truth = look(np.random.default_rng(3), hidden=0, clutter=0, noise_mm=0)
    points[truth == 5] += [0, 0, 11.0]
    found = match_markers(points, MARKERS)
    assert found.markers[~found.used].tolist() == [5]
    assert len(found.markers) == 12


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_a_mirror_image_is_refused(seed: int) -> None:
    points, _ = look(np.random.default_rng(seed), hidden=0, clutter=4)
    with pytest.raises(ReconstructionError, match="mirror"):
        match_markers(points * [-1.0, 1, 1], MARKERS)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_other_points_are_refused(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(MARKERS.min(0), MARKERS.max(0), (14, 3))
    with pytest.raises(ReconstructionError, match="fit the 12 markers"):
        match_markers(points, MARKERS)


def test_a_symmetric_system_is_refused() -> None:
    square = np.array([[x, y, 0.0] for x in (-80, 0, 80) for y in (-80, 80)])
    pose = sensor_pose(np.random.default_rng(4))
    with pytest.raises(ReconstructionError, match="in two ways"):
        match_markers(transform(inverse(pose), square), square)


def test_markers_on_one_side_are_refused() -> None:
    narrow = np.array([[0.0, 25 * i, 22 * (i % 2)] for i in (0, 1, 3, 4, 8, 9)])
    pose = sensor_pose(np.random.default_rng(5))
    with pytest.raises(ReconstructionError, match="almost on one line"):
        match_markers(transform(inverse(pose), narrow), narrow)


def test_no_points_at_all_are_refused() -> None:
    with pytest.raises(ReconstructionError, match="only 0 of the 0"):
        match_markers(np.empty((0, 3)), MARKERS)
