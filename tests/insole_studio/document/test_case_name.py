"""Suggested names of files."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

import insole_studio
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_studio.document.case import Case
from insole_studio.document.case_names import file_stem, foot_stem

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


@pytest.mark.parametrize(
    ("name", "sides", "path", "whole", "foot"),
    [
        ("Anna", (Side.LEFT, Side.RIGHT), None, "Anna", "Anna-right"),
        ("Anna", (Side.RIGHT,), None, "Anna-right", "Anna-right"),
        ("Orville Wright", (Side.RIGHT,), None, "Orville Wright-right", "Orville Wright-right"),
        ("Anna", (Side.RIGHT,), Path("b-right.insole"), "b-right", "b-right"),
        ("", (Side.LEFT, Side.RIGHT), None, "insole", "insole-right"),
        ("Anna", (), None, "Anna", "Anna"),
    ],
)
def test_a_name_has_the_side_of_a_foot_and_none_of_a_pair(
    qapp: QApplication,
    make_foot: Callable[[Side], Foot],
    name: str,
    sides: tuple[Side, ...],
    path: Path | None,
    whole: str,
    foot: str,
) -> None:
    case = Case()
    feet = tuple(FootRecord.begun(make_foot(side), NOWHERE) for side in sides)
    case.open(CaseRecord(Patient(name), feet, sides[-1] if sides else None), path)
    assert file_stem(case) == whole
    assert foot_stem(case) == foot


@pytest.mark.usefixtures("swedish")
def test_names_that_are_proposed_are_swedish_in_swedish(make_foot: Callable[[Side], Foot]) -> None:
    case = Case()
    case.open(CaseRecord(Patient(""), (foot_of(make_foot, Side.RIGHT),), Side.RIGHT), None)
    assert foot_stem(case) == "inlägg-höger"


def foot_of(make_foot: Callable[[Side], Foot], side: Side) -> FootRecord:
    return FootRecord.begun(make_foot(side), NOWHERE)


def test_no_dialog_proposes_an_english_word() -> None:
    """A word in the name of a file goes through `tr`, or is a name or key of something."""
    calls = (
        node
        for path in Path(insole_studio.__file__).parent.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call)
        and getattr(node.func, "attr", "") in ("file_to_write", "name_to_write")
    )
    proposed = [call.args[0] for call in calls]
    assert len(proposed) > 8
    words = {
        part.value
        for proposal in proposed
        for part in (proposal.values if isinstance(proposal, ast.JoinedStr) else [proposal])
        if isinstance(part, ast.Constant)
    }
    assert {word for word in words if re.search(r"(?<![.\w])[a-z]{3,}", str(word))} == set()
