"""The learnt correction on real frames of the Kinect's chip."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from benchmarks.ycb import OBJECTS, Standing, left_mm


@pytest.mark.slow
@pytest.mark.shared
@pytest.mark.parametrize("standing", [OBJECTS[0], OBJECTS[-1]], ids=["bottle", "bowl"])
def test_it_helps_on_what_is_neither_ball_nor_foot(shared_data: Path, standing: Standing) -> None:
    before, after, moved = left_mm(standing)
    assert before.size > 3000
    assert np.mean(before) < 1.3  # the object was found where it stands
    assert moved > 0.5
    assert np.mean(after) < np.mean(before) - 0.03
    assert np.quantile(after, 0.95) < np.quantile(before, 0.95)
