"""A prescription in words, for papers: a line for each correction, and how the insole is made.

Names, units and words come from the `vocabulary`: all fields are said, but those without a value
and those that do nothing beside others.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction, Pelott
from insole_core.insole.elements.pad_kinds import PAD_NAMES, ends_behind_heads, pad_name
from insole_core.insole.fields import Place
from insole_core.insole.pads.clearance import behind_heads_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.rim_sliders import cup_depth_mm, medial_flange_mm
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.prescription.vocabulary import (
    NAMES,
    RAISING,
    SPOKEN,
    WORDS,
    Spoken,
    acts,
    spoken,
)
from insole_core.messages import Message, joined

Values: TypeAlias = dict[str, str]
_PLACES = ("centre_mm", "apex_mm")
_DECIMALS = 1
"""The precision of the tool's own fields."""


def correction_lines(
    design: InsoleDesign, landmarks: Landmarks | None = None
) -> tuple[Message, ...]:
    """Return a line for every active correction: name, all its values, author and date.

    Parameters
    ----------
    landmarks
        Of the foot, insole frame; with them a pad that is laid by the heads says how far behind.
    """
    return tuple(_line(correction, design.side, landmarks) for correction in design.active)


def make_facts(design: InsoleDesign) -> dict[str, str]:
    """Return device, base, outline, layers, finish and shell, a text for each, by name."""
    return {
        name: value if isinstance(value, str) else _text(value)
        for name, value in make_values(design).items()
    }


def make_values(design: InsoleDesign) -> dict[str, str | Values]:
    """Return what `make_facts` says, with the values of each part by their names."""
    said: dict[str, str | Values] = {"device": design.device} if design.device else {}
    if design.base is not None:
        said["base form"] = {**_values(design.base.form), **_values(design.base)}
    said |= {
        "prescribed thickness": _mm(design.made_thickness_mm),
        "insole": _values(design),
        "outline": _values(design.outline),
    }
    if design.outline.shoe is not None:
        said["shoe"] = _values(design.outline.shoe)
    if design.layers.total_mm > 0:
        said["layers"] = _values(design.layers)
    if design.finish is not None:
        said |= _finish_values(design.finish)
    return said if design.shell is None else said | _shell_values(design.shell)


def plain_number(value: float, decimals: int = _DECIMALS) -> str:
    """Return a number as on paper: rounded, without needless zeros, and never "-0"."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def number_message(value: float, decimals: int = _DECIMALS) -> Message:
    """Return the same number to be translated: with the decimal sign of the language."""
    return Message("{number:g}", number=round(value, decimals) + 0.0)  # never -0


def _finish_values(finish: Finish) -> dict[str, str | Values]:
    said: dict[str, str | Values] = {"finish": _values(finish)}
    heights = {"heel cup": cup_depth_mm(finish), "medial flange": medial_flange_mm(finish)}
    said |= {name: _mm(height) for name, height in heights.items() if height is not None}
    for border in ("medial", "lateral"):
        stations = sorted((s for s in finish.rim if s.border == border), key=lambda s: s.along)
        if stations:
            said[f"{border} rim"] = joined((_text(_values(s), ", ") for s in stations), "; ")
    return said


def _shell_values(shell: Shell) -> dict[str, str | Values]:
    posts: dict[str, str | Values] = {f"{post.region} post": _values(post) for post in shell.posts}
    return {"shell": _values(shell), **posts}


def _line(correction: Correction, side: Side, landmarks: Landmarks | None) -> Message:
    said = [_text(_values(correction))]
    place = next((p for n in _PLACES if (p := getattr(correction, n, None)) is not None), None)
    if place is not None:
        said.append(_place(place, side))
    if landmarks is not None and isinstance(correction, Pelott) and ends_behind_heads(correction):
        said.append(_from_heads(behind_heads_mm(correction, landmarks)))
    signed = " ".join(word for word in (correction.author, correction.created_at[:10]) if word)
    what = {"correction": _title(correction), "values": joined(said, "; ")}
    if not signed:
        return Message("{correction}: {values}", **what)
    return Message("{correction}: {values} ({signed})", signed=signed, **what)


def _title(correction: Correction) -> str:
    if not isinstance(correction, Pelott):
        return NAMES[type(correction)]
    name = pad_name(correction)
    return name[0].upper() + name[1:]


def _values(part: Any) -> Values:
    """Return the values of a part that are set and do something, by their names."""
    return {
        said.name: _value(said, value)
        for name, said in ((name, spoken(part, name)) for name in SPOKEN[type(part)])
        if name not in _PLACES
        and acts(part, name)
        and (value := getattr(part, name)) is not None
        and value != ""
    }


def _text(values: Mapping[str, str], between: str = "; ") -> Message:
    said = (Message("{name} {value}", name=name, value=value) for name, value in values.items())
    return joined(said, between)


def _value(said: Spoken, value: Any) -> Message:
    if isinstance(value, bool):
        return Message(said.words.get(value, "yes" if value else "no"))
    if isinstance(value, str):
        return Message(said.words.get(value) or WORDS.get(value) or PAD_NAMES.get(value, value))
    if isinstance(value, tuple):
        return _pair(said, value) if isinstance(value[0], float | int) else _curve(value)
    if said.template == RAISING:
        return _raised(value)
    return Message(said.template, value=number_message(said.scale * value, said.decimals))


def _pair(said: Spoken, pair: Place) -> Message:
    both = joined((number_message(value, said.decimals) for value in pair), " × ")
    return Message(said.template, value=both)


def _curve(points_mm: tuple[Place, ...]) -> Message:
    """Tell a drawn line by its points, its size and its middle."""
    points = np.array(points_mm, float)
    (width, length), (x, y) = np.ptp(points, axis=0), points.mean(axis=0)
    return Message(
        "through {count:g} points, {width} × {length} mm, its middle at x = {x}, y = {y} mm",
        count=len(points),
        width=number_message(float(width)),
        length=number_message(float(length)),
        x=number_message(float(x), 2),
        y=number_message(float(y), 2),
    )


def _place(place_mm: Place, side: Side) -> Message:
    """Say where a place lies, as the window does: medial of the axis on either foot."""
    across, from_heel = place_mm[0] * side.medial_sign, _mm(place_mm[1])
    values = {"across": _mm(abs(across)), "from_heel": from_heel}
    if across < 0:
        return Message("{across} lateral of the axis, {from_heel} from the heel", **values)
    return Message("{across} medial of the axis, {from_heel} from the heel", **values)


def _from_heads(distance_mm: float) -> Message:
    distance = _mm(abs(distance_mm))
    if distance_mm < 0:
        return Message("{distance} ahead of the heads", distance=distance)
    return Message("{distance} behind the heads", distance=distance)


def _raised(angle_deg: float) -> Message:
    angle = number_message(abs(angle_deg))
    if angle == "0":
        return Message("0°")
    if angle_deg > 0:
        return Message("{angle}° medial", angle=angle)
    return Message("{angle}° lateral", angle=angle)


def _mm(value: float) -> Message:
    return Message("{number} mm", number=number_message(value))
