"""Usual positions of the library's pads on a foot, by its landmarks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from insole_core.foot.landmarks import HEADS, TOE_TIPS, Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import Place
from insole_core.insole.pads.clearance import clearance

_STEPS_BACK = 5  # the heads lie on an arc: the distance to it changes a little with the position
_RAY_BEHIND_MM = 12.0  # an extension of the ray begins this far behind the 1st head
_MIDDLE_HEADS = HEADS[1:4]
_BAND_BEHIND_MM = 12.0  # a pad under heads 2 to 5 begins this far behind them
_DANCERS_AHEAD_MM = 10.0  # a dancer's pad ends this far ahead of heads 2 to 5
_DANCERS_GAP_MM = 14.0  # and this far behind the 1st
_WEB = 0.65  # of the way from head 1 to head 2: the medial corners of such pads
_SULCUS_MM = 12.0  # the toes begin this far ahead of their heads
_LEAST_FILLER_MM = 20.0  # length for a toe whose tip was set where it ends
_LEAST_WIDTH_MM = 5.0
_STYLOID_INSIDE_MM = 8.0  # from the foot's lateral border to the base of the 5th metatarsal
_TUBERCLE = 0.15  # of the heel's width, from its centre to the medial tubercle

_Places: TypeAlias = Mapping[str, FloatArray]
_Placer: TypeAlias = Callable[[Pelott, Side, _Places, float], Pelott]


def placed_pad(
    pad: Pelott, place: str, side: Side, landmarks: Landmarks, behind_heads_mm: float
) -> Pelott:
    """Return a pad at its usual position on a foot.

    Parameters
    ----------
    pad
        Its own position and turn are ignored.
    place
        One of `PLACES`:
        "metatarsal_line", the front edge behind heads 2 to 4;
        "lesser_heads", a band under heads 2 to 5, as long as the pad, that ends halfway to the 1st;
        "around_first_head", a band under heads 2 to 5 that continues behind the 1st;
        "first_head", "fifth_head", on the head, along its ray;
        "head_1" to "head_5", the same, no wider than the distance to the next head;
        "first_ray", from behind the 1st head towards the tip of the 1st toe;
        "toe_1" to "toe_5", the front edge below the tip of the toe;
        "toe_room_1" to "toe_room_5", from ahead of the head to the tip, to the neighbouring toes;
        "ahead_of_foot", from the foremost landmark on;
        "arch", the apex under that of the arch, the flat side medial;
        "base_of_fifth", inside the middle of the lateral border between heel and 5th head;
        "cuboid", behind and medial of the base of the 5th metatarsal;
        "heel"; and "medial_tubercle", medial of the heel's centre.
    landmarks
        Of the foot, insole frame.
    behind_heads_mm
        Distance of the front edge from the line of the heads.

    Returns
    -------
    Pelott
        The pad; bands get the outline that the heads ask for, reliefs and fillers their size.
    """
    at = {name: mark.point[:2] for name, mark in landmarks.items()}
    return _PLACERS[place](pad, side, at, behind_heads_mm)


def _behind_heads(pad: Pelott, _side: Side, at: _Places, behind_heads_mm: float) -> Pelott:
    line = np.array([at[name] for name in _MIDDLE_HEADS])
    across = line[-1] - line[0]
    if pad.shape == "bar":  # extends from border to border, along the line
        middle = (at[HEADS[0]] + at[HEADS[-1]]) / 2
        turn = float(np.degrees(np.arctan2(across[1], across[0])))
        turn = (turn + 90.0) % 180.0 - 90.0
    else:
        middle, turn = line[1], 0.0
    laid = replace(pad, centre_mm=_place(middle), turn_deg=round(turn, 1))
    share = abs(across[0]) / np.hypot(*across)  # of a step back that takes it away from the line
    for _ in range(_STEPS_BACK):  # straight back: across the slanting line it would leave its ray
        step_mm = (clearance(laid, line).distance_mm - behind_heads_mm) / share
        x_mm, y_mm = laid.centre_mm
        laid = replace(laid, centre_mm=_place(np.array([x_mm, y_mm + step_mm])))
    return laid


def _under_lesser_heads(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    line = _lesser_heads(at)
    front = line + np.array([0.0, pad.length_mm - _BAND_BEHIND_MM])
    rear = line[::-1] - np.array([0.0, _BAND_BEHIND_MM])
    return _outlined(pad, np.concatenate([front, rear]))


def _around_first_head(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    line, first = _lesser_heads(at), at[HEADS[0]]
    front, gap = np.array([0.0, _DANCERS_AHEAD_MM]), np.array([0.0, -_DANCERS_GAP_MM])
    rear = front - np.array([0.0, pad.length_mm])
    border = _towards_border(first, at["metatarsale_tibiale"])
    web = np.array([line[0, 0], first[1]])
    around = np.array([border + rear, border + gap, web + gap])
    return _outlined(pad, np.concatenate([line + front, line[-1:] + rear, around]))


def _lesser_heads(at: _Places) -> FloatArray:
    """Return the line (3, 2) from between heads 1 and 2 over head 3 to beside head 5.

    The curve through these few corners follows the heads, has few handles, and reaches farther than
    they do: from halfway between heads 1 and 2 to the border of the foot.
    """
    first, second, third, _, fifth = (at[name] for name in HEADS)
    web = first + _WEB * (second - first)
    return np.array([web, third, _towards_border(fifth, at["metatarsale_fibulare"])])


def _towards_border(head: FloatArray, border: FloatArray) -> FloatArray:
    """Return the place beside a head halfway to the border of the foot."""
    return np.array([(head[0] + border[0]) / 2, head[1]])


def _outlined(pad: Pelott, corners: FloatArray) -> Pelott:
    """Return a free pad with these corners (n, 2), its apex at their centroid."""
    x, y = (corners - corners.mean(axis=0)).T
    cross = x * np.roll(y, -1) - y * np.roll(x, -1)
    offset = [(cross * (part + np.roll(part, -1))).sum() / (3 * cross.sum()) for part in (x, y)]
    centre = _place(corners.mean(axis=0) + offset)
    around = tuple(_place(corner) for corner in corners - np.array(centre))
    return replace(pad, centre_mm=centre, turn_deg=0.0, outline_mm=around)


def _at_head(number: int, pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    return replace(pad, centre_mm=_place(at[HEADS[number - 1]]), turn_deg=_turn(_ray(at, number)))


def _under_head(number: int, pad: Pelott, side: Side, at: _Places, behind: float) -> Pelott:
    beside = [at[HEADS[n - 1]] for n in (number - 1, number + 1) if 1 <= n <= len(HEADS)]
    room = min(float(np.hypot(*(head - at[HEADS[number - 1]]))) for head in beside)
    laid = _at_head(number, pad, side, at, behind)
    return replace(laid, width_mm=min(pad.width_mm, max(round(room, 1), _LEAST_WIDTH_MM)))


def _at_first_ray(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    ray = _ray(at, 1)
    centre = at[HEADS[0]] + (pad.length_mm / 2 - _RAY_BEHIND_MM) * ray
    return replace(pad, centre_mm=_place(centre), turn_deg=_turn(ray))


def _under_toe(number: int, pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    ray = _ray(at, number)
    centre = at[TOE_TIPS[number - 1]] - pad.length_mm / 2 * ray
    return replace(pad, centre_mm=_place(centre), turn_deg=_turn(ray))


def _in_toe_room(number: int, pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    """Lay a filler whose edge overlaps with that of the next toe's, so that both make one level."""
    ray, head = _ray(at, number), at[HEADS[number - 1]]
    reach = float((at[TOE_TIPS[number - 1]] - head) @ ray)
    length = max(reach - _SULCUS_MM, _LEAST_FILLER_MM)
    spaces = [_toe_space(at, number, n) for n in (number - 1, number + 1) if 1 <= n <= len(HEADS)]
    space = sum(spaces) / len(spaces)
    return replace(
        pad,
        centre_mm=_place(head + (_SULCUS_MM + length / 2) * ray),
        turn_deg=_turn(ray),
        length_mm=round(length, 1),
        width_mm=max(round(space + (pad.blend_mm or 0.0), 1), _LEAST_WIDTH_MM),
    )


