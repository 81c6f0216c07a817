"""Marks of a pen on the skin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import Landmark, find_landmarks
from insole_core.foot.skin_marks import skin_marks
from insole_core.geometry.side import Side
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="module")
def marked_foot():
    model = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(3), cell_mm=2.2)
    return place_foot(model.mesh, Side.LEFT, frame="reference"), model


def test_pen_cross_is_found_and_offered(marked_foot):
    foot, _ = marked_foot
    (mark,) = skin_marks(foot, find_landmarks(foot))
    head = find_landmarks(foot)["metatarsal_head_2"].point
    assert mark.point[1] == pytest.approx(head[1] - 26, abs=8)  # drawn 26 mm behind the 2nd head
    assert 60 < mark.area_mm2 < 300
    assert mark.landmark == ""
    near = {"sore_spot": Landmark(mark.point + np.array([4.0, 3.0, 0.0]), 0.5)}
    (offered,) = skin_marks(foot, near)
    assert offered.landmark == "sore_spot"
    assert np.array_equal(offered.point, mark.point)


def test_no_colours_no_marks(marked_foot):
    foot, _ = marked_foot
    assert skin_marks(replace(foot, mesh=replace(foot.mesh, colors=None)), {}) == ()
    plain = np.full_like(foot.mesh.vertices, 180, dtype=np.uint8)
    assert skin_marks(replace(foot, mesh=replace(foot.mesh, colors=plain)), {}) == ()
