"""A landmark that is only confirmed is as sure as it was; one that is set by hand is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import (
    Annotations,
    CaseRecord,
    FootRecord,
    Found,
    KeyPoint,
    Patient,
)
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.alignment import PoseAngles
from insole_core.foot.foot import Foot
from insole_core.recording.capture_place import CapturePlace
from insole_core.workflows.foot_landmarks import confirmed, landmarks_of, turned_record
from insole_core.workflows.measured_feet import measured_record

TIP, HEEL = "toe_tip_2", "pternion"
PLACE = CapturePlace(("A1", "B2"), "f" * 64, "2026-11-20T09:00:00+00:00")


@pytest.fixture
def record(left_foot: Foot) -> CaseRecord:
    """A recorded foot whose heel, confirmed before, was known from outlines in the pictures."""
    source = ScanSource("session", "/clinic/left", "0" * 64, place=PLACE)
    heel = tuple(map(float, landmarks_of(FootRecord.begun(left_foot, source))[HEEL].point))
    marks = Annotations((KeyPoint(HEEL, heel, Found(0.4, 1.2, True)),))
    return CaseRecord(Patient("Ö")).with_foot(
        FootRecord.begun(left_foot, source, annotations=marks)
    )


def all_confirmed(record: CaseRecord) -> FootRecord:
    assert record.current is not None
    return replace(record.current, annotations=confirmed(record))


def turned(record: CaseRecord) -> FootRecord:
    return turned_record(record, PoseAngles(yaw_deg=5.0))


@pytest.mark.parametrize("change", [all_confirmed, turned])
def test_confirming_and_turning_make_nothing_surer(
    record: CaseRecord, change: Callable[[CaseRecord], FootRecord]
) -> None:
    before, after = landmarks_of(record), landmarks_of(change(record))
    assert (after[HEEL].confidence, after[HEEL].deviation_mm) == (0.4, 1.2)
    for name in (HEEL, TIP, "metatarsale_tibiale", "metatarsal_head_1"):
        assert after[name].confidence == pytest.approx(before[name].confidence, abs=0.02)
        assert after[name].origin == "shape"
    doubts = measured_record(change(record)).doubts
    assert "pternion" in doubts["foot_length"]


def test_a_place_set_by_hand_stays_so_and_its_measures_have_no_limits(record: CaseRecord) -> None:
    assert record.current is not None
    x, y, z = map(float, landmarks_of(record)[TIP].point)
    marks = record.annotations.with_key_point(KeyPoint(TIP, (x, y + 10, z)))
    by_hand = record.with_foot(replace(record.current, annotations=marks))
    for foot in (all_confirmed(by_hand), turned(by_hand)):
        assert landmarks_of(foot)[TIP].origin == "hand"
        measured = measured_record(foot)
        assert measured.spread("foot_length").limits_95 is None
        assert measured.spread("heel_width").limits_95 is not None


def test_a_case_keeps_what_was_confirmed_and_where_it_was_captured(
    record: CaseRecord, tmp_path: Path
) -> None:
    write_case(record.with_foot(all_confirmed(record)), tmp_path / "c.insole")
    (kept,) = read_case(tmp_path / "c.insole").feet
    assert kept.annotations == confirmed(record)
    assert kept.source.place == PLACE