def _toe_space(at: _Places, number: int, other: int) -> float:
    """Return the distance from the middle of a ray to that of another, across the ray."""
    middle, beside = ((at[HEADS[n - 1]] + at[TOE_TIPS[n - 1]]) / 2 for n in (number, other))
    x, y = _ray(at, number)
    return float(abs((beside - middle) @ [y, -x]))


def _ahead_of_foot(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    front = max(float(at[name][1]) for name in (*HEADS, *TOE_TIPS))
    middle = float(at[HEADS[0]][0] + at[HEADS[-1]][0]) / 2
    centre = np.array([middle, front + pad.length_mm / 2])
    return replace(pad, centre_mm=_place(centre), turn_deg=0.0)


def _at_arch(pad: Pelott, side: Side, at: _Places, _behind: float) -> Pelott:
    # The flat side of an arch support faces +x, which is medial on a left foot only.
    turn = 0.0 if side is Side.LEFT else 180.0
    return replace(pad, centre_mm=_place(at["arch_apex"]), turn_deg=turn)


def _at_base_of_fifth(pad: Pelott, side: Side, at: _Places, _behind: float) -> Pelott:
    base, ahead, _ = _lateral_border(side, at)
    return replace(pad, centre_mm=_place(base), turn_deg=_turn(ahead))


def _at_cuboid(pad: Pelott, side: Side, at: _Places, _behind: float) -> Pelott:
    base, ahead, medial = _lateral_border(side, at)
    centre = base - pad.length_mm / 2 * ahead + pad.width_mm / 2 * medial
    return replace(pad, centre_mm=_place(centre), turn_deg=_turn(ahead))


def _lateral_border(side: Side, at: _Places) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the base of the 5th metatarsal, and the directions ahead and medial of the border."""
    heel, head = at["heel_lateral"], at["metatarsale_fibulare"]
    ahead = (head - heel) / np.hypot(*(head - heel))
    medial = side.medial_sign * np.array([ahead[1], -ahead[0]])
    return (heel + head) / 2 + _STYLOID_INSIDE_MM * medial, ahead, medial


def _at_heel(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    return replace(pad, centre_mm=_place(at["heel_centre"]), turn_deg=0.0)


def _at_medial_tubercle(pad: Pelott, _side: Side, at: _Places, _behind: float) -> Pelott:
    across = at["heel_medial"] - at["heel_lateral"]
    return replace(pad, centre_mm=_place(at["heel_centre"] + _TUBERCLE * across), turn_deg=0.0)


def _ray(at: _Places, number: int) -> FloatArray:
    """Return the direction from a head to the tip of its toe."""
    ray = at[TOE_TIPS[number - 1]] - at[HEADS[number - 1]]
    return np.asarray(ray / np.hypot(*ray))


def _turn(direction: FloatArray) -> float:
    """Return the angle from +y to a direction, counter-clockwise."""
    x, y = direction
    return round(float(np.degrees(np.arctan2(-x, y))), 1)


def _place(xy: FloatArray) -> Place:
    return round(float(xy[0]), 2), round(float(xy[1]), 2)


_PLACERS: dict[str, _Placer] = {
    "metatarsal_line": _behind_heads,
    "lesser_heads": _under_lesser_heads,
    "around_first_head": _around_first_head,
    "first_head": partial(_at_head, 1),
    "fifth_head": partial(_at_head, 5),
    **{f"head_{n}": partial(_under_head, n) for n in range(1, 6)},
    "first_ray": _at_first_ray,
    **{f"toe_{n}": partial(_under_toe, n) for n in range(1, 6)},
    **{f"toe_room_{n}": partial(_in_toe_room, n) for n in range(1, 6)},
    "ahead_of_foot": _ahead_of_foot,
    "arch": _at_arch,
    "base_of_fifth": _at_base_of_fifth,
    "cuboid": _at_cuboid,
    "heel": _at_heel,
    "medial_tubercle": _at_medial_tubercle,
}
PLACES = tuple(_PLACERS)
"""Names of positions that the library may use."""
SIZED_BY_FOOT = ("lesser_heads", "around_first_head", *(f"toe_room_{n}" for n in range(1, 6)))
"""Positions at which a pad takes its size from the landmarks."""
