"""What changes from one design to another, a line each in a clinician's words.

Shown before a device or a finding is applied; the texts are translated as all of the core's.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from itertools import groupby
from typing import Any

from insole_core.insole.elements import Correction, Pelott
from insole_core.insole.elements.pad_kinds import pad_name
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.rim_sliders import (
    cup_depth_mm,
    finish_with_cups,
    medial_flange_mm,
)
from insole_core.insole.prescription.shell import Post
from insole_core.insole.prescription.shoe import Shoe
from insole_core.insole.prescription.vocabulary import WORDS
from insole_core.messages import Message, joined

LABELS: dict[str, str] = {
    "device": "Device",
    "base": "Base",
    "thickness_mm": "Thickness",
    "bottom": "Underside",
    "grid_mm": "Grid",
    "max_height_mm": "Greatest height",
    "margin_mm": "Margin",
    "source": "Outline",
    "extent": "Extent",
    "toe_allowance_mm": "Ahead of the toes",
    "ball_allowance_mm": "Beside the ball",
    "heel_allowance_mm": "Around the heel",
    "width_mm": "Medial border, from the 1st metatarsal's bisection",
    "shoe_size_eu": "Shoe size",
    "points_mm": "Drawn outline",
    "shoe": "Shoe",
    "cover_mm": "Cover",
    "cover_is_taken_off": "Cover glued on later",
    "shell_mm": "Middle layer",
    "base_mm": "Base layer",
    "cup_mm": "Heel cup",
    "medial_flange_mm": "Medial flange",
    "expansion_mm": "Soft tissue expansion",
    "arch_fill_mm": "Arch fill",
    "skin_smoothing_mm": "Smoothing of skin folds",
    "toe_zone": "Toe zone",
    "toe_line_mm": "Toe line",
    "heel_blend_mm": "Blend at the heel",
    "arch_blend_mm": "Blend at the arch",
    "forefoot_blend_mm": "Blend at the forefoot",
    "medial_rim": "Medial rim, from heel to toes",
    "lateral_rim": "Lateral rim, from heel to toes",
    "material": "Material",
    "body_weight_kg": "Body weight",
    "least_mm": "Least thickness of the material",
    "least_edge_mm": "Least thickness of the material at the front edge",
    "taper_mm": "Thickness at the front edge",
    "taper_length_mm": "Length of the taper",
    "edge_radius_mm": "Edge radius",
    "draft_medial_deg": "Medial draft",
    "draft_lateral_deg": "Lateral draft",
    "chamfer_mm": "Chamfer",
    "heel_pitch_mm": "Heel pitch",
    "trim_mm": "Trim line",
    "rearfoot": "Rearfoot post",
    "forefoot": "Forefoot post",
}
"""What each value of a design is called, in the order of the lines."""
_CORRECTIONS = {
    "posting": "posting",
    "forefoot_twist": "forefoot twist",
    "heel_skive": "heel skive",
    "heel_lift": "heel lift",
    "arch_raise": "arch raise",
    "rocker": "rocker",
    "heel_cup": "heel cup",
    "brush": "stroke",
}
_PARTS = ("outline", "layers", "finish", "shell")
_UNITS = {"_mm": "mm", "_deg": "°", "_kg": "kg"}
_RAISING = ("rearfoot_deg", "forefoot_deg", "angle_deg")
_MAIN = {
    "border": "",
    "mode": "",
    "rearfoot_deg": "{value} at the rearfoot",
    "forefoot_deg": "{value} at the forefoot",
    "angle_deg": "",
    "depth_mm": "",
    "height_mm": "",
    "target_mm": "{value} over the floor",
    "behind_heads_mm": "{value} behind the heads",
    "length_mm": "{value} long",
    "strength": "",
}
"""By which values of a correction a clinician knows it, and how each is said."""
_LEVELS = {
    "heel": "{heights} mm",
    "toes": "{heights} mm over the toes",
    "foot": "{heights} mm over the foot",
}
_OF_RIM = ("cup_mm", "medial_flange_mm", "medial_rim", "lateral_rim")
_NONE, _SCANNED = Message("none"), Message("as scanned")
_ABSENT = {
    "base": Message("from the foot"),
    **dict.fromkeys((*(f.name for f in fields(Finish)), *_OF_RIM), _SCANNED),
}
"""How the lack of a value is said, where it is not "none"."""


def design_differences(old: InsoleDesign, new: InsoleDesign) -> tuple[Message, ...]:
    """Say what changes from one design to another.

    Returns
    -------
    tuple of Message
        A line for each value that differs, in a fixed order: device and base, then those of
        `LABELS`, then corrections that are added, changed and removed. Empty for equal designs.
    """
    before, after = _values(old), _values(new)
    order = {key: number for number, key in enumerate(LABELS)}
    keys = sorted(before.keys() | after.keys(), key=lambda key: order.get(key, len(order)))
    return (
        *(
            Message(
                "{what}: {before} → {after}",
                what=_label(key),
                before=_wording(key, before.get(key)),
                after=_wording(key, after.get(key)),
            )
            for key in keys
            if before.get(key) != after.get(key) and not _is_nothing(key, before, after)
        ),
        *_corrections(old, new),
    )


def corrections_in_words(design: InsoleDesign) -> tuple[Message, ...]:
    """Return name and values of each correction of a design, such as "Heel lift, 6 mm"."""
    named = ((_name(correction), _main(correction)) for correction in design.corrections)
    return tuple(
        Message("{correction}, {values}", correction=name, values=values) if values else name
        for name, values in named
    )


def _values(design: InsoleDesign) -> dict[str, Any]:
    """Return every value that is neither a part nor a correction; none of a part that is None."""
    shell = design.shell
    return {
        **_fields(design, but=(*_PARTS, "side", "corrections")),
        **_fields(design.outline),
        **_fields(design.layers),
        **_finish_values(design),
        **({} if shell is None else _fields(shell, but=("posts",))),
        **({} if shell is None else {post.region: post for post in shell.posts}),
    }


def _fields(part: Any, but: tuple[str, ...] = ()) -> dict[str, Any]:
    return {f.name: getattr(part, f.name) for f in fields(part) if f.name not in but}


def _finish_values(design: InsoleDesign) -> dict[str, Any]:
    """Return the values of the finish, its rim as that of each border and as cup and flange."""
    finish = design.finish
    if finish is None:
        return {}
    stations = sorted(finish.rim, key=lambda station: station.along)
    return {
        **_fields(finish, but=("rim",)),
        "medial_rim": tuple(s for s in stations if s.border == "medial"),
        "lateral_rim": tuple(s for s in stations if s.border == "lateral"),
        "cup_mm": cup_depth_mm(finish_with_cups(finish, design.active)),
        "medial_flange_mm": medial_flange_mm(finish),
    }


def _is_nothing(key: str, *designs: dict[str, Any]) -> bool:
    """Return whether a value of a part that one design lacks changes nothing in the other."""
    return all(values.get(key) in (None, 0, ()) for values in designs)


def _post(post: Post) -> Message:
    parts = [_wording("angle_deg", post.angle_deg)]
    if post.length_mm is not None:
        parts.append(Message("{value} long", value=_number(post.length_mm, "mm")))
    parts.append(Message("edge {value}", value=_number(post.edge_radius_mm, "mm")))
    return joined(parts)


def _wording(key: str, value: Any) -> Message:
    """Return a value in words, with its unit; None is that of a part that a design lacks."""
    if value is None:
        return _ABSENT.get(key, _NONE)
    if value in ((), ""):
        return _NONE
    if isinstance(value, bool):
        return Message("yes") if value else Message("no")
    if isinstance(value, str):
        return Message(WORDS.get(value, value))
    if isinstance(value, tuple):
        return _rim(value) if key in _OF_RIM else Message("{count:g} places", count=len(value))
    return _part(value) if isinstance(value, BaseForm | Post | Shoe) else _measure(key, value)


def _part(part: BaseForm | Post | Shoe) -> Message:
    if isinstance(part, Shoe):
        return Message("{name}, trimmed to it" if part.trim else "{name}", name=part.name)
    return _base(part) if isinstance(part, BaseForm) else _post(part)


def _rim(stations: tuple[RimStation, ...]) -> Message:
    """Return the heights of a border's stations, grouped by the level they are counted from."""
    return joined(
        Message(
            _LEVELS[over],
            heights=joined((_number(station.height_mm, "") for station in group), " · "),
        )
        for over, group in groupby(stations, key=lambda station: station.over)
    )


