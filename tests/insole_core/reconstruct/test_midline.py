"""Cutting at the mid-line."""

from __future__ import annotations

import numpy as np
import pytest
from small_range_meshes import flat, sheet_of

from insole_core.reconstruct.views.midline import cut_at_midline, fit_midline

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
