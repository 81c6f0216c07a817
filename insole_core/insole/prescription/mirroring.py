"""The same prescription for the other foot."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any, TypeVar

from insole_core.insole.elements import Correction, Pelott
from insole_core.insole.fields import Place
from insole_core.insole.prescription.design import InsoleDesign

PLACE_KEYS = ("centre_mm", "apex_mm", "points_mm", "trim_mm")
"""Keys that hold positions on the foot: one, a list of them, or None."""

_Part = TypeVar("_Part")


def mirrored(design: InsoleDesign) -> InsoleDesign:
    """Mirror a design in the plane x = 0; medial stays medial, ids stay the same.

    Mirroring twice returns the original, except that turns of 360 degrees are unwound.
    """
    return replace(
        design,
        side=design.side.other,
        corrections=tuple(mirrored_correction(c) for c in design.corrections),
        outline=with_places(design.outline, _reflected),
        shell=None if design.shell is None else with_places(design.shell, _reflected),
    )


def mirrored_correction(correction: Correction) -> Correction:
    """Mirror one correction; angles and borders are already given as medial and lateral."""
    moved = with_places(correction, _reflected)
    if not isinstance(moved, Pelott):
        return moved
    # Every shape is symmetric across its width, but the arch support, which is along its length.
    turn = 180.0 - moved.turn_deg if moved.shape == "arch_support" else -moved.turn_deg
    corners = moved.outline_mm
    return replace(
        moved,
        turn_deg=turn if abs(turn) <= 360 else turn - 360 * (1 if turn > 0 else -1),
        outline_mm=None if corners is None else tuple(_reflected(corner) for corner in corners),
    )


def with_places(part: _Part, move: Any) -> _Part:
    """Return a correction or an outline with all its positions on the foot moved.

    Parameters
    ----------
    part
        A frozen dataclass; its fields in `PLACE_KEYS` are changed.
    move
        Maps a position (x, y) in mm to another.
    """
    changes = {}
    for key in (f.name for f in fields(part) if f.name in PLACE_KEYS):  # type: ignore[arg-type]
        value = getattr(part, key)
        if value is not None:
            several = isinstance(value[0], tuple)
            changes[key] = tuple(move(p) for p in value) if several else move(value)
    return replace(part, **changes)  # type: ignore[type-var]


def _reflected(place: Place) -> Place:
    return -place[0], place[1]
