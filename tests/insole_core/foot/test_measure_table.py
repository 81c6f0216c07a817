from __future__ import annotations

from dataclasses import replace

import pytest

from insole_core.foot.foot_placement import place_foot
from insole_core.foot.measure_table import MeasureRow, measure_table, table_csv, unlike_sizes
from insole_core.foot.spread import MeasuredFoot, Spread, SpreadSource
from insole_core.geometry.side import Side

SIMULATED = {"foot_length": Spread(1.2, SpreadSource.SIMULATED)}
LEFT = {"foot_length": 252.0, "heel_width": 66.0, "rearfoot_angle_deg": 4.0, "arch_index": None}
RIGHT = {"foot_length": 248.0, "heel_width": None, "rearfoot_angle_deg": -1.0, "arch_index": 0.2}
BOTH = {
    Side.LEFT: MeasuredFoot(LEFT, SIMULATED),
    Side.RIGHT: MeasuredFoot(RIGHT, {"foot_length": Spread(0.9, SpreadSource.REPEATED)}),
}


def test_the_asymmetry_is_left_minus_right() -> None:
    rows = {row.key: row for row in measure_table(BOTH)}
    assert list(rows) == ["foot_length", "heel_width", "arch_index", "rearfoot_angle_deg"]
    assert rows["foot_length"].difference == pytest.approx(4.0)
    assert rows["foot_length"].percent == pytest.approx(100 * 4 / 250)
    assert rows["rearfoot_angle_deg"].difference == pytest.approx(5.0)
    assert rows["rearfoot_angle_deg"].percent is None
    assert rows["heel_width"].difference is None
    assert rows["arch_index"].percent is None


@pytest.mark.parametrize(
    ("key", "left", "right", "percent"),
    [
        ("arch_height", 0.1, 0.5, None),  # a fraction of a mm would be −133 %
        ("arch_height", 6.0, 5.0, 100 / 5.5),
        ("arch_index", 0.02, 0.06, None),
    ],
)
def test_there_is_no_share_of_what_is_too_small_to_be_told(
    key: str, left: float, right: float, percent: float | None
) -> None:
    feet = {Side.LEFT: MeasuredFoot({key: left}, {}), Side.RIGHT: MeasuredFoot({key: right}, {})}
    (row,) = measure_table(feet)
    assert row.difference == pytest.approx(left - right)
    assert row.percent == (None if percent is None else pytest.approx(percent))


def test_one_foot_has_no_asymmetry() -> None:
    (row, *_) = measure_table({Side.RIGHT: MeasuredFoot(RIGHT, {})})
    assert row == MeasureRow("foot_length", None, 248.0)
    assert (row.difference, row.percent, row.unit) == (None, None, "mm")


def test_the_table_is_read_by_a_spreadsheet() -> None:
    lines = table_csv(measure_table(BOTH)).splitlines()
    assert lines[0] == (
        "measure,unit,left,right,difference,percent,positive,left_limits_95,left_limits_by,"
        "right_limits_95,right_limits_by,difference_limits_95,within_error"
    )
    assert lines[1] == (
        "foot_length,mm,252.000,248.000,4.000,1.600,,1.200,simulation,0.900,repeat test,1.500,no"
    )
    assert lines[2] == "heel_width,mm,66.000,,,,,,unknown,,,,"
    assert lines[4] == "rearfoot_angle_deg,degrees,4.000,-1.000,5.000,,valgus,,unknown,,unknown,,"


@pytest.mark.parametrize(("right", "is_within"), [(250.51, True), (250.49, False)])
def test_a_difference_within_the_error_of_both_feet_has_no_share(
    right: float, is_within: bool
) -> None:
    other = MeasuredFoot({"foot_length": right}, BOTH[Side.RIGHT].spreads)
    (row, *_) = measure_table({**BOTH, Side.RIGHT: other})
    assert row.difference_limits == pytest.approx(1.5)  # the root of the sum of both squares
    assert row.is_within_error is is_within
    assert (row.percent is None) is is_within


def test_lengths_that_are_guesses_are_not_compared(left_mesh, right_foot) -> None:
    toeless = left_mesh.part(left_mesh.vertices[:, 1] < 55)
    guessed = place_foot(toeless, Side.LEFT, frame="reference")
    assert unlike_sizes(replace(guessed, length_mm=guessed.length_mm + 40), right_foot) == ""


def test_feet_of_two_patients_are_noticed(left_foot, right_foot) -> None:
    assert unlike_sizes(left_foot, right_foot) == ""
    longer = replace(right_foot, length_mm=right_foot.length_mm + 20)
    sentence = unlike_sizes(left_foot, longer)
    assert f"{longer.length_mm:.0f} mm" in sentence
    assert "this patient" in sentence
