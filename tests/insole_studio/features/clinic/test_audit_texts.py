"""The audit log speaks the language of the window, down to its details."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtWidgets import QApplication

import insole_core.records
from insole_core.export.shop_order import OrderTerms
from insole_core.geometry.side import Side
from insole_core.records.author import Author, Proof, Role
from insole_core.records.order import OrderState
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.record_field import Choice, Day, Field, Number, fields_of
from insole_core.records.records import open_records
from insole_core.records.retention import ErasureReason
from insole_core.records.visit import CaptureState, Visit
from insole_studio.features.clinic.audit_dialog import FIELDS, NAMES, WORDS, details_text
from insole_studio.texts import load_language

CORE = Path(insole_core.records.__file__).parents[1]
DAY = date(2026, 4, 2)
WRITES = ("log", "log_each", "_log", "append", "append_each")


def trees() -> Iterator[ast.Module]:
    for folder in ("records", "workflows/records"):
        for path in (CORE / folder).rglob("*.py"):
            yield ast.parse(path.read_text("utf-8"))


def test_every_detail_that_is_written_has_a_name() -> None:
    calls = (node for tree in trees() for node in ast.walk(tree) if isinstance(node, ast.Call))
    written = {
        keyword.arg
        for call in calls
        if getattr(call.func, "attr", "") in WRITES
        for keyword in call.keywords
        if keyword.arg is not None
    }
    assert len(written) > 15
    assert written - NAMES.keys() == set()


def test_every_field_that_a_line_lists_has_a_name(tmp_path: Path) -> None:
    """Whatever is changed of a person and of a visit."""
    who = Author("anna", "desk")
    with closing(open_records(RecordsPlace.local(tmp_path / "record"), who)) as records:
        person = records.persons.add(Person("Anna Berg"))
        visit = records.visits.add(Visit(person.id, DAY - timedelta(days=1)))
        changed = replace(person, **{n: filled(f) for n, f in fields_of(Person).items()})
        records.persons.change(changed, person.revision)
        changed_visit = replace(visit, **{n: filled(f) for n, f in fields_of(Visit).items()})
        records.visits.change(changed_visit, visit.revision)
        details = [json.loads(line.details) for line in records.audit.lines()]
    listed = [name for each in details for name in each.get("fields", "").split()]
    assert sorted(listed) == sorted([*fields_of(Person), *fields_of(Visit)])
    assert set(listed) - FIELDS.keys() == set()


def filled(field: Field) -> Any:
    """Return a value that the field can hold, and does not hold at first."""
    made = {
        "personal number": "19811228-9874",
        "measures": {"left_length_mm": 251.0},
        "state of the capture": CaptureState.WANTED,
        "terms of the order": OrderTerms(colour="black"),
    }
    if field.noun in made:
        return made[field.noun]
    if isinstance(field, Number):
        return field.least + 0.5
    if isinstance(field, Choice):
        return next(reversed(field.names))
    return DAY if isinstance(field, Day) else f"other {field.noun}"


@pytest.mark.parametrize("words", [OrderState, ErasureReason, Side, Role, Proof])
def test_every_word_of_a_detail_has_a_name(words: type) -> None:
    assert {str(word) for word in words} - {"none"} - WORDS.keys() == set()


@pytest.mark.usefixtures("swedish")
def test_the_details_are_swedish_in_swedish(qapp: QApplication) -> None:
    said = details_text({"fields": "name birth_date", "signed_in_by": "password", "x_y": "P-1"})
    swedish = [t() for texts in (NAMES, WORDS, FIELDS) for t in texts.values()]
    load_language(qapp, "en")
    assert said == "fält: namn · födelsedatum, inloggad med: lösenord, x y: P-1"
    plain = [t() for texts in (NAMES, WORDS, FIELDS) for t in texts.values()]
    alike = {a for a, b in zip(swedish, plain, strict=True) if a == b}
    assert alike == {"SHA-256", "person", "revision", "pseudonym"}
