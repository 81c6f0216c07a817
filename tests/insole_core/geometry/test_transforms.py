"""Rigid transforms: known answers and the laws of a group."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from insole_core.geometry.transforms import (
    inverse,
    is_rotation,
    rigid,
    rotation_about,
    rotation_angle_deg,
    rotations_by,
    transform,
)

numbers = st.floats(-500, 500)
vectors = st.tuples(numbers, numbers, numbers).map(np.array)


def test_quarter_turn_about_z_brings_x_to_y() -> None:
    a2b = rigid(rotation_about(np.array([0.0, 0, 1]), 90), np.array([1.0, 2, 3]))
    np.testing.assert_allclose(transform(a2b, np.array([10.0, 0, 0])), [1, 12, 3], atol=1e-12)


@given(vectors, vectors, vectors)
def test_inverse_undoes(turn: np.ndarray, shift: np.ndarray, point: np.ndarray) -> None:
    a2b = rigid(Rotation.from_rotvec(turn / 100).as_matrix(), shift)
    np.testing.assert_allclose(transform(inverse(a2b), transform(a2b, point)), point, atol=1e-9)


@given(st.floats(1e-6, 179.99))
def test_angle_is_recovered_even_when_tiny(angle_deg: float) -> None:
    rotation = rotation_about(np.array([0.3, -2, 1]), angle_deg)
    assert rotation_angle_deg(rotation) == pytest.approx(angle_deg, rel=1e-6)


def test_a_mirror_is_no_rotation() -> None:
    assert is_rotation(rotation_about(np.array([1.0, 1, 0]), 33))
    assert not is_rotation(np.diag([-1.0, 1, 1]))
    assert not is_rotation(np.diag([1.0, 1, 1.01]))
    assert not is_rotation(np.full((3, 3), np.nan))
    assert not is_rotation(np.eye(2))


@given(vectors)
def test_rotation_vectors_turn_like_their_axis_and_angle(vector: np.ndarray) -> None:
    turn = vector / 100
    np.testing.assert_allclose(
        rotations_by(turn[None])[0], Rotation.from_rotvec(turn).as_matrix(), atol=1e-12
    )
