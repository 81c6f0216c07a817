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

_UNITS = {"_mm": " mm", "_deg": "°", "_eu": " EU"}
_DECIMALS, _DECIMALS_OF_A_SHARE = 1, 2
"""The precision of the tool's own fields."""
_RAISING = {"rearfoot_deg", "forefoot_deg", "angle_deg"}
"""Angles that raise the medial edge above 0, the lateral one below."""
_LENGTH_SHARES = {"blend_start", "blend_end", "fade_start", "fade_end"}
_SILENT = {"id", "enabled", "author", "created_at", "kind"}


def correction_lines(design: InsoleDesign) -> tuple[str, ...]:
    """Return a line for every active correction: type, all its numbers, author and date."""
    return tuple(_line(correction) for correction in design.active)


def plain_number(value: float, decimals: int = _DECIMALS) -> str:
    """Return a number as on paper: rounded, without needless zeros, and never "-0"."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def make_facts(design: InsoleDesign) -> dict[str, str]:
    """Return device, base, thickness, layers, bottom, outline, finish and shell, by name."""
    layers = design.layers
    facts = {"device": design.device} if design.device else {}
    if design.base is not None:
        share = plain_number(100 * design.base.contact_share)
        facts["base form"] = f"{design.base.form.name}, {share} % of the foot"
    facts |= {
        "prescribed thickness": f"{plain_number(design.made_thickness_mm)} mm",
        "bottom": design.bottom,
        "outline": f"{_words(design.outline.source)}, {_words(design.outline.extent)}",
    }
    if design.outline.width_mm is not None:
        width = plain_number(design.outline.width_mm)
        facts["width"] = f"{width} mm from the bisection of the 1st metatarsal"
    if layers.total_mm > 0:
        thicknesses = (layers.cover_mm, layers.shell_mm, layers.base_mm)
        facts["cover / middle layer / base"] = f"{' / '.join(map(plain_number, thicknesses))} mm"
    if design.taken_off_mm > 0:
        facts["cover, glued on later"] = f"{plain_number(design.taken_off_mm)} mm"
    if design.finish is not None:
        facts |= _finish_facts(design.finish)
    return facts if design.shell is None else facts | _shell_facts(design, design.shell)


def _finish_facts(finish: Finish) -> dict[str, str]:
    """Return what is prescribed of the finish, by name; nothing that is 0."""
    facts = {"toe zone": _words(finish.toe_zone)}
    lengths = {
        "heel cup": cup_depth_mm(finish),
        "medial flange": medial_flange_mm(finish),
        "arch fill": finish.arch_fill_mm,
        "expansion": finish.expansion_mm,
    }
    return facts | {name: f"{plain_number(mm)} mm" for name, mm in lengths.items() if mm}


def _shell_facts(design: InsoleDesign, shell: Shell) -> dict[str, str]:
    """Return what is prescribed of a shell, by name; nothing that is 0."""
    facts = {"material of the shell": shell.material} if shell.material else {}
    if shell.body_weight_kg is not None:
        facts["body weight"] = f"{plain_number(shell.body_weight_kg)} kg"
    facts["end taper"] = (
        f"{plain_number(shell.taper_mm)} mm over {plain_number(shell.taper_length_mm)} mm"
    )
    for post in shell.posts:
        length = "usual" if post.length_mm is None else f"{plain_number(post.length_mm)} mm"
        facts[f"{post.region} post"] = (
            f"{_raised(post.angle_deg)}, length {length}, edge {plain_number(post.edge_radius_mm)} "
            "mm"
        )
    if design.outline.extent == "three_quarter" and design.outline.source != "drawn":
        points = shell.trim_mm
        facts["trim line"] = "usual" if points is None else f"through {len(points)} points"
    lengths = {
        "edge radius": shell.edge_radius_mm,
        "chamfer": shell.chamfer_mm,
        "heel pitch": shell.heel_pitch_mm,
    }
    facts |= {name: f"{plain_number(mm)} mm" for name, mm in lengths.items() if mm > 0}
    medial, lateral = shell.draft_medial_deg, shell.draft_lateral_deg
    facts["draft of the walls"] = (
        f"medial {plain_number(medial)}°, lateral {plain_number(lateral)}°"
    )
    return facts


def _line(correction: Correction) -> str:
    values = [
        _value(field.name, getattr(correction, field.name))
        for field in fields(correction)
        if field.name not in _unsaid(correction) and getattr(correction, field.name) is not None
    ]
    signed = " ".join(word for word in (correction.author, correction.created_at[:10]) if word)
    line = f"{_title(correction)}: {'; '.join(values)}"
    return f"{line} ({signed})" if signed else line


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


def _value(name: str, value: Any) -> str:
    if name in _RAISING:
        return f"{_words(name.removesuffix('_deg'))} {_raised(value)}"
    if name in _LENGTH_SHARES:
        return f"{_words(name)} {plain_number(100 * value)} % of the length"
    unit = next((unit for suffix, unit in _UNITS.items() if name.endswith(suffix)), "")
    for suffix in _UNITS:
        name = name.removesuffix(suffix)
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return f"{_words(name)} {len(value)} points"
    numbers = value if isinstance(value, tuple) else (value,)
    decimals = _DECIMALS if unit else _DECIMALS_OF_A_SHARE
    text = ", ".join(
        _words(n) if isinstance(n, str) else plain_number(n, decimals) for n in numbers
    )
    return f"{_words(name)} {text}{unit}"


def _raised(angle_deg: float) -> str:
    number = plain_number(abs(angle_deg))
    if number == "0":
        return "0°"
    return f"{number}° medial" if angle_deg > 0 else f"{number}° lateral"


def _words(name: str) -> str:
    return name.replace("_", " ")
