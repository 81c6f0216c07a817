"""The measures of a visit keep their ±, and what tells it."""

from __future__ import annotations

from insole_core.foot.spread import UNKNOWN, MeasuredFoot, Spread, SpreadSource
from insole_core.geometry.side import Side
from insole_core.records.visit_measures import (
    StoredMeasure,
    measured_anew,
    measures_to_store,
    stored_measures,
)

FOOT = MeasuredFoot(
    {"foot_length": 251.0, "rearfoot_angle_deg": -3.0, "ball_girth": None},
    {
        "foot_length": Spread(0.8, SpreadSource.REPEATED),
        "rearfoot_angle_deg": Spread(3.0, SpreadSource.SIMULATED),
    },
)


def test_what_is_stored_is_read_with_its_limits() -> None:
    stored = measures_to_store({Side.LEFT: FOOT})
    assert stored["left_foot_length_mm"] == 251.0
    assert stored_measures({**stored, "right_arch_height_mm": 12.5}) == [
        StoredMeasure(
            "foot_length_mm", "foot_length", Side.LEFT, 251.0, FOOT.spread("foot_length")
        ),
        StoredMeasure(
            *("rearfoot_angle_deg", "rearfoot_angle_deg", Side.LEFT, -3.0),
            FOOT.spread("rearfoot_angle_deg"),
        ),
        StoredMeasure("arch_height_mm", "arch_height", Side.RIGHT, 12.5, UNKNOWN),
    ]


def test_a_foot_measured_anew_leaves_nothing_of_before() -> None:
    before = {**measures_to_store({Side.LEFT: FOOT, Side.RIGHT: FOOT})}
    shorter = measures_to_store({Side.LEFT: MeasuredFoot({"foot_length": 250.0}, {})})
    after = measured_anew(before, shorter)
    assert {key for key in after if key.startswith("left")} == {"left_foot_length_mm"}
    assert {key for key in after if key.startswith("right")} == {
        key for key in before if key.startswith("right")
    }
