"""A prescription in words, for printed documents: one line per correction, and the construction."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from insole_core.insole.pads.pad_kinds import pad_name
from insole_core.insole.prescription.design import (
    ArchRaise,
    Correction,
    Finish,
    InsoleDesign,
    Pelott,
    Shell,
)
from insole_core.insole.prescription.rim_sliders import cup_depth_mm, medial_flange_mm
from insole_core.messages import Message, joined

_UNITS = {"_mm": " mm", "_deg": "°", "_eu": " EU"}
_DECIMALS, _DECIMALS_OF_A_SHARE = 1, 2
"""The precision of the tool's own fields."""
_RAISING = {"rearfoot_deg", "forefoot_deg", "angle_deg"}
"""Angles that raise the medial edge above 0, the lateral one below."""
_LENGTH_SHARES = {"blend_start", "blend_end", "fade_start", "fade_end"}
_SILENT = {"id", "enabled", "author", "created_at", "kind"}


def correction_lines(design: InsoleDesign) -> tuple[Message, ...]:
    """Return a line for every active correction: type, all its numbers, author and date."""
    return tuple(_line(correction) for correction in design.active)


def plain_number(value: float, decimals: int = _DECIMALS) -> str:
    """Return a number as on paper: rounded, without needless zeros, and never "-0"."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def number_message(value: float, decimals: int = _DECIMALS) -> Message:
    """Return the same number to be translated: with the decimal sign of the language."""
    return Message("{number:g}", number=round(value, decimals) + 0.0)  # never -0


def make_facts(design: InsoleDesign) -> dict[str, str]:
    """Return device, base, thickness, layers, bottom, outline, finish and shell, by name."""
    layers = design.layers
    facts: dict[str, str] = {"device": design.device} if design.device else {}
    if design.base is not None:
        share = number_message(100 * design.base.contact_share)
        form = design.base.form.name
        facts["base form"] = Message("{form}, {share} % of the foot", form=form, share=share)
    facts |= {
        "prescribed thickness": _mm(design.made_thickness_mm),
        "bottom": design.bottom,
        "outline": joined([_words(design.outline.source), _words(design.outline.extent)]),
    }
    if design.outline.width_mm is not None:
        facts["width"] = Message(
            "{width} from the bisection of the 1st metatarsal", width=_mm(design.outline.width_mm)
        )
    if layers.total_mm > 0:
        thicknesses = (layers.cover_mm, layers.shell_mm, layers.base_mm)
        numbers = joined(map(number_message, thicknesses), " / ")
        facts["cover / middle layer / base"] = Message("{numbers} mm", numbers=numbers)
    if design.taken_off_mm > 0:
        facts["cover, glued on later"] = _mm(design.taken_off_mm)
    if design.finish is not None:
        facts |= _finish_facts(design.finish)
    return facts if design.shell is None else facts | _shell_facts(design, design.shell)


def _finish_facts(finish: Finish) -> dict[str, str]:
    """Return what is prescribed of the finish, by name; nothing that is 0."""
    facts: dict[str, str] = {"toe zone": _words(finish.toe_zone)}
    lengths = {
        "heel cup": cup_depth_mm(finish),
        "medial flange": medial_flange_mm(finish),
        "arch fill": finish.arch_fill_mm,
        "expansion": finish.expansion_mm,
    }
    return facts | {name: _mm(mm) for name, mm in lengths.items() if mm}


def _shell_facts(design: InsoleDesign, shell: Shell) -> dict[str, str]:
    """Return what is prescribed of a shell, by name; nothing that is 0."""
    facts: dict[str, str] = {"material of the shell": shell.material} if shell.material else {}
    if shell.body_weight_kg is not None:
        weight = number_message(shell.body_weight_kg)
        facts["body weight"] = Message("{weight} kg", weight=weight)
    facts["end taper"] = Message(
        "{height} over {length}", height=_mm(shell.taper_mm), length=_mm(shell.taper_length_mm)
    )
    for post in shell.posts:
        facts[f"{post.region} post"] = Message(
            "{angle}, length {length}, edge {edge}",
            angle=_raised(post.angle_deg),
            length="usual" if post.length_mm is None else _mm(post.length_mm),
            edge=_mm(post.edge_radius_mm),
        )
    if design.outline.extent == "three_quarter" and design.outline.source != "drawn":
        points = shell.trim_mm
        facts["trim line"] = (
            "usual" if points is None else Message("through {count} points", count=len(points))
        )
    lengths = {
        "edge radius": shell.edge_radius_mm,
        "chamfer": shell.chamfer_mm,
        "heel pitch": shell.heel_pitch_mm,
    }
    facts |= {name: _mm(mm) for name, mm in lengths.items() if mm > 0}
    facts["draft of the walls"] = Message(
        "medial {medial}°, lateral {lateral}°",
        medial=number_message(shell.draft_medial_deg),
        lateral=number_message(shell.draft_lateral_deg),
    )
    return facts


def _mm(value: float) -> Message:
    return Message("{number} mm", number=number_message(value))


def _line(correction: Correction) -> Message:
    values = [
        _value(field.name, getattr(correction, field.name))
        for field in fields(correction)
        if field.name not in _unsaid(correction) and getattr(correction, field.name) is not None
    ]
    signed = " ".join(word for word in (correction.author, correction.created_at[:10]) if word)
    what = {"correction": _title(correction), "values": joined(values, "; ")}
    if not signed:
        return Message("{correction}: {values}", **what)
    return Message("{correction}: {values} ({signed})", signed=signed, **what)


def _unsaid(correction: Correction) -> set[str]:
    """Return the fields that say nothing about the insole."""
    if isinstance(correction, ArchRaise) and correction.target_mm is not None:
        return {*_SILENT, "height_mm"}
    return _SILENT


def _title(correction: Correction) -> str:
    if isinstance(correction, Pelott) and correction.kind:
        name = pad_name(correction)
        return name[0].upper() + name[1:]
    return _words(correction.type).capitalize()


def _value(name: str, value: Any) -> Message:
    if name in _RAISING:
        words = _words(name.removesuffix("_deg"))
        return Message("{name} {angle}", name=words, angle=_raised(value))
    if name in _LENGTH_SHARES:
        share = number_message(100 * value)
        return Message("{name} {share} % of the length", name=_words(name), share=share)
    unit = next((unit for suffix, unit in _UNITS.items() if name.endswith(suffix)), "")
    for suffix in _UNITS:
        name = name.removesuffix(suffix)
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return Message("{name} {count} points", name=_words(name), count=len(value))
    numbers = value if isinstance(value, tuple) else (value,)
    decimals = _DECIMALS if unit else _DECIMALS_OF_A_SHARE
    values = joined(
        _words(n) if isinstance(n, str) else number_message(n, decimals) for n in numbers
    )
    return Message("{name} {values}{unit}", name=_words(name), values=values, unit=unit)


def _raised(angle_deg: float) -> Message:
    angle = number_message(abs(angle_deg))
    if angle == "0":
        return Message("0°")
    if angle_deg > 0:
        return Message("{angle}° medial", angle=angle)
    return Message("{angle}° lateral", angle=angle)


def _words(name: str) -> str:
    return name.replace("_", " ")
