"""A prescription takes no corrections away without a question, whichever action brings it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from canned_questions import CannedQuestions

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Variant
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelLift, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.starting_design import template_of
from insole_studio.app.bootstrap import Application
from insole_studio.features.design.actions.prescription_actions import save_template

pytestmark = pytest.mark.one_window

SOURCE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
LIFT, POSTING = HeelLift(height_mm=6.0), Posting(rearfoot_deg=4.0)


def act(app: Application, key: str) -> None:
    app.window.actions_by_key[key].trigger()


def corrections(app: Application, side: Side = Side.RIGHT) -> list[type]:
    foot = app.case.record.of_side(side)
    assert foot is not None
    return [type(correction) for correction in foot.design.corrections]


@pytest.fixture
def feet(app: Application, make_foot: Callable[[Side], Foot]) -> Application:
    """A left foot without corrections, and an active right one with a posting and a heel lift."""
    left = FootRecord.begun(make_foot(Side.LEFT), SOURCE)
    right = FootRecord.begun(make_foot(Side.RIGHT), SOURCE)
    right = right.with_design(replace(right.design, corrections=(POSTING, LIFT)))
    app.case.open(CaseRecord().with_foot(left).with_foot(right).at(Side.RIGHT), None)
    return app


def copy_over(app: Application, _folder: Path, _questions: CannedQuestions) -> None:
    app.case.take_foot(Side.LEFT)
    act(app, "copy_to_other")


def apply_template(app: Application, folder: Path, questions: CannedQuestions) -> None:
    app.case.take_foot(Side.LEFT)
    save_template(app.case, folder / "empty.insole-template")
    app.case.take_foot(Side.RIGHT)
    questions.path = folder / "empty.insole-template"
    act(app, "apply_template")


def repeat_design(app: Application, folder: Path, questions: CannedQuestions) -> None:
    left = app.case.record.of_side(Side.LEFT)
    assert left is not None
    write_case(CaseRecord().with_foot(left), folder / "empty.insole")
    questions.path = folder / "empty.insole"
    act(app, "repeat_design")


def repeat_last(app: Application, _folder: Path, _questions: CannedQuestions) -> None:
    left, right = app.case.record.of_side(Side.LEFT), app.case.record.current
    assert left is not None
    assert right is not None
    app.case.apply(replace(right, earlier=template_of(left)), "Remember")
    act(app, "repeat_last")


def delete_variant(app: Application, _folder: Path, _questions: CannedQuestions) -> None:
    right = app.case.record.current
    assert right is not None
    empty = Variant("A", InsoleDesign(Side.RIGHT))
    full = Variant("B", right.design)
    app.case.apply(replace(right, variants=(empty, full), chosen="B"), "Two variants")
    act(app, "variant_delete")


Act = Callable[[Application, Path, CannedQuestions], None]


@pytest.mark.parametrize(
    "run", [copy_over, apply_template, repeat_design, repeat_last, delete_variant]
)
def test_an_empty_prescription_takes_no_corrections_away_unasked(
    feet: Application, tmp_path: Path, questions: CannedQuestions, run: Act
) -> None:
    questions.replace = False
    run(feet, tmp_path, questions)
    told = "The new prescription has no Posting, Heel lift; the right foot loses that."
    assert questions.asked == [told]
    assert corrections(feet) == [Posting, HeelLift]
    questions.replace = True
    run(feet, tmp_path, questions)
    assert corrections(feet) == []
    feet.controller.run_action("undo", False)
    assert corrections(feet) == [Posting, HeelLift]


def test_what_the_new_prescription_has_too_is_no_question(
    feet: Application, questions: CannedQuestions
) -> None:
    act(feet, "copy_to_other")
    assert corrections(feet, Side.LEFT) == [Posting, HeelLift]
    design = feet.case.record.design
    assert design is not None
    feet.case.apply(design.with_added(HeelLift(height_mm=3.0)), "Another lift")
    act(feet, "copy_to_other")
    assert questions.asked == []
    assert corrections(feet, Side.LEFT) == [Posting, HeelLift, HeelLift]
