"""Lines of equal height lie on the surface, at whole steps."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.sections import level_lines

TRIANGLE = np.array([[0, 1, 2]], dtype=np.int32)


def test_a_slope_is_crossed_at_every_step() -> None:
    vertices = np.array([[0.0, 0.0, 0.5], [10.0, 0.0, 0.5], [0.0, 10.0, 4.5]])
    lines = level_lines(vertices, TRIANGLE, 1.0)
    assert sorted(lines.number) == [1, 2, 3, 4]
    np.testing.assert_allclose(lines.segments[..., 2], lines.number[:, None] * np.ones(2))
    length = np.linalg.norm(np.diff(lines.segments, axis=1)[:, 0], axis=1)
    # At height z the triangle is 10 - 2.5 (z - 0.5) wide.
    assert length == pytest.approx(10 - 2.5 * (lines.number - 0.5))


def test_a_level_surface_has_no_line() -> None:
    vertices = np.array([[0.0, 0.0, 2.0], [10.0, 0.0, 2.0], [0.0, 10.0, 2.0]])
    assert len(level_lines(vertices, TRIANGLE, 1.0).segments) == 0


def test_steps_need_not_be_millimetres_and_heights_may_be_negative() -> None:
    vertices = np.array([[0.0, 0.0, -1.2], [10.0, 3.0, 0.1], [0.0, 10.0, 1.3]])
    lines = level_lines(vertices, TRIANGLE, 0.5)
    assert sorted(lines.number) == [-2, -1, 0, 1, 2]
    np.testing.assert_allclose(lines.segments[..., 2], 0.5 * lines.number[:, None] * np.ones(2))
    assert (lines.triangle == 0).all()
