"""Where a pad can be grabbed, and what it becomes when it is pulled there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import ranges_of
from insole_core.insole.grips import Grip, Pull, place_at
from insole_core.insole.pads.pad_form import PadForm
from insole_core.insole.pads.pad_shapes import local_outline, pad2insole, pad_size, resized

_SIZE_STEP_MM = 0.5
_TURN_STEP_DEG = 0.5
_HEIGHT_STEP_MM = 0.1
_TURN_GAP_MM = 12.0
_CORNER_GAP_MM = 6.0
_RAISED_PER_MM = 0.25
_NOTCH_MM = 0.5 / _RAISED_PER_MM


def pad_grips(pad: PadForm) -> tuple[Grip, ...]:
    """Return the grips of a pad, those at the corners of a free outline last."""
    front, back = _reach(pad)
    along, across = _axes(pad)
    centre, beside = np.array(pad.centre_mm), _beside_corners_mm(pad)
    places = {
        "move": centre,
        "turn": centre + (front + beside + _TURN_GAP_MM) * along,
        "height": centre - (back + beside) * along,
        "length": centre + (front + beside) * along,
        "width": centre + (_breadth(pad) + beside) * across,
    }
    if pad.outline_mm is not None:
        corners = np.array(pad.outline_mm) @ pad2insole(pad).T + centre
        places.update({f"corner:{number}": corner for number, corner in enumerate(corners)})
    return tuple(_grip(name, place) for name, place in places.items())


def pulled_values(pad: PadForm, grip: str, pull: Pull) -> dict[str, Any]:
    """Return the values that a pad gets when one of its grips is pulled, by their names."""
    name, _, number = grip.partition(":")
    if name == "height":
        return _raised(pad, pull)
    if name == "move":
        moved = np.array(pad.centre_mm) + pull.moved_mm
        return {"centre_mm": place_at(moved, pull.step_mm)} if pull.moved_mm.any() else {}
    if pull.now is None:
        return {}
    offset = pull.now - np.array(pad.centre_mm)
    if name == "corner":
        return _with_corner(pad, int(number), offset)
    return _PULLED[name](pad, offset)


def _grip(name: str, place: FloatArray) -> Grip:
    what = name.partition(":")[0]
    hint, sentence = _WORDS[what]
    return Grip(
        name,
        (float(place[0]), float(place[1])),
        hint,
        sentence,
        what if what in ("move", "corner") else "size",
        has_keys=what == "move",
        notch_mm=_NOTCH_MM if what == "height" else 0.0,
    )


def _raised(pad: PadForm, pull: Pull) -> dict[str, Any]:
    height = rounded(pad.height_mm + pull.up_mm * _RAISED_PER_MM, _HEIGHT_STEP_MM)
    return {"height_mm": _within("height_mm", height)}


def _lengthened(pad: PadForm, offset: FloatArray) -> dict[str, Any]:
    length, width = pad_size(pad)
    share = (float(offset @ _axes(pad)[0]) - _beside_corners_mm(pad)) / _reach(pad)[0]
    return _sized(pad, _within("length_mm", rounded(length * share, _SIZE_STEP_MM)), width)


def _widened(pad: PadForm, offset: FloatArray) -> dict[str, Any]:
    length, width = pad_size(pad)
    share = (float(offset @ _axes(pad)[1]) - _beside_corners_mm(pad)) / _breadth(pad)
    return _sized(pad, length, _within("width_mm", rounded(width * share, _SIZE_STEP_MM)))


def _sized(pad: PadForm, length_mm: float, width_mm: float) -> dict[str, Any]:
    sized = resized(pad, length_mm, width_mm)
    names = ("length_mm", "width_mm", "outline_mm")
    return {name: getattr(sized, name) for name in names}


def _turned(_pad: PadForm, offset: FloatArray) -> dict[str, Any]:
    turn = float(np.degrees(np.arctan2(-offset[0], offset[1])))
    return {"turn_deg": rounded(turn, _TURN_STEP_DEG)}


def _with_corner(pad: PadForm, number: int, offset: FloatArray) -> dict[str, Any]:
    corners = list(pad.outline_mm or ())
    corners[number] = place_at(offset @ pad2insole(pad))
    return {"outline_mm": tuple(corners)}


def _axes(pad: PadForm) -> tuple[FloatArray, FloatArray]:
    """Return unit vectors along the pad (towards its blunt end) and across."""
    across, along = pad2insole(pad).T
    return along, across


def _reach(pad: PadForm) -> tuple[float, float]:
    """Return the extent of the outline in front of and behind the apex, mm."""
    y = local_outline(pad)[:, 1]
    return float(y.max()), float(-y.min())


def _breadth(pad: PadForm) -> float:
    """Return the extent of the outline to +x of the apex, mm."""
    return float(local_outline(pad)[:, 0].max())


def _beside_corners_mm(pad: PadForm) -> float:
    """Return how far outside the outline grips stand, so that they cover no corner."""
    return 0.0 if pad.outline_mm is None else _CORNER_GAP_MM


def _within(name: str, value: float) -> float:
    return float(ranges_of(PadForm)[name].nearest(value))


_PULLED: dict[str, Callable[[PadForm, FloatArray], dict[str, Any]]] = {
    "length": _lengthened,
    "width": _widened,
    "turn": _turned,
}
_WORDS = {
    "move": ("Drag to move the pad", "Move the pad"),
    "length": ("Drag to make it longer or shorter", "Stretch the pad"),
    "width": ("Drag to make it wider or narrower", "Widen the pad"),
    "turn": ("Drag to turn the pad", "Turn the pad"),
    "height": ("Drag up to raise the pad, down to lower it", "Raise the pad"),
    "corner": ("Drag to change the outline", "Change the outline of the pad"),
}
"""What dragging a grip does, and what was done."""
