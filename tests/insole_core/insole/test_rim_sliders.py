"""Cup and medial flange of a rim, read and set as one number each."""

from __future__ import annotations

import pytest

from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.rim_sliders import (
    cup_depth_mm,
    medial_flange_mm,
    with_cup_depth,
    with_medial_flange,
)


def station(border: str, along: float, height_mm: float, over: str = "heel") -> RimStation:
    return RimStation(border=border, along=along, height_mm=height_mm, over=over)


RIM = (
    station("medial", 0.0, 12),
    station("medial", 0.2, 13),
    station("medial", 0.3, 15),
    station("medial", 0.45, 18),
    station("medial", 0.6, 9),
    station("medial", 0.7, 4, "toes"),
    station("lateral", 0.1, 11),
    station("lateral", 0.3, 8),
    station("lateral", 0.5, 6),
    station("lateral", 1.0, 0, "toes"),
)
FINISH = Finish(rim=RIM)


def heights(finish: Finish) -> list[float]:
    return [s.height_mm for s in finish.rim]


def test_the_numbers_of_a_rim():
    assert cup_depth_mm(FINISH) == 12
    assert medial_flange_mm(FINISH) == 18


def test_a_rim_as_the_foot_has_neither():
    assert cup_depth_mm(Finish()) is None
    assert medial_flange_mm(Finish()) is None


def test_a_deeper_cup_moves_the_heel_alone():
    deeper = with_cup_depth(FINISH, 20)
    assert cup_depth_mm(deeper) == 20
    assert heights(deeper) == pytest.approx([20, 21, 19, 18, 9, 4, 19, 12, 6, 0])
    assert heights(with_cup_depth(deeper, 12)) == pytest.approx(heights(FINISH))


def test_a_higher_flange_moves_the_medial_arch_alone():
    higher = with_medial_flange(FINISH, 23)
    assert medial_flange_mm(higher) == 23
    assert heights(higher) == pytest.approx([12, 13, 17, 23, 11, 4, 11, 8, 6, 0])


@pytest.mark.parametrize("height_mm", [0, 3, 7.5, 12, 18])
def test_a_lowered_flange_is_as_high_as_asked(height_mm):
    lower = with_medial_flange(FINISH, height_mm)
    assert medial_flange_mm(lower) == height_mm
    assert heights(lower)[:2] == [12, 13]
    assert heights(lower)[5:] == heights(FINISH)[5:]


def test_both_are_added_to_a_rim_as_the_foot():
    made = with_medial_flange(with_cup_depth(Finish(), 16), 20)
    assert cup_depth_mm(made) == 16
    assert medial_flange_mm(made) == 20
    places = [(s.border, s.along) for s in made.rim]
    assert len(set(places)) == len(places)
    lateral = [s for s in made.rim if s.border == "lateral" and s.along > 0.4]
    assert {(s.over, s.height_mm) for s in lateral} == {("foot", 0.0)}
