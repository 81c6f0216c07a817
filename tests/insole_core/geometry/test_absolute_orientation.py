from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.errors import ReconstructionError
from insole_core.geometry.absolute_orientation import absolute_orientation
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import is_rotation, rotation_about

CORNERS = np.array([[0.0, 0, 0], [90, 0, 0], [0, 60, 0], [10, 20, 40]])


@st.composite
def motions(draw: st.DrawFn) -> tuple[FloatArray, FloatArray]:
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    angle = draw(st.floats(-180, 180))
    return rotation_about(rng.normal(size=3), angle), rng.normal(0, 500, 3)


@given(motions(), st.integers(3, 20), st.integers(0, 1000))
def test_recovers_any_rigid_motion(
    motion: tuple[FloatArray, FloatArray], count: int, seed: int
) -> None:
    rotation, translation = motion
    points = np.random.default_rng(seed).normal(0, 100, (count, 3))
    found = absolute_orientation(points, points @ rotation.T + translation)
    np.testing.assert_allclose(found.rotation, rotation, atol=1e-9)
    np.testing.assert_allclose(found.translation_mm, translation, atol=1e-6)


@given(motions(), st.floats(0.2, 5))
def test_recovers_the_scale_when_asked(motion: tuple[FloatArray, FloatArray], scale: float) -> None:
    rotation, translation = motion
    target = scale * CORNERS @ rotation.T + translation
    found = absolute_orientation(CORNERS, target, scaled=True)
    assert found.scale == pytest.approx(scale)
    np.testing.assert_allclose(CORNERS @ found.a2b[:3, :3].T + found.a2b[:3, 3], target, atol=1e-6)


@given(st.integers(0, 1000))
def test_never_answers_with_a_reflection(seed: int) -> None:
    points = np.random.default_rng(seed).normal(0, 100, (6, 3))
    assert is_rotation(absolute_orientation(points, points * [-1, 1, 1]).rotation)


def test_a_point_of_no_weight_does_not_count() -> None:
    target = CORNERS + np.array([1.0, 2, 3])
    spoiled = np.vstack([target, [500.0, 500, 500]])
    source = np.vstack([CORNERS, [0.0, 0, 99]])
    found = absolute_orientation(source, spoiled, np.array([1.0, 2, 1, 3, 0]))
    np.testing.assert_allclose(found.a2b[:3, 3], [1, 2, 3], atol=1e-9)


def test_a_heavier_point_is_met_more_closely() -> None:
    target = CORNERS.copy()
    target[3] += [0.0, 0, 8]

    def error(weight: float) -> float:
        a2b = absolute_orientation(CORNERS, target, np.array([1.0, 1, 1, weight])).a2b
        return float(np.linalg.norm(CORNERS[3] @ a2b[:3, :3].T + a2b[:3, 3] - target[3]))

    assert error(100) < error(1) / 5


def test_two_points_are_refused() -> None:
    with pytest.raises(ReconstructionError, match="only 2 were given"):
        absolute_orientation(CORNERS[:2], CORNERS[:2])


def test_points_on_one_line_are_refused() -> None:
    line = np.outer(np.arange(5.0), [3.0, -2, 7])
    with pytest.raises(ReconstructionError, match="on one line"):
        absolute_orientation(line, line + 1)


def test_points_that_weigh_nothing_do_not_make_a_line_a_plane() -> None:
    line = np.vstack([np.outer(np.arange(4.0), [1.0, 0, 0]), [0, 50, 0]])
    with pytest.raises(ReconstructionError, match="on one line"):
        absolute_orientation(line, line, np.array([1.0, 1, 1, 1, 0]))