def _base(base: BaseForm) -> Message:
    if base.contact_share == 0:
        return Message("the form {form}", form=base.form.name)
    return Message(
        "the form {form}, {percent:g} % from the foot",
        form=base.form.name,
        percent=round(100 * base.contact_share, 1),
    )


def _measure(key: str, value: float) -> Message:
    if key in _RAISING and value != 0:
        return _raised(value)
    return _number(value, next((u for suffix, u in _UNITS.items() if key.endswith(suffix)), ""))


def _raised(angle_deg: float) -> Message:
    angle = _number(abs(angle_deg), "°")
    return Message("{angle} medial" if angle_deg > 0 else "{angle} lateral", angle=angle)


def _number(value: float, unit: str) -> Message:
    if not unit:
        return Message("{value:g}", value=round(value, 2))
    if unit == "°":
        return Message("{value:g}°", value=round(value, 2))
    return Message("{value:g} {unit}", value=round(value, 2), unit=unit)


def _label(key: str) -> str:
    return LABELS.get(key, _as_words(key))


def _corrections(old: InsoleDesign, new: InsoleDesign) -> Iterator[Message]:
    before, after = ({c.id: c for c in design.corrections} for design in (old, new))
    for c in new.corrections:
        if c.id not in before:
            yield Message("Added: {correction}, {values}", correction=_name(c), values=_main(c))
    for c in new.corrections:
        if c.id in before and _unsigned(before[c.id]) != _unsigned(c):
            yield _change(before[c.id], c)
    for c in old.corrections:
        if c.id not in after:
            yield Message("Removed: {correction}", correction=_name(c))


def _change(old: Correction, new: Correction) -> Message:
    if _main(old) == _main(new):
        return Message("Moved or reshaped: {correction}", correction=_name(new))
    return Message(
        "Changed: {correction}, {before} → {after}",
        correction=_name(new),
        before=_main(old),
        after=_main(new),
    )


def _unsigned(correction: Correction) -> Correction:
    return replace(correction, author="", created_at="")


def _name(correction: Correction) -> Message:
    if isinstance(correction, Pelott):
        return Message(pad_name(correction))
    return Message(_CORRECTIONS.get(correction.type, _as_words(correction.type)))


def _main(correction: Correction) -> Message:
    """Return the values that a clinician knows a correction by."""
    to_height = getattr(correction, "target_mm", None) is not None  # what is added says nothing
    values = [
        _with_place(key, _wording(key, getattr(correction, key)))
        for key in _MAIN
        if getattr(correction, key, None) is not None and not (to_height and key == "height_mm")
    ]
    return joined(values if correction.enabled else [*values, Message("switched off")])


def _with_place(key: str, value: Message) -> Message:
    template = _MAIN[key]
    return Message(template, value=value) if template else value


def _as_words(key: str) -> str:
    for unit in _UNITS:
        key = key.removesuffix(unit)
    return key.replace("_", " ").capitalize()
