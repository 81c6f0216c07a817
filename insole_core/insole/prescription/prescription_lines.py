"""A prescription in words, for papers: a line for each correction, and how the insole is made.

Names, units and words are those that the values are declared with: all are said, but those that are
not set and those that do nothing beside others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np

from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction, Pelott
from insole_core.insole.elements.words import mm_message, number_message, worded
from insole_core.insole.fields import Declared, Line, Part, Place, Spot, Table, declared
from insole_core.insole.pads.clearance import behind_heads_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.rim_sliders import cup_depth_mm, medial_flange_mm
from insole_core.insole.prescription.shell import Shell
from insole_core.messages import Message, joined

Values: TypeAlias = dict[str, str]


def correction_lines(
    design: InsoleDesign, landmarks: Landmarks | None = None
) -> tuple[Message, ...]:
    """Return a line for every active correction: name, all its values, author and date.

    Parameters
    ----------
    landmarks
        Of the foot, insole frame; with them a pad that is laid by the heads says how far behind.
    """
    behind_mm = {} if landmarks is None else _behind_heads_mm(design, landmarks)
    return tuple(_line(c, design.side, behind_mm.get(c.id)) for c in design.active)


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
        "prescribed thickness": mm_message(design.made_thickness_mm),
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


def _finish_values(finish: Finish) -> dict[str, str | Values]:
    said: dict[str, str | Values] = {"finish": _values(finish)}
    heights = {"heel cup": cup_depth_mm(finish), "medial flange": medial_flange_mm(finish)}
    said |= {name: mm_message(height) for name, height in heights.items() if height is not None}
    for border in ("medial", "lateral"):
        stations = sorted((s for s in finish.rim if s.border == border), key=lambda s: s.along)
        if stations:
            said[f"{border} rim"] = joined((_text(_values(s), ", ") for s in stations), "; ")
    return said


def _shell_values(shell: Shell) -> dict[str, str | Values]:
    posts: dict[str, str | Values] = {f"{post.region} post": _values(post) for post in shell.posts}
    return {"shell": _values(shell), **posts}


def _behind_heads_mm(design: InsoleDesign, landmarks: Landmarks) -> dict[str, float]:
    """Return how far behind the heads each pad lies that is laid by them, by its id."""
    laid = (pad for pad in design.of(Pelott) if pad.ends_behind_heads)
    return {pad.id: behind_heads_mm(pad, landmarks) for pad in laid}


def _line(correction: Correction, side: Side, behind_mm: float | None) -> Message:
    said = [_text(_values(correction)), *_places(correction, side)]
    if behind_mm is not None:
        said.append(_from_heads(behind_mm))
    signed = " ".join(word for word in (correction.author, correction.created_at[:10]) if word)
    what = {"correction": correction.title, "values": joined(said, "; ")}
    if not signed:
        return Message("{correction}: {values}", **what)
    return Message("{correction}: {values} ({signed})", signed=signed, **what)


def _values(part: Part) -> Values:
    """Return the values of a part that are set and do something, by their names."""
    fields = ((name, part.declared(name)) for name in declared(type(part)) if part.acts(name))
    return {
        found.label: _value(found, value)
        for name, found in fields
        if not isinstance(found, Spot | Table) and (value := getattr(part, name)) not in (None, "")
    }


def _text(values: Mapping[str, str], between: str = "; ") -> Message:
    said = (Message("{name} {value}", name=name, value=value) for name, value in values.items())
    return joined(said, between)


def _value(found: Declared, value: Any) -> Message:
    return _curve(value) if isinstance(found, Line) else worded(found, value)


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


def _places(part: Part, side: Side) -> Iterator[Message]:
    """Say where the places of a part lie, as the window does: medial of the axis on either foot."""
    spots = (name for name, found in declared(type(part)).items() if isinstance(found, Spot))
    for place_mm in filter(None, (getattr(part, name) for name in spots)):
        across, from_heel = place_mm[0] * side.medial_sign, mm_message(place_mm[1])
        values = {"across": mm_message(abs(across)), "from_heel": from_heel}
        if across < 0:
            yield Message("{across} lateral of the axis, {from_heel} from the heel", **values)
        else:
            yield Message("{across} medial of the axis, {from_heel} from the heel", **values)


def _from_heads(distance_mm: float) -> Message:
    distance = mm_message(abs(distance_mm))
    if distance_mm < 0:
        return Message("{distance} ahead of the heads", distance=distance)
    return Message("{distance} behind the heads", distance=distance)
