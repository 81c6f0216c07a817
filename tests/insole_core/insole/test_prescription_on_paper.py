"""Two designs that differ in one value differ on paper in it, with its name and unit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any, get_args

import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.corrections import CorrectionBase
from insole_core.insole.prescription.design import (
    ArchRaise,
    BrushStroke,
    Correction,
    Finish,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    InsoleDesign,
    Layers,
    Outline,
    Pelott,
    Post,
    Posting,
    RimStation,
    Rocker,
    Shell,
)
from insole_core.insole.prescription.design_limits import CHOICES
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.insole.prescription.shoe import Shoe
from insole_core.insole.prescription.vocabulary import spoken

ROUND = ((-40.0, 0.0), (40.0, 0.0), (40.0, 250.0), (-40.0, 250.0))
SHARES = (0.0, 0.3, 0.6, 1.0)
FORM = Form(
    name="Flat", length_mm=250, ball_width_mm=95, along_shares=SHARES, across_shares=SHARES,
    heights_mm=((0.0,) * 4,) * 4, source="a book",
)  # fmt: skip
FROM_FOOT = InsoleDesign(
    Side.LEFT,
    (
        Pelott(centre_mm=(12.0, 150.0)),
        Pelott(centre_mm=(0.0, 20.0), shape="cut_out", kind="heel_spur_recess", height_mm=-2.0),
        Posting(rearfoot_deg=3.0),
        ForefootTwist(angle_deg=2.0),
        HeelSkive(),
        HeelLift(),
        ArchRaise(),
        HeelCup(),
        Rocker(),
        BrushStroke(points_mm=((0.0, 100.0), (9.0, 120.0))),
    ),
    outline=Outline(shoe=Shoe(name="Boot", inside_mm=ROUND)),
    layers=Layers(cover_mm=2.0),
    base=BaseForm(form=FORM),
    finish=Finish(rim=(RimStation(border="medial", along=0.1, height_mm=12.0),)),
    shell=Shell(posts=(Post(),)),
)
OTHERS = replace(
    FROM_FOOT,
    corrections=(
        Pelott(centre_mm=(0.0, 150.0), shape="outline", outline_mm=ROUND),
        ArchRaise(target_mm=24.0, apex_mm=(16.0, 120.0)),
        BrushStroke(points_mm=((0.0, 100.0),), mode="smooth", strength=0.5),
    ),
    outline=Outline(source="shoe_size", shoe_size_eu=42),
)
DRAWN = replace(FROM_FOOT, outline=Outline(source="drawn", points_mm=ROUND))
UNSET = {
    "kind": "felt_pad", "sigma_mm": (12.0, 18.0), "blend_mm": 7.0, "target_mm": 24.0,
    "apex_mm": (16.0, 120.0), "width_mm": 3.2, "body_weight_kg": 82.0, "least_mm": 2.2,
    "least_edge_mm": 1.2, "trim_mm": ((30.0, 150.0), (0.0, 160.0)), "length_mm": 44.0,
}  # fmt: skip
"""What stands for a value that is not set."""
SILENT: dict[tuple[type[Any], str], str] = {
    (CorrectionBase, "id"): "by which the program finds it",
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


def others_of(part: Any, name: str) -> Iterator[Any]:
    """Other values of a field."""
    value = getattr(part, name)
    if value is None:
        if name in UNSET:
            yield UNSET[name]
    elif isinstance(value, bool):
        yield not value
    elif isinstance(value, str):
        choices = CHOICES.get(type(part), {}).get(name, ("Other", "drop"))
        yield from (word for word in choices if word != value)
    elif isinstance(value, float | int):
        yield value + (0.1 if -1 <= value <= 1 else 1)
    elif isinstance(value, tuple) and value and isinstance(value[0], float):
        yield (value[0] + 1.5, *value[1:])
        yield (*value[:-1], value[-1] + 1.5)
    elif isinstance(value, tuple) and value and isinstance(value[0], tuple):
        yield ((value[0][0] + 3.0, *value[0][1:]), *value[1:])


def varied(part: Any) -> Iterator[tuple[type, str, Any, Any]]:
    """The part with each value changed, one at a time, also in its parts: where, which, before."""
    for field in fields(part):
        value = getattr(part, field.name)
        if is_dataclass(value):
            for kind, name, inner, other in varied(value):
                yield kind, name, inner, replace(part, **{field.name: other})
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            for number, item in enumerate(value):
                for kind, name, inner, other in varied(item):
                    items = (*value[:number], other, *value[number + 1 :])
                    yield kind, name, inner, replace(part, **{field.name: items})
        elif not isinstance(value, Side):
            for other in others_of(part, field.name):
                yield type(part), field.name, part, replace(part, **{field.name: other})


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
                assert any(spoken(part, name).name in line for line in changed), (kind, name)
    assert {key for key, nothing in unsaid.items() if nothing and not is_silent(*key)} == set()


def test_every_field_is_varied_or_silent_for_a_reason() -> None:
    parts = (
        *get_args(Correction), InsoleDesign, Outline, Layers, Finish, RimStation, Shell, Post,
        Shoe, BaseForm, Form,
    )  # fmt: skip
    nested = {"corrections", "outline", "layers", "base", "finish", "shell", "shoe", "posts", "rim"}
    nested.add("form")
    known = {(kind, f.name) for kind in parts for f in fields(kind) if f.name not in nested}
    seen = {(kind, name) for d in (FROM_FOOT, OTHERS, DRAWN) for kind, name, *_ in varied(d)}
    assert {key for key in known - seen if not is_silent(*key)} == set()
    assert all(reason for reason in SILENT.values())
    assert {name for kind, name in SILENT if kind is CorrectionBase} == {"id"}


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
    assert facts["shoe"].startswith("Shoe Boot; Trimmed to it no; Room 0.5 mm; Inside through 4")
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
