from __future__ import annotations

from typing import Any

import pytest

from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, KeyPoint, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.case import Case

SOURCE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


@pytest.fixture
def case(make_foot: Any) -> Case:
    case = Case()
    case.open_foot(make_foot(Side.LEFT), SOURCE)
    return case


def with_height(design: InsoleDesign | None, height_mm: float) -> InsoleDesign:
    assert design is not None
    pad = Pelott(id="pad", centre_mm=(0.0, 150.0), height_mm=height_mm)
    if design.correction("pad") is None:
        return design.with_added(pad)
    return design.with_changed(pad)


def test_undo_and_redo_swap_the_values(case: Case) -> None:
    empty = case.record.design
    case.apply(with_height(empty, 6), "Place")
    placed = case.record.design
    case.apply(Patient(name="Anna"), "Name")
    assert case.history.undo_sentence == "Name"
    case.undo()
    assert case.record.patient == Patient()
    case.undo()
    assert case.record.design is empty
    assert case.history.redo_sentence == "Place"
    case.redo()
    assert case.record.design is placed


def test_steps_of_one_key_are_one_undo(case: Case) -> None:
    case.apply(with_height(case.record.design, 6), "Place")
    for height in (7, 8, 9):
        case.apply(with_height(case.record.design, height), "Raise", "pad:height")
    case.undo()
    assert case.record.design == with_height(case.record.design, 6)
    case.apply(with_height(case.record.design, 7), "Raise", "pad:height")
    case.apply(with_height(case.record.design, 8), "Raise", "pad:height")
    assert len(case.history) == 2


def test_other_keys_and_an_undo_end_the_merging(case: Case) -> None:
    case.apply(with_height(case.record.design, 6), "Place")
    case.apply(with_height(case.record.design, 7), "Raise", "a")
    case.apply(with_height(case.record.design, 8), "Raise", "b")
    case.undo()
    case.redo()
    case.apply(with_height(case.record.design, 9), "Raise", "b")
    assert len(case.history) == 4


def test_a_change_that_changes_nothing_is_no_step(case: Case) -> None:
    design = case.record.design
    assert design is not None
    case.apply(InsoleDesign(side=design.side), "Nothing")
    assert len(case.history) == 0


def test_a_preview_is_shown_but_not_made(case: Case) -> None:
    record = case.record
    case.preview(with_height(record.design, 6))
    assert case.shown.design != record.design
    assert case.record is record
    case.end_preview()
    assert case.shown is record
    assert len(case.history) == 0


def test_the_selection_does_not_outlive_its_correction(case: Case) -> None:
    case.apply(with_height(case.record.design, 6), "Place")
    case.select("pad")
    case.undo()
    assert case.selection is None


def test_a_new_foot_keeps_the_patient_and_forgets_the_rest(case: Case, make_foot: Any) -> None:
    case.apply(Patient(name="Anna"), "Name")
    case.apply(Annotations((KeyPoint("Heel", (0.0, 0.0, 0.0)),)), "Mark")
    case.open_foot(make_foot(Side.RIGHT), SOURCE)
    assert case.record.patient.name == "Anna"
    assert case.record.annotations == Annotations()
    assert case.side is Side.RIGHT
    assert len(case.history) == 0


def test_ten_thousand_edits_and_back(case: Case) -> None:
    first = case.record
    for number in range(10_000):
        case.apply(Patient(notes=str(number)), "Type")
    for _ in range(10_000):
        case.undo()
    assert case.record is first


@pytest.fixture
def two_feet(case: Case, make_foot: Any) -> Case:
    case.apply(FootRecord.begun(make_foot(Side.RIGHT), SOURCE), "Add the right foot")
    return case


def test_a_second_foot_comes_to_hand_and_goes_with_undo(two_feet: Case) -> None:
    assert two_feet.side is Side.RIGHT
    assert len(two_feet.record.feet) == 2
    two_feet.undo()
    assert two_feet.side is Side.LEFT
    assert len(two_feet.record.feet) == 1
    two_feet.redo()
    assert two_feet.side is Side.RIGHT


def test_undo_leads_to_the_foot_where_the_change_was(two_feet: Case) -> None:
    two_feet.apply(with_height(two_feet.record.design, 6), "Place on the right")
    two_feet.take_foot(Side.LEFT)
    two_feet.apply(with_height(two_feet.record.design, 7), "Place on the left")
    two_feet.take_foot(Side.RIGHT)
    two_feet.undo()
    assert two_feet.side is Side.LEFT
    assert two_feet.record.design == InsoleDesign(Side.LEFT)
    two_feet.undo()
    assert two_feet.side is Side.RIGHT
    assert two_feet.record.design == InsoleDesign(Side.RIGHT)
    two_feet.redo()
    assert two_feet.side is Side.RIGHT


def test_taking_the_other_foot_is_no_change(two_feet: Case, tmp_path: Any) -> None:
    two_feet.mark_saved(two_feet.record, tmp_path / "a.insole")
    two_feet.take_foot(Side.LEFT)
    assert two_feet.side is Side.LEFT
    assert len(two_feet.history) == 1
    assert not two_feet.has_unsaved_changes
    two_feet.apply(with_height(two_feet.record.design, 6), "Place")
    assert two_feet.has_unsaved_changes
    two_feet.undo()
    assert not two_feet.has_unsaved_changes


def test_steps_on_two_feet_never_merge(two_feet: Case) -> None:
    two_feet.apply(with_height(two_feet.record.design, 6), "Raise", "pad")
    two_feet.take_foot(Side.LEFT)
    two_feet.apply(with_height(two_feet.record.design, 6), "Raise", "pad")
    assert len(two_feet.history) == 3


def test_a_change_of_the_other_foot_shows_it(two_feet: Case) -> None:
    left = two_feet.record.other
    assert left is not None
    two_feet.apply(left.with_design(with_height(left.design, 6)), "Copy to the left")
    assert two_feet.side is Side.LEFT
    two_feet.take_foot(Side.RIGHT)
    two_feet.undo()
    assert two_feet.side is Side.LEFT
    assert two_feet.record.design == InsoleDesign(Side.LEFT)


def test_the_selection_stays_on_its_foot(two_feet: Case) -> None:
    two_feet.apply(with_height(two_feet.record.design, 6), "Place")
    two_feet.select("pad")
    two_feet.take_foot(Side.LEFT)
    assert two_feet.selection is None


def test_the_whole_record_is_replaced_in_one_step(two_feet: Case) -> None:
    before = two_feet.record
    two_feet.apply(CaseRecord(patient=Patient(name="Anna")), "Clear")
    assert two_feet.foot is None
    two_feet.undo()
    assert two_feet.record is before
