"""Each measure says how far it may be off, and by what."""

from __future__ import annotations

from dataclasses import replace

import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import TOE_TIPS, Landmark, Landmarks, find_landmarks
from insole_core.foot.measures import DEFINITIONS, deviations_mm
from insole_core.foot.spread import (
    FOREIGN,
    UNKNOWN,
    SpreadSource,
    explained,
    measure_foot,
    spread_text,
    spreads_of,
)
from insole_core.foot.toe_end import MERGED


@pytest.fixture(scope="module")
def outlined(left_foot: Foot) -> Landmarks:
    """Landmarks as outlines in the pictures give them, known to 0.3 mm."""
    marks = find_landmarks(left_foot)
    return {name: replace(mark, deviation_mm=0.3) for name, mark in marks.items()}


def test_nothing_is_known_of_the_file_of_another_scanner(left_foot: Foot) -> None:
    measured = measure_foot(left_foot, find_landmarks(left_foot), is_recorded=False)
    assert set(measured.spreads.values()) == {FOREIGN}
    told = measured.limits_json(["foot_length", "navicular_height"])
    assert told == {
        "limits_95": {"foot_length": None},
        "limits_by": {"foot_length": "another scanner"},
    }
    assert spread_text("foot_length", None) == "± ?"
    assert explained([FOREIGN, FOREIGN]) == ["± ?: not known of another scanner's file"]
    assert explained([UNKNOWN]) == ["± ?: not known for this value"]


def test_a_recorded_foot_has_the_limits_of_simulated_captures(outlined: Landmarks) -> None:
    found = spreads_of(outlined, is_recorded=True)
    length = found["foot_length"]
    assert length.source is SpreadSource.SIMULATED
    assert length.limits_95 == pytest.approx(2 * deviations_mm(outlined)["foot_length"])
    assert found["arch_height"].limits_95 == 2 * DEFINITIONS["arch_height"].deviation
    assert found["ball_girth"] == UNKNOWN  # no simulated capture shows the back of the foot
    assert spread_text("foot_length", 0.849) == "± 0.8"
    assert spread_text("arch_index", 0.02) == "± 0.02"


def test_the_length_is_less_sure_where_the_longest_toe_does_not_stand_out(
    outlined: Landmarks,
) -> None:
    toes = {name: replace(outlined[name], confidence=MERGED) for name in TOE_TIPS}
    apart, merged = (
        spreads_of(marks, is_recorded=True)["foot_length"].limits_95
        for marks in (outlined, {**outlined, **toes})
    )
    assert apart == pytest.approx(0.8, abs=0.1)  # 39 such feet: 0.46 mm rms, so 0.9
    assert merged == pytest.approx(2.5, abs=0.1)  # 21 feet: 1.2 mm rms


def test_sizes_are_as_uncertain_as_the_length_in_their_own_steps(outlined: Landmarks) -> None:
    found = spreads_of(outlined, is_recorded=True, repeated={"foot_length": 3.5})
    assert found["shoe_size_eu"].limits_95 == 1.0  # 3.5 mm are more than half a Paris point
    assert found["shoe_size_uk"].limits_95 == 0.5
    assert found["mondopoint"].limits_95 == 5.0


def test_the_repeat_test_of_the_place_counts_where_the_foot_was_seen_as_in_it(
    outlined: Landmarks,
) -> None:
    tested = {"foot_length": 0.4, "ball_girth": 1.1}
    found = spreads_of(outlined, is_recorded=True, repeated=tested)
    assert found["foot_length"].source is SpreadSource.REPEATED
    assert found["foot_length"].limits_95 == 0.4
    assert found["ball_girth"].limits_95 == 1.1
    assert found["heel_width"].source is SpreadSource.SIMULATED
    heel = replace(outlined["pternion"], confidence=0.4, deviation_mm=1.5)
    badly_seen = spreads_of({**outlined, "pternion": heel}, is_recorded=True, repeated=tested)
    assert badly_seen["foot_length"].source is SpreadSource.SIMULATED
    assert badly_seen["foot_length"].limits_95 > 2
    guessed = {**outlined, "pternion": replace(heel, deviation_mm=None)}
    assert spreads_of(guessed, is_recorded=True, repeated=tested)["foot_length"] == UNKNOWN


MOVED = [
    ("toe_tip_2", {"foot_length", "ball_length", "ball_width_across", "shoe_size_eu"}),
    ("heel_medial", {"heel_width"}),
    ("arch_apex", {"arch_height"}),
    ("achilles_upper", {"rearfoot_angle_deg", "achilles_angle_deg", "achilles_lean_deg"}),
]


@pytest.mark.parametrize(("name", "lost"), MOVED)
def test_what_rests_on_a_place_set_by_hand_has_no_limits(
    outlined: Landmarks, name: str, lost: set[str]
) -> None:
    tested = dict.fromkeys(DEFINITIONS, 0.4)
    moved = {**outlined, name: Landmark(outlined["pternion"].point, 1.0, "hand")}
    before = spreads_of(outlined, is_recorded=True, repeated=tested)
    found = spreads_of(moved, is_recorded=True, repeated=tested)
    changed = {key for key in DEFINITIONS if found[key] != before[key]}
    assert lost <= changed
    assert {found[key] for key in changed} == {UNKNOWN}
    assert not changed & ({"heel_width", "ball_width", "ball_girth"} - lost)
