"""The front edge of short shells, and their width."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.trim_line import trim_points
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell


@pytest.fixture(params=["left_foot", "right_foot"])
def foot(request: pytest.FixtureRequest) -> Foot:
    found: Foot = request.getfixturevalue(request.param)
    return found


def outline(foot: Foot, *points: tuple[float, float], **values: Any) -> FloatArray:
    """Outline of a short shell; points are given with medial = +x."""
    sign = foot.side.medial_sign
    trim = tuple((sign * x, y) for x, y in points) or None
    design = InsoleDesign(
        foot.side, outline=Outline(extent="three_quarter", **values), shell=Shell(trim_mm=trim)
    )
    return insole_outline(foot, design, find_landmarks(foot))


def test_the_usual_line_ends_behind_the_heads(foot: Foot):
    heads = find_landmarks(foot)
    first, fifth = (heads[f"metatarsal_head_{n}"].point[:2] for n in (1, 5))
    medial, middle, lateral = np.array(trim_points(Shell(), foot.side, heads))
    assert first - medial == pytest.approx([0, 11])
    assert fifth - lateral == pytest.approx([0, 10])
    assert middle - (medial + lateral) / 2 == pytest.approx([0, 4])
    curve = outline(foot)
    assert np.hypot(*(curve - middle).T).min() < 0.7
    assert curve[:, 1].max() < max(first[1], fifth[1])


def test_the_edge_runs_through_the_points(foot: Foot):
    points = ((35.0, 150.0), (8.0, 156.0), (-8.0, 150.0), (-32.0, 138.0))
    curve = outline(foot, *points)
    for x, y in points[1:3]:
        place = np.array([foot.side.medial_sign * x, y])
        assert np.hypot(*(curve - place).T).min() < 0.7
    heading = np.unwrap(np.arctan2(*(np.roll(curve, -1, axis=0) - curve).T[::-1]))
    step = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T).mean()
    assert np.abs(np.diff(heading)).max() / step < 1 / 6  # no radius below 6 mm


def test_a_mirrored_line_gives_the_mirrored_outline(left_foot: Foot, right_foot: Foot):
    points = ((35.0, 150.0), (5.0, 160.0), (-25.0, 140.0))
    left, right = outline(left_foot, *points), outline(right_foot, *points)
    assert np.roll(left[::-1], 1, axis=0) * [-1, 1] == pytest.approx(right, abs=1e-6)


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        (((35.0, 400.0), (-35.0, 390.0)), "Point 1 of the trim line.*lies beside the insole"),
        (((35.0, 150.0), (-90.0, 150.0)), "Point 2 of the trim line.*lies beside the insole"),
        (((40.0, 60.0), (-40.0, 60.0)), "leaves only .* mm of the insole"),
        (((40.0, 262.0), (-40.0, 262.0)), "does not cross the insole"),
        (((46.0, 165.0), (42.0, 210.0), (30.0, 150.0), (-30.0, 150.0)), "crosses the edge|^$"),
    ],
)
def test_a_line_that_leaves_no_shell_is_refused(foot: Foot, points, reason):
    if reason.endswith("|^$"):
        outline(foot, *points)
        return
    with pytest.raises(DesignError, match=reason):
        outline(foot, *points)


@pytest.mark.parametrize("width_mm", [-3.2, 0.0, 3.2])
@pytest.mark.parametrize("extent", ["full", "three_quarter"])
def test_the_width_is_counted_from_the_first_metatarsal(foot: Foot, width_mm: float, extent: str):
    sign = foot.side.medial_sign
    design = InsoleDesign(foot.side, outline=Outline(extent=extent, width_mm=width_mm))
    curve = insole_outline(foot, design, find_landmarks(foot)) * [sign, 1]
    usual = insole_outline(foot, InsoleDesign(foot.side), {}) * [sign, 1]
    head = find_landmarks(foot)["metatarsal_head_1"].point[:2] * [sign, 1]
    if extent == "full":
        beside = curve[(np.abs(curve[:, 1] - head[1]) < 2) & (curve[:, 0] > 0), 0].mean()
        assert beside == pytest.approx(head[0] + width_mm, abs=1.0)
    else:
        whole = replace(design, outline=replace(design.outline, extent="full"))
        long = insole_outline(foot, whole, {}) * [sign, 1]
        kept = curve[curve[:, 1] < head[1] - 80]
        assert np.hypot(*(kept[:, None] - long[None]).transpose(2, 0, 1)).min(axis=1).max() < 0.7
    for part in (usual[:, 1] < 50, usual[:, 0] < -10):
        far = usual[part & (usual[:, 1] < 0.4 * foot.length_mm)]
        gaps = np.hypot(*(far[:, None] - curve[None]).transpose(2, 0, 1)).min(axis=1)
        assert gaps.max() < 1.0


def test_the_width_is_that_of_both_sides(left_foot: Foot, right_foot: Foot):
    left, right = (
        insole_outline(each, InsoleDesign(each.side, outline=Outline(width_mm=-3.2)), {})
        for each in (left_foot, right_foot)
    )
    assert np.roll(left[::-1], 1, axis=0) * [-1, 1] == pytest.approx(right, abs=1e-6)
    assert left_foot.side is Side.LEFT
