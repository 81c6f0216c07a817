"""Suggested names of files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_studio.document.case import Case
from insole_studio.document.case_name import file_stem, foot_stem

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
