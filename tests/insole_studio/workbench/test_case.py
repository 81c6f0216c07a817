from __future__ import annotations

from typing import Any

import pytest

from insole_core.cases.record import Annotations, KeyPoint, Patient, Source
from insole_core.geometry.side import Side
from insole_core.insole.design import InsoleDesign, Pelott
from insole_studio.workbench.case import Case

SOURCE = Source("mesh", "/nowhere/foot.ply", "0" * 64)


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
