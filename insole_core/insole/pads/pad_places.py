"""Usual positions of the library's pads on a foot, by its landmarks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.foot.landmarks import HEADS, Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.pads.clearance import clearance
from insole_core.insole.prescription.corrections import Pelott

_RAY_BEHIND_MM = 12.0  # an extension of the ray begins this far behind the 1st head
_MIDDLE_HEADS = HEADS[1:4]


def placed_pad(
    pad: Pelott, place: str, side: Side, landmarks: Landmarks, behind_heads_mm: float
) -> Pelott:
    """Return a pad at its usual position on a foot.

    Parameters
    ----------
    pad
        Its own position and turn are ignored.
    place
        One of `PLACES`: "metatarsal_line" (the front edge behind heads 2 to 4), "arch" (the
        apex under that of the arch, the flat side medial), "heel", "first_head", or "first_ray"
        (from behind the 1st head towards the tip of the 1st toe).
    landmarks
        Of the foot, insole frame.
    behind_heads_mm
        Distance of the front edge from the line of the heads.
    """
    at = {name: mark.point[:2] for name, mark in landmarks.items()}
    return _PLACERS[place](pad, side, at, behind_heads_mm)


def _behind_heads(
    pad: Pelott, _side: Side, at: dict[str, FloatArray], behind_heads_mm: float
) -> Pelott:
    line = np.array([at[name] for name in _MIDDLE_HEADS])
    across = line[-1] - line[0]
    if pad.shape == "bar":  # extends from border to border, along the line
        middle = (at[HEADS[0]] + at[HEADS[-1]]) / 2
        turn = float(np.degrees(np.arctan2(across[1], across[0])))
        turn = (turn + 90.0) % 180.0 - 90.0
    else:
        middle, turn = line[1], 0.0
    laid = replace(pad, centre_mm=_place(middle), turn_deg=round(turn, 1))
    for _ in range(2):  # the line is an arc: its distance changes a little with the position
        found = clearance(laid, line)
        ahead = (found.nearest - found.front) / (found.distance_mm or 1.0)
        step = (found.distance_mm - behind_heads_mm) * ahead
        laid = replace(laid, centre_mm=_place(np.array(laid.centre_mm) + step))
    return laid


def _at_arch(pad: Pelott, side: Side, at: dict[str, FloatArray], _behind: float) -> Pelott:
    # The flat side of an arch support faces +x, which is medial on a left foot only.
    turn = 0.0 if side is Side.LEFT else 180.0
    return replace(pad, centre_mm=_place(at["arch_apex"]), turn_deg=turn)


def _at_heel(pad: Pelott, _side: Side, at: dict[str, FloatArray], _behind: float) -> Pelott:
    return replace(pad, centre_mm=_place(at["heel_centre"]), turn_deg=0.0)


def _at_first_head(pad: Pelott, _side: Side, at: dict[str, FloatArray], _behind: float) -> Pelott:
    return replace(pad, centre_mm=_place(at["metatarsal_head_1"]), turn_deg=_turn_of_ray(at))


def _at_first_ray(pad: Pelott, _side: Side, at: dict[str, FloatArray], _behind: float) -> Pelott:
    ahead = at["toe_tip_1"] - at["metatarsal_head_1"]
    ahead = ahead / np.hypot(*ahead)
    centre = at["metatarsal_head_1"] + (pad.length_mm / 2 - _RAY_BEHIND_MM) * ahead
    return replace(pad, centre_mm=_place(centre), turn_deg=_turn_of_ray(at))


def _turn_of_ray(at: dict[str, FloatArray]) -> float:
    """Return the angle from +y to the ray from 1st head to 1st toe tip, counter-clockwise."""
    x, y = at["toe_tip_1"] - at["metatarsal_head_1"]
    return round(float(np.degrees(np.arctan2(-x, y))), 1)


def _place(xy: FloatArray) -> tuple[float, float]:
    return round(float(xy[0]), 2), round(float(xy[1]), 2)


_PLACERS: dict[str, Callable[[Pelott, Side, dict[str, FloatArray], float], Pelott]] = {
    "metatarsal_line": _behind_heads,
    "arch": _at_arch,
    "heel": _at_heel,
    "first_head": _at_first_head,
    "first_ray": _at_first_ray,
}
PLACES = tuple(_PLACERS)
"""Names of positions that the library may use."""
