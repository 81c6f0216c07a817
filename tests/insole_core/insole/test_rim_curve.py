"""The designed rim: stations on the edge, heights between them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.finishing.rim_curve import Rim
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import HEADS_ALONG, Finish, RimStation
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.surface.contact import contact_base


def at(border: str, along: float, height_mm: float, over: str = "heel") -> RimStation:
    return RimStation(border=border, along=along, height_mm=height_mm, over=over)


USUAL = (
    at("medial", 0.0, 12.0), at("medial", 0.2, 12.0), at("medial", 0.45, 18.0),
    at("medial", 0.7, 3.0, "toes"), at("medial", 1.0, 1.0, "toes"),
    at("lateral", 0.2, 12.0), at("lateral", 0.45, 9.0), at("lateral", 0.7, 3.0, "toes"),
)  # fmt: skip


def rim_of(foot: Foot, **keys) -> Rim:
    design = InsoleDesign(foot.side, finish=Finish(rim=USUAL), **keys)
    finished = contact_base(foot, design).finished
    assert finished is not None
    return finished.rim


@pytest.fixture(scope="module")
def rim(left_foot: Foot) -> Rim:
    return rim_of(left_foot)


@pytest.mark.parametrize("side", ["left", "right"])
def test_places_along_the_edge_are_those_of_the_landmarks(left_foot, right_foot, side):
    foot = left_foot if side == "left" else right_foot
    edge, landmarks = rim_of(foot).edge, find_landmarks(foot)
    medial = foot.side.medial_sign
    heel = np.array(edge.point_at(edge.arc_of("medial", 0.0)))
    assert heel == pytest.approx(edge.point_at(edge.arc_of("lateral", 0.0)))
    assert heel[1] == pytest.approx(edge.points_mm[:, 1].min(), abs=0.1)
    for border, head in (("medial", 1), ("lateral", 5)):
        place = np.array(edge.point_at(edge.arc_of(border, HEADS_ALONG)))
        away = np.hypot(*(place - landmarks[f"metatarsal_head_{head}"].point[:2]))
        assert away < 25
        assert (place[0] * medial > 0) == (border == "medial")
    toes = np.array(edge.point_at(edge.arc_of("lateral", 1.0)))
    assert toes[1] == pytest.approx(edge.points_mm[:, 1].max(), abs=0.1)


@pytest.mark.parametrize("border", ["medial", "lateral"])
@pytest.mark.parametrize("over", ["heel", "toes", "foot"])
def test_a_station_is_found_again_at_its_place(rim: Rim, border: str, over: str):
    station = at(border, 0.37, 7.5, over)
    (placed,) = rim.curve((station,)).stations
    again = rim.station_at(placed.arc_mm, placed.height_mm, over)
    assert again.border == border
    assert again.over == over
    assert again.along == pytest.approx(0.37)
    assert again.height_mm == pytest.approx(7.5)


def test_the_rim_passes_through_its_stations_and_never_beyond_them(rim: Rim):
    curve = rim.curve(USUAL)
    heights = [s.height_mm for s in curve.stations]
    for station in curve.stations:
        assert curve.height_at(station.arc_mm) == pytest.approx(station.height_mm, abs=0.7)
    assert min(heights) - 1e-9 <= curve.height_mm.min()
    assert curve.height_mm.max() <= max(heights) + 1e-9
    assert [s.arc_mm for s in curve.stations] == sorted(s.arc_mm for s in curve.stations)
    assert [USUAL[s.number] for s in curve.stations] == [s.station for s in curve.stations]


def test_the_order_of_stations_does_not_matter(rim: Rim):
    turned = rim.curve(USUAL[3:] + USUAL[:3])
    assert np.array_equal(turned.height_mm, rim.curve(USUAL).height_mm)


def test_a_rim_that_goes_up_and_down_is_bent_gently(rim: Rim):
    zigzag = tuple(at("medial", 0.05 * k, 20.0 * (k % 2)) for k in range(14))
    curve, edge = rim.curve(zigzag), rim.edge
    ahead, behind = (edge.at(curve.height_mm, edge.arc_mm + way) for way in (5.0, -5.0))
    assert np.abs(ahead + behind - 2 * curve.height_mm).max() < 0.4
    assert curve.height_mm.min() > -0.5
    assert curve.height_mm.max() < 20.5


def test_a_rim_without_stations_and_one_over_the_foot_follow_the_foot(rim: Rim):
    plain = rim.curve(()).height_mm
    over = rim.curve((at("medial", 0.2, 2.0, "foot"), at("lateral", 0.6, 2.0, "foot"))).height_mm
    assert np.sqrt(((plain - rim.contact_mm) ** 2).mean()) < 1.0
    assert over.mean() == pytest.approx(plain.mean() + 2.0, abs=0.2)
    assert np.abs(over - plain - 2.0).max() < 2.0


def test_two_stations_at_one_place_are_refused_unless_they_agree(rim: Rim):
    with pytest.raises(DesignError, match="at the same place"):
        rim.curve((*USUAL, at("lateral", 0.0, 15.0)))
    agreed = rim.curve((*USUAL, at("lateral", 0.0, 12.0)))
    assert np.allclose(agreed.height_mm, rim.curve(USUAL).height_mm)


def test_a_mirrored_foot_has_the_same_rim(left_foot, right_foot):
    left, right = rim_of(left_foot), rim_of(right_foot)
    assert np.allclose(left.edge.points_mm * [-1, 1], right.edge.points_mm, atol=1e-6)
    assert np.allclose(left.curve(USUAL).height_mm, right.curve(USUAL).height_mm, atol=1e-6)
    assert np.allclose(left.flank_mm, right.flank_mm, atol=1e-3)


def test_the_flank_is_that_of_the_foot(rim: Rim):
    heel = rim.edge.along < 0.1
    assert (rim.flank_mm[heel] > 25).all()
    assert (rim.flank_mm <= 46).all()


def test_a_short_drawn_outline_has_all_its_places(left_foot):
    points = ((0, -4), (30, 40), (32, 110), (0, 140), (-32, 110), (-30, 40))
    drawn = Outline(source="drawn", points_mm=tuple((float(x), float(y)) for x, y in points))
    edge = rim_of(left_foot, outline=drawn).edge
    assert 0 < edge.medial_head_mm < edge.heel_mm < edge.lateral_head_mm < edge.length_mm


def test_the_extent_of_the_outline_does_not_change_the_rim(left_foot):
    full, short = (
        rim_of(left_foot, outline=replace(Outline(), extent=extent))
        for extent in ("full", "three_quarter")
    )
    assert np.array_equal(full.curve(USUAL).height_mm, short.curve(USUAL).height_mm)
