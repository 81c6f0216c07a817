"""The toe line: drawn where the toe zone begins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from benchmarks._random_designs import random_foot
from benchmarks.insole_form import mirror_image
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.finishing.toe_zone import toe_line
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.surface.contact import contact_base

RIM = (RimStation(border="medial", along=0.0, height_mm=12.0),)
DRAGGED_MM = (0.0, 4.0, 12.5, 25.0)


@pytest.fixture(scope="module", params=["left", "right", "mirrored", "random"])
def foot(request: pytest.FixtureRequest, left_foot: Foot, right_foot: Foot) -> Foot:
    feet = {
        "left": lambda: left_foot,
        "right": lambda: right_foot,
        "mirrored": lambda: mirror_image(left_foot),
        "random": lambda: random_foot(7),
    }
    made: Foot = feet[request.param]()
    return made


@pytest.mark.parametrize("ahead_mm", DRAGGED_MM)
def test_the_toe_line_lies_where_the_zone_begins(foot: Foot, ahead_mm: float) -> None:
    assert distances_mm(foot, ahead_mm) == pytest.approx(0.0, abs=0.05)


@pytest.mark.shared
@pytest.mark.slow
def test_the_toe_line_of_a_scan_lies_where_the_zone_begins(
    real_foot: Callable[[str, Side], Foot],
) -> None:
    foot = real_foot("dupontgu/left_foot.stl", Side.LEFT)
    for ahead_mm in DRAGGED_MM:
        assert distances_mm(foot, ahead_mm) == pytest.approx(0.0, abs=0.05)


def distances_mm(foot: Foot, ahead_mm: float) -> FloatArray:
    """Return how far the points of the drawn line lie from where the toe zone begins."""
    design = InsoleDesign(foot.side, finish=Finish(toe_line_mm=ahead_mm, rim=RIM))
    base = contact_base(foot, design)
    assert base.finished is not None
    toes = base.finished.toes
    line = toe_line(foot, insole_outline(foot, design, find_landmarks(foot)), ahead_mm)
    assert np.ptp(line[:, 0]) > 50.0
    ahead = replace(base.surface, heights_mm=toes.ahead_mm - toes.begin_mm).height_at(line)
    assert np.isfinite(ahead).all()
    return np.asarray(ahead)
