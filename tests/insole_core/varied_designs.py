"""Designs that make use of every field, and each of their values varied alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    FullLift,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.fields import choices_of
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.shell import Post, Shell

ROUND = (
    (0.0, -130.0), (20.0, -113.0), (35.0, -65.0), (40.0, 0.0), (35.0, 65.0), (20.0, 113.0),
    (0.0, 130.0), (-20.0, 113.0), (-35.0, 65.0), (-40.0, 0.0), (-35.0, -65.0), (-20.0, -113.0),
)  # fmt: skip
"""A closed line that may be a pad, the inside of a shoe, and a drawn outline."""
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
        FullLift(),
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
    "cover_material": "felt", "shell_material": "felt", "base_material": "felt",
}  # fmt: skip
"""What stands for a value that is not set."""


def others_of(part: Any, name: str) -> Iterator[Any]:
    """Other values of a field."""
    value = getattr(part, name)
    if value is None:
        if name in UNSET:
            yield UNSET[name]
    elif isinstance(value, bool):
        yield not value
    elif isinstance(value, str):
        choices = choices_of(type(part)).get(name, ("Other", "drop"))
        yield from (word for word in choices if word != value)
    elif isinstance(value, float | int):
        yield value + (0.1 if -1 <= value <= 1 else 1)
    elif isinstance(value, tuple) and value and isinstance(value[0], float):
        more = 0.1 if max(value) <= 1 else 1.5
        yield (value[0] + more, *value[1:])
        yield (*value[:-1], value[-1] + more)
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
