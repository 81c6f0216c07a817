"""What changes from one design to another, a line each in a clinician's words.

Shown before a device or a finding is applied; the texts are translated as all of the core's.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any, TypeAlias

from insole_core.insole.elements import Correction
from insole_core.insole.elements.words import number_message, worded
from insole_core.insole.fields import Choice, Declared, Line, Number, Part, declared
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import RimStation
from insole_core.insole.prescription.outline import Shoe
from insole_core.insole.prescription.rim_sliders import (
    designed_cup_mm,
    medial_flange_mm,
)
from insole_core.insole.prescription.shell import Post
from insole_core.messages import Message, joined

_Key: TypeAlias = tuple[str, str]
"""The part of a design, "" for the design itself, and the name of a value in it."""
_DERIVED: dict[_Key, str] = {
    ("", "device"): "Device",
    ("", "base"): "Base",
    ("outline", "shoe"): "Shoe",
    ("finish", "cup_mm"): "Heel cup",
    ("finish", "medial_flange_mm"): "Medial flange",
    ("finish", "medial_rim"): "Medial rim, from heel to toes",
    ("finish", "lateral_rim"): "Lateral rim, from heel to toes",
    ("shell", "rearfoot"): "Rearfoot post",
    ("shell", "forefoot"): "Forefoot post",
}
"""What values are called that are no fields with a name of their own."""
_DECIMALS = 2
_LEVELS = {
    "heel": "{heights} mm",
    "toes": "{heights} mm over the toes",
    "foot": "{heights} mm over the foot",
}
_NONE, _SCANNED = Message("none"), Message("as scanned")
_MM = Number("")


@dataclass(frozen=True)
class _Told:
    """A value of a design, and what it is; None of one that is told in its own way."""

    value: Any
    found: Declared | None = None


def design_differences(old: InsoleDesign, new: InsoleDesign) -> tuple[Message, ...]:
    """Say what changes from one design to another.

    Returns
    -------
    tuple of Message
        A line for each value that differs, in a fixed order: device and base, then the others as
        they are declared, then corrections that are added, changed and removed. Empty for equal
        designs.
    """
    before, after = _values(old), _values(new)
    of_either = replace(new, finish=new.finish or old.finish, shell=new.shell or old.shell)
    keys = dict.fromkeys((*_values(of_either), *before))  # in one order, whichever lacks a part
    return (
        *(
            Message(
                "{what}: {before} → {after}",
                what=_label(key, (after.get(key) or before[key]).found),
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
    named = ((_noun(correction), _main(correction)) for correction in design.corrections)
    return tuple(
        Message("{correction}, {values}", correction=name, values=values) if values else name
        for name, values in named
    )


def _values(design: InsoleDesign) -> dict[_Key, _Told]:
    """Return every value that is neither a part nor a correction; none of a part that is None."""
    shell = design.shell
    return {
        ("", "device"): _Told(design.device),
        ("", "base"): _Told(design.base),
        **_fields("", design),
        **_fields("outline", design.outline),
        ("outline", "shoe"): _Told(design.outline.shoe),
        **_fields("layers", design.layers),
        **_finish_values(design),
        **({} if shell is None else _fields("shell", shell)),
        **({} if shell is None else {("shell", post.region): _Told(post) for post in shell.posts}),
    }


def _fields(within: str, part: Part) -> dict[_Key, _Told]:
    fields = declared(type(part)).items()
    return {(within, name): _Told(getattr(part, name), found) for name, found in fields}


def _finish_values(design: InsoleDesign) -> dict[_Key, _Told]:
    """Return the values of the finish, its rim as that of each border and as cup and flange."""
    finish = design.finish
    if finish is None:
        return {}
    stations = sorted(finish.rim, key=lambda station: station.along)
    cup_mm = designed_cup_mm(design)
    return {
        ("finish", "cup_mm"): _Told(cup_mm, _MM),
        ("finish", "medial_flange_mm"): _Told(medial_flange_mm(finish), _MM),
        **_fields("finish", finish),
        ("finish", "medial_rim"): _Told(tuple(s for s in stations if s.border == "medial")),
        ("finish", "lateral_rim"): _Told(tuple(s for s in stations if s.border == "lateral")),
    }


def _is_nothing(key: _Key, *designs: dict[_Key, _Told]) -> bool:
    """Return whether a value of a part that one design lacks changes nothing in the other."""
    held = [told[key].value for told in designs if key in told]
    return len(held) < len(designs) and all(value in (None, 0, ()) for value in held)


def _post(post: Post) -> Message:
    of_post = declared(Post)
    parts = [worded(of_post["angle_deg"], post.angle_deg, _DECIMALS)]
    if post.length_mm is not None:
        parts.append(Message("{value} long", value=_mm(post.length_mm)))
    parts.append(Message("edge {value}", value=_mm(post.edge_radius_mm)))
    return joined(parts)


def _wording(key: _Key, told: _Told | None) -> Message:
    """Return a value in words, with its unit; None is that of a part that a design lacks."""
    value, found = (None, None) if told is None else (told.value, told.found)
    if value is None:
        offered = dict(found.offers) if isinstance(found, Number) else {}
        return Message(offered[None]) if None in offered else _absent(key)
    if value in ((), ""):
        return _NONE
    if isinstance(found, Line):
        return Message("{count:g} places", count=len(value))
    if found is not None:
        return worded(found, value, _DECIMALS)
    if isinstance(value, str):
        return Message(value)
    return _rim(value) if isinstance(value, tuple) else _part(value)


def _absent(key: _Key) -> Message:
    if key == ("", "base"):
        return Message("from the foot")
    within, _ = key
    return _SCANNED if within == "finish" else _NONE


def _part(part: BaseForm | Post | Shoe) -> Message:
    if isinstance(part, Shoe):
        return Message("{name}, trimmed to it" if part.trim else "{name}", name=part.name)
    return _base(part) if isinstance(part, BaseForm) else _post(part)


def _rim(stations: tuple[RimStation, ...]) -> Message:
    """Return the heights of a border's stations, grouped by the level they are counted from."""
    return joined(
        Message(
            _LEVELS[over],
            heights=joined((number_message(station.height_mm) for station in group), " · "),
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


def _mm(value: float) -> Message:
    return worded(_MM, value, _DECIMALS)


def _label(key: _Key, found: Declared | None) -> Message:
    if key in _DERIVED:
        return Message(_DERIVED[key])
    assert found is not None, "all others are declared"
    if not found.within:
        return Message(found.label)
    return Message("{part}, {value}", part=found.within, value=found.label)


def _corrections(old: InsoleDesign, new: InsoleDesign) -> Iterator[Message]:
    before, after = ({c.id: c for c in design.corrections} for design in (old, new))
    for c in new.corrections:
        if c.id not in before:
            yield Message("Added: {correction}, {values}", correction=_noun(c), values=_main(c))
    for c in new.corrections:
        if c.id in before and _unsigned(before[c.id]) != _unsigned(c):
            yield _change(before[c.id], c)
    for c in old.corrections:
        if c.id not in after:
            yield Message("Removed: {correction}", correction=_noun(c))


def _change(old: Correction, new: Correction) -> Message:
    if _main(old) == _main(new):
        return Message("Moved or reshaped: {correction}", correction=_noun(new))
    return Message(
        "Changed: {correction}, {before} → {after}",
        correction=_noun(new),
        before=_main(old),
        after=_main(new),
    )


def _unsigned(correction: Correction) -> Correction:
    return replace(correction, author="", created_at="")


def _noun(correction: Correction) -> Message:
    return Message(correction.noun)


def _main(correction: Correction) -> Message:
    """Return the values that a clinician knows a correction by: which one, then how much."""
    fields = [(name, correction.declared(name)) for name in declared(type(correction))]
    told = [
        (found, getattr(correction, name))
        for name, found in fields
        if found.main is not None and correction.acts(name)
    ]
    told.sort(key=lambda one: not isinstance(one[0], Choice))
    values = [_said(found, value) for found, value in told if value is not None]
    return joined(values if correction.enabled else [*values, Message("switched off")])


def _said(found: Declared, value: Any) -> Message:
    factor = found.factor if isinstance(found, Number) else 1
    if found.main_below and factor * value < 0:
        return Message(found.main_below, value=worded(found, -value, _DECIMALS))
    said = worded(found, value, _DECIMALS)
    return Message(found.main, value=said) if found.main else said
