"""Every value of a prescription reaches everything that reads one: files, papers, comparison."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import design_schema
import jsonschema
import pytest
from varied_designs import DRAWN, FROM_FOOT, OTHERS, varied

from insole_core.errors import DesignError
from insole_core.insole import elements
from insole_core.insole.elements import CORRECTION_TYPES
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.template import mirrored

SCHEMA = json.loads(design_schema.SCHEMA.read_text("utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
SIGNATURE = {"author", "created_at"}
NOT_ALONE = {("Pelott", "shape"), ("Outline", "source")}
"""Choices of which some need another value beside them: files with them alone are refused."""


@pytest.mark.parametrize("design", [FROM_FOOT, OTHERS, DRAWN], ids=lambda d: d.outline.source)
def test_designs_of_every_field_are_read_as_they_were_written(design: InsoleDesign) -> None:
    assert reading(written(design)) == design


@pytest.mark.parametrize("design", [FROM_FOOT, OTHERS, DRAWN], ids=lambda d: d.outline.source)
def test_a_value_reaches_all_that_read_a_design(design: InsoleDesign) -> None:
    plain, mirror_image = written(design), mirrored(design)
    assert VALIDATOR.is_valid(plain)
    checked = 0
    for kind, name, part, other in varied(design):
        what = f"{kind.__name__}.{name}"
        content = written(other)
        assert content != plain, what
        read = reading(content)
        alone = (type(part).__name__, name) in NOT_ALONE
        assert read == other or (read is None and alone), what
        others = [one for one in content["corrections"] if one not in plain["corrections"]]
        assert VALIDATOR.is_valid(content | {"corrections": others}) or read is None, what
        there = mirrored(other)
        assert there != mirror_image, what
        assert mirrored(there) == other, what
        assert name in SIGNATURE or design_differences(design, other), what
        checked += 1
    assert checked > 100


@pytest.mark.parametrize(("kind", "name"), sorted(NOT_ALONE))
def test_a_choice_that_needs_another_value_is_read_where_it_needs_none(
    kind: str, name: str
) -> None:
    assert [
        other
        for design in (FROM_FOOT, OTHERS, DRAWN)
        for part, field, _, other in varied(design)
        if (part.__name__, field) == (kind, name) and reading(written(other)) == other
    ]


def written(design: InsoleDesign) -> dict[str, Any]:
    """The content of the design's file."""
    content: dict[str, Any] = json.loads(json.dumps(design_to_json(design)))
    return content


def reading(content: dict[str, Any]) -> InsoleDesign | None:
    """The design that a file holds; None if one of its values is refused."""
    try:
        return design_from_json(content)
    except DesignError:
        return None


def test_every_module_that_declares_an_element_is_named_where_all_are() -> None:
    folder = Path(elements.__file__).parent
    declaring = {
        path.stem for path in folder.glob("*.py") if "Correction):" in path.read_text("utf-8")
    }
    named = {kind.__module__.rpartition(".")[2] for kind in CORRECTION_TYPES.values()}
    assert declaring == named & declaring
    assert len(declaring) >= 9
