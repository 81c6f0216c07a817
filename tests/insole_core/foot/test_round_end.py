"""Where a round end such as a toe's lies, told by outlines in pictures and by its surface."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.foot.outermost import Border
from insole_core.foot.round_end import Evidence, RoundEnd, UsualEnd, fit_round_end
from insole_core.foot.toe_end import find_toe_end
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import ContourConstraints

AHEAD = np.array([0.0, 1.0, 0.0])
CENTRE, RADIUS = np.array([12.0, 231.0, 20.0]), 8.0
USUAL = UsualEnd((18.0, 4.0), (9.0, 2.0), (9.0, 2.0), (9.0, 2.0))
NOTHING = Border(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))


def normals(upwards_deg: FloatArray) -> FloatArray:
    """Unit normals from -30 to 30 degrees to the sides, at some angles upwards."""
    side, up = np.meshgrid(np.radians(np.linspace(-30, 30, 13)), np.radians(upwards_deg))
    ways = [np.sin(side) * np.cos(up), np.cos(side) * np.cos(up), np.sin(up)]
    return np.stack([way.ravel() for way in ways], axis=1)


def outlines(upwards_deg: float) -> ContourConstraints:
    ways = normals(np.array([upwards_deg]))
    return ContourConstraints(CENTRE + RADIUS * ways, ways)


def fitted(
    touches: ContourConstraints | None, surface: Border = NOTHING, aside_mm: float = 2.5
) -> RoundEnd:
    start = CENTRE + np.array([aside_mm, RADIUS - 1.0, 0.0])
    return fit_round_end(Evidence(surface, touches), AHEAD, start, 8.0, USUAL)


def shell(upwards_deg: FloatArray) -> Border:
    ways = normals(upwards_deg)
    return Border(CENTRE + RADIUS * ways, ways, np.full(len(ways), 2.0))


def test_outlines_from_one_side_tell_the_end_of_a_toe() -> None:
    found = fitted(outlines(-7.0))
    assert found.reach_mm == pytest.approx(CENTRE[1] + RADIUS, abs=0.4)
    assert found.across_mm == pytest.approx(CENTRE[0], abs=0.3)
    assert abs(found.reach_mm - CENTRE[1] - RADIUS) < 2 * found.deviations_mm[0] < 1.5


def test_a_place_along_the_ray_does_not_matter() -> None:
    seen = outlines(-7.0)
    slid = ContourConstraints(
        seen.points + np.array([0.0, 0.0, 3.0]) * seen.normals[:, 1:2], seen.normals
    )
    shifted = ContourConstraints(
        slid.points - np.einsum("kc,kc->k", slid.points - seen.points, seen.normals)[:, None]
        * seen.normals,
        seen.normals,
    )  # fmt: skip
    assert fitted(shifted).reach_mm == pytest.approx(fitted(seen).reach_mm, abs=0.05)


def test_a_toe_beside_it_does_not_move_the_end() -> None:
    alone, beside = outlines(-7.0), outlines(-7.0)
    both = ContourConstraints(
        np.concatenate([alone.points, beside.points + np.array([-15.0, -9.0, 0.0])]),
        np.concatenate([alone.normals, beside.normals]),
    )
    assert fitted(both).across_mm == pytest.approx(CENTRE[0], abs=0.5)
    assert fitted(both).reach_mm == pytest.approx(CENTRE[1] + RADIUS, abs=0.4)


def test_the_outline_beside_the_end_falls_back() -> None:
    found = fitted(outlines(0.0))
    assert found.reach_at(found.across_mm) == pytest.approx(found.reach_mm)
    back = RADIUS - np.sqrt(RADIUS**2 - 4**2)
    assert found.reach_mm - found.reach_at(found.across_mm + 4) == pytest.approx(back, abs=0.4)


@pytest.mark.parametrize("raised_mm", [0.0, 12.0])
def test_a_raised_toe_is_as_long(raised_mm: float) -> None:
    """Seen from below, an end that lies higher would be taken for one that reaches less far."""
    seen = outlines(-7.0)
    lifted = ContourConstraints(seen.points + np.array([0.0, 0.0, raised_mm]), seen.normals)
    start = CENTRE + np.array([1.0, RADIUS - 1.0, raised_mm])
    pulp_mm = CENTRE[2] + raised_mm - 10.0
    tip = find_toe_end(Evidence(NOTHING, lifted), start, pulp_mm, 1.0)
    assert tip.point[1] == pytest.approx(CENTRE[1] + RADIUS, abs=0.4)


def test_a_heel_that_is_round_below_and_nearly_straight_above_is_as_long() -> None:
    """Outlines from a little above to far below its end; one radius for both put it 0.5 mm out."""
    below_mm, above_mm, behind = 10.0, 45.0, -AHEAD
    angles = np.radians(np.linspace(-25, 8, 23))
    way = np.stack([0 * angles, -np.cos(angles), np.sin(angles)], axis=1)
    radius = np.where(angles < 0, below_mm, above_mm)[:, None]
    end = np.array([0.0, 12.0, 22.0])
    points = end + radius * (way - [0.0, -1.0, 0.0])
    usual = UsualEnd((22.0, 8.0), (32.0, 10.0), (30.0, 20.0), (50.0, 25.0))
    seen = Evidence(NOTHING, ContourConstraints(points, way))
    start = end + np.array([1.0, 2.0, 0.0])
    found = fit_round_end(seen, behind, start, 14.0, usual)
    assert -found.reach_mm == pytest.approx(end[1], abs=0.1)
    assert found.height_mm == pytest.approx(end[2], abs=1.0)


def test_a_whole_toe_reaches_as_far_as_its_surface_and_a_cut_one_is_continued() -> None:
    start = CENTRE + np.array([2.0, RADIUS - 1.0, 0.0])
    whole, cut = shell(np.linspace(-60, 60, 41)), shell(np.linspace(-60, -20, 21))
    for surface, most_mm in ((whole, 0.15), (cut, 0.8)):
        tip = find_toe_end(Evidence(surface, None), start, CENTRE[2] - 8.0, 1.0)
        assert tip.point[1] == pytest.approx(CENTRE[1] + RADIUS, abs=most_mm)
        assert tip.point[0] == pytest.approx(CENTRE[0], abs=0.3)
