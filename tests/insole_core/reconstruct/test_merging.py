"""Cutting at the mid-line, and blending the overlap."""

from __future__ import annotations

import numpy as np
import pytest
from small_sheets import flat, sheet_of

from insole_core.reconstruct.midline import cut_at_midline, fit_midline
from insole_core.reconstruct.overlap import blend_overlaps

LEFT, RIGHT = (-100.0, 0.0, -600.0), (100.0, 0.0, -600.0)


def test_the_midline_runs_halfway_between_the_sides() -> None:
    y = np.linspace(0, 200, 401)
    left = np.stack([0.1 * y - 30, y, 0 * y], axis=1)
    right = np.stack([0.1 * y + 50, y, 0 * y], axis=1)
    leg = np.stack([0 * y + 300, y, 0 * y + 100], axis=1)
    offset, slope = fit_midline(np.vstack([left, right, leg]))
    assert offset == pytest.approx(10.0, abs=1.0)
    assert slope == pytest.approx(0.1, abs=0.01)


def test_each_side_comes_from_the_sensor_on_that_side() -> None:
    left, right = cut_at_midline([sheet_of(flat(600.0), LEFT), sheet_of(flat(600.0), RIGHT)])
    assert left.corners[..., 0].max() == pytest.approx(20, abs=10)
    assert right.corners[..., 0].min() == pytest.approx(-20, abs=10)
    assert left.corners[..., 0].min() < -300
    assert right.corners[..., 0].max() > 300


def test_one_side_alone_is_not_cut() -> None:
    sheet = sheet_of(flat(600.0), LEFT)
    (kept,) = cut_at_midline([sheet])
    assert len(kept.triangles) == len(sheet.triangles)


def test_overlapping_views_are_moved_to_their_mean() -> None:
    higher, lower = sheet_of(flat(602.0), LEFT), sheet_of(flat(598.0), RIGHT)
    blended = blend_overlaps([higher, lower])
    middle = [sheet.corners[np.abs(sheet.corners[..., 0]).max(1) < 20] for sheet in blended]
    for corners in middle:
        assert len(corners) > 20
        np.testing.assert_allclose(corners[..., 2], 0.0, atol=0.4)


def test_the_nearer_to_square_view_wins_far_from_the_middle() -> None:
    left, right = blend_overlaps([sheet_of(flat(600.0), LEFT), sheet_of(flat(600.0), RIGHT)])
    assert left.corners[..., 0].min() < -300
    assert left.corners[..., 0].max() < 150
    assert right.corners[..., 0].min() > -150


def test_views_of_different_things_do_not_pull_on_each_other() -> None:
    near, far = sheet_of(flat(600.0), LEFT), sheet_of(flat(640.0), RIGHT)
    blended = blend_overlaps([near, far])
    assert [len(sheet.triangles) for sheet in blended] == [len(near.triangles), len(far.triangles)]
    np.testing.assert_array_equal(blended[0].corners, near.corners)


def test_a_single_view_stays_as_it_is() -> None:
    sheet = sheet_of(flat(600.0), LEFT)
    (kept,) = blend_overlaps([sheet])
    np.testing.assert_array_equal(kept.corners, sheet.corners)
