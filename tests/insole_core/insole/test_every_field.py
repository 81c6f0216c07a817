"""Every value of a prescription reaches everything that reads one: files, papers, comparison."""

from __future__ import annotations

import json
from typing import Any

import design_schema
import jsonschema
import pytest
from varied_designs import DRAWN, FROM_FOOT, OTHERS, varied

from insole_core.errors import DesignError
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.mirroring import mirrored

SCHEMA = json.loads(design_schema.SCHEMA.read_text("utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
VARIED = [
    pytest.param(design, name, part, other, id=f"{design.outline.source} {kind.__name__}.{name}")
    for design in (FROM_FOOT, OTHERS, DRAWN)
    for kind, name, part, other in varied(design)
]
SIGNATURE = {"author", "created_at"}


@pytest.mark.parametrize(("design", "name", "part", "other"), VARIED)
def test_a_value_reaches_all_that_read_a_design(
    design: InsoleDesign, name: str, part: Any, other: InsoleDesign
) -> None:
    content = json.loads(json.dumps(design_to_json(other)))
    assert content != design_to_json(design)
    read = reading(content)
    assert read in (None, other)
    assert VALIDATOR.is_valid(content) or read is None
    there = mirrored(other)
    assert there != mirrored(design)
    assert mirrored(there) == other
    if name not in SIGNATURE:
        assert design_differences(design, other)


def reading(content: dict[str, Any]) -> InsoleDesign | None:
    """The design that a file holds; None if one of its values is refused."""
    try:
        return design_from_json(content)
    except DesignError:
        return None
