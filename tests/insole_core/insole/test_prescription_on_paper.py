"""Two designs that differ in one value differ on paper in it, with its name and unit."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import pytest
from varied_designs import DRAWN, FROM_FOOT, OTHERS, varied

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    CORRECTION_TYPES,
    Correction,
    Pelott,
)
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.insole.prescription.shell import Post, Shell

SILENT: dict[tuple[type[Any], str], str] = {
    (Correction, "id"): "by which the program finds it",
    (InsoleDesign, "side"): "heads the paper of each foot",
    (Form, "along_shares"): "stands behind the name of the form",
    (Form, "across_shares"): "stands behind the name of the form",
    (Form, "heights_mm"): "stands behind the name of the form",
    (Form, "source"): "tells of the form's origin, not of the insole",
}
"""The fields that say nothing to anybody, with the reason."""
NAMED_OTHERWISE = {
    "enabled", "author", "created_at", "kind", "shape", "device", "centre_mm", "apex_mm", "region",
    "border",
}  # fmt: skip
"""Fields that are said without a name: titles, signatures, places."""


def paper(design: InsoleDesign) -> list[str]:
    facts = [f"{name}: {text}" for name, text in make_facts(design).items()]
    return [*map(str, correction_lines(design)), *facts]


def is_silent(kind: type, name: str) -> bool:
    return any(issubclass(kind, of) and name == silent for of, silent in SILENT)


def test_each_value_is_on_paper_with_its_name() -> None:
    """Each is varied alone, in designs of which at least one makes use of it."""
    unsaid: dict[tuple[type, str], bool] = {}
    for design in (FROM_FOOT, OTHERS, DRAWN):
        before = paper(design)
        for kind, name, part, other in varied(design):
            changed = [line for line in paper(other) if line not in before]
            is_gone = name == "enabled" and len(paper(other)) < len(before)
            unsaid[kind, name] = unsaid.get((kind, name), True) and not changed and not is_gone
            if changed and name not in NAMED_OTHERWISE:
                assert any(part.declared(name).label in line for line in changed), (kind, name)
    assert {key for key, nothing in unsaid.items() if nothing and not is_silent(*key)} == set()


def test_every_field_is_varied_or_silent_for_a_reason() -> None:
    parts = (
        *CORRECTION_TYPES.values(), InsoleDesign, Outline, Layers, Finish, RimStation, Shell, Post,
        Shoe, BaseForm, Form,
    )  # fmt: skip
    nested = {"corrections", "outline", "layers", "base", "finish", "shell", "shoe", "posts", "rim"}
    nested.add("form")
    known = {(kind, f.name) for kind in parts for f in fields(kind) if f.name not in nested}
    seen = {(kind, name) for d in (FROM_FOOT, OTHERS, DRAWN) for kind, name, *_ in varied(d)}
    assert {key for key in known - seen if not is_silent(*key)} == set()
    assert all(reason for reason in SILENT.values())
    assert {name for kind, name in SILENT if kind is Correction} == {"id"}


def test_a_unit_stands_with_each_number() -> None:
    text = "\n".join(paper(FROM_FOOT))
    for said in ("Height 6 mm", "Turn 0°", "Taper 50 %", "Rearfoot 3° medial"):
        assert said in text
    assert "EU size" not in text
    assert "EU size 42" in make_facts(OTHERS)["outline"]


def test_the_lines_say_what_was_left_out_before() -> None:
    facts = make_facts(FROM_FOOT)
    assert "Ball 2 mm" in facts["outline"]
    assert "Side height 30 mm" in facts["insole"]
    assert facts["shoe"].startswith("Shoe Boot; Trimmed to it no; Room 0.5 mm; Inside through 12")
    assert "Toe line 4 mm" in facts["finish"]
    assert "Heel transition 9 mm" in facts["finish"]
    assert "Skin smoothing 2 mm" in facts["finish"]
    assert facts["medial rim"] == "Place 10 %, Height 12 mm, Over heel"


@pytest.mark.parametrize("side", list(Side))
def test_a_pad_lies_behind_the_heads_and_medial_of_the_axis(
    side: Side, left_foot: Foot, right_foot: Foot
) -> None:
    foot = left_foot if side is Side.LEFT else right_foot
    bar = Pelott(centre_mm=(4.0 * side.medial_sign, 150.0), shape="bar", length_mm=20, width_mm=60)
    (line,) = correction_lines(InsoleDesign(side, (bar,)), find_landmarks(foot))
    assert line.startswith("Metatarsal bar: Height 6 mm;")
    assert "4 mm medial of the axis, 150 mm from the heel; " in line
    assert line.endswith(" mm behind the heads")
    assert "Taper" not in line
    (line,) = correction_lines(InsoleDesign(side.other, (replace(bar, kind=None),)))
    assert "4 mm lateral of the axis" in line
    ahead = replace(bar, centre_mm=(0.0, 230.0))
    (line,) = correction_lines(InsoleDesign(side, (ahead,)), find_landmarks(foot))
    assert line.endswith(" mm ahead of the heads")
