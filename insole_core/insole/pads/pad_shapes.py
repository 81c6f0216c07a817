"""Outlines of all pads, such as the egg (26), relative to their apex before they are turned, mm."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.insole.fields import Place
from insole_core.insole.pads.pad_form import PadForm
from insole_core.insole.primitives.outline_curve import closed_curve
from insole_core.memo import Memo

_OUTLINE_POINTS = 1440
_Pad = TypeVar("_Pad", bound=PadForm)
_DROP_RATIO = 0.9
_SUPPORT_FLAT, _SUPPORT_ROUND = 0.35, 0.65  # shares of the width on both sides of the apex
_LEG_SHARE = 0.3  # breadth of a horseshoe's leg relative to the width
_POINTS = 720
_TIP_POINTS = 24
_outlines = Memo(64)
"""Outlines by shape and size, shared by all cases; 23 kB each."""


def _egg_curve(
    length_mm: float, width_mm: float, ratio: float, points: int = _OUTLINE_POINTS
) -> FloatArray:
    """Compute the outline of an egg about its apex, the blunt end towards +y.

    (26) in polar form about the pointed end, angle p from the egg's axis, with a = 1 and b = r:
    rho = cos p (1 - r sin^2 p). The apex stands where the egg is widest.

    Parameters
    ----------
    length_mm, width_mm
        Size along y and x.
    ratio
        r of (26), 0 to 1.

    Returns
    -------
    (points, 2) float64, mm, pad frame
        Counter-clockwise; the first point is not repeated.
    """
    p = (np.arange(points) + 0.5) / points * np.pi - np.pi / 2
    rho = np.cos(p) * (1 - ratio * np.sin(p) ** 2)
    unit = np.stack([rho * np.sin(p), rho * np.cos(p)], axis=1)[::-1]
    half, along = _polar(ratio, _widest_angle(ratio))
    size = np.array([width_mm / (2 * half), length_mm])
    return np.asarray((unit - np.array([0.0, along])) * size)


def _polar(ratio: float, p: float) -> tuple[float, float]:
    rho = np.cos(p) * (1 - ratio * np.sin(p) ** 2)
    return float(rho * np.sin(p)), float(rho * np.cos(p))


def _widest_angle(ratio: float) -> float:
    """Return the angle at which x = sin p cos p (1 - r sin^2 p) is greatest.

    With s = sin^2 p its derivative vanishes where 1 - (2 + 3 r) s + 4 r s^2 = 0.
    """
    linear = 2 + 3 * ratio
    # The form without cancellation holds for r = 0 (the circle) as well.
    s = 2 / (linear + np.sqrt(linear**2 - 16 * ratio))
    return float(np.arcsin(np.sqrt(s)))


def local_outline(pad: PadForm) -> FloatArray:
    """Return the outline (n, 2) in the pad frame, mm; shared and read-only."""
    ratio = {"egg": pad.egg_ratio, "drop": _DROP_RATIO}.get(pad.shape, 0.0)
    key = pad.shape, pad.length_mm, pad.width_mm, ratio, pad.outline_mm
    return _outlines.get("outline", key, lambda: _outline(*key))


def pad_size(pad: PadForm) -> tuple[float, float]:
    """Return length and width of the outline before it is turned, mm."""
    if pad.outline_mm is None:
        return pad.length_mm, pad.width_mm
    width, length = np.ptp(local_outline(pad), axis=0)
    return float(length), float(width)


def resized(pad: _Pad, length_mm: float, width_mm: float) -> _Pad:
    """Return the pad with another length and width; a free outline is stretched about its apex."""
    if pad.outline_mm is None:
        return replace(pad, length_mm=length_mm, width_mm=width_mm)
    length, width = pad_size(pad)
    along, across = length_mm / length, width_mm / width
    return replace(pad, outline_mm=tuple((x * across, y * along) for x, y in pad.outline_mm))


def pad2insole(pad: PadForm) -> FloatArray:
    """Return the (2, 2) rotation from pad to insole frame."""
    angle = np.radians(pad.turn_deg)
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def is_seen_whole(pad: PadForm) -> bool:
    """Return whether every ray from the apex meets the outline once."""
    x, y = local_outline(pad).T
    turn = x * np.roll(y, -1) - y * np.roll(x, -1)
    return bool((turn > 0).all())


def _outline(
    shape: str,
    length_mm: float,
    width_mm: float,
    ratio: float,
    corners_mm: tuple[Place, ...] | None,
) -> FloatArray:
    if corners_mm is not None:
        outline = _counter_clockwise(closed_curve(corners_mm))
    elif shape in {"egg", "drop"}:
        outline = _egg_curve(length_mm, width_mm, ratio)
    elif shape == "horseshoe":
        outline = _bow(length_mm, width_mm)
    else:
        outline = _superellipse(shape, length_mm, width_mm)
    outline.setflags(write=False)
    return outline


def _superellipse(shape: str, length_mm: float, width_mm: float) -> FloatArray:
    """Return |x / a|^n + |y / b|^n = 1; an arch support has two different halves."""
    right, left = {
        "bar": ((0.5, 5.0), (0.5, 5.0)),
        "mortons_extension": ((0.5, 4.0), (0.5, 4.0)),
        "cut_out": ((0.5, 2.0), (0.5, 2.0)),
        "oval": ((0.5, 2.0), (0.5, 2.0)),
        "arch_support": ((_SUPPORT_FLAT, 4.0), (_SUPPORT_ROUND, 2.0)),
    }[shape]
    angle = (np.arange(_POINTS) + 0.5) / _POINTS * 2 * np.pi
    cos, sin = np.abs(np.cos(angle)), np.abs(np.sin(angle))
    half, power = (
        np.where((angle < np.pi / 2) | (angle > 3 * np.pi / 2), r, s)
        for r, s in zip(right, left, strict=True)
    )
    reach = (cos / (half * width_mm)) ** power + (sin / (0.5 * length_mm)) ** power
    return _circle(angle) * (reach ** (-1 / power))[:, None]


def _bow(length_mm: float, width_mm: float) -> FloatArray:
    """Return a horseshoe: a half ring around the centre, two legs towards +y, round tips."""
    leg = _LEG_SHARE * width_mm
    outer, inner = width_mm / 2, width_mm / 2 - leg
    middle = outer - leg / 2
    reach = max(length_mm - outer - leg / 2, 0.0)
    back = np.linspace(-np.pi, 0, _POINTS // 4)
    tip = np.linspace(0, np.pi, _TIP_POINTS + 2)[1:-1]
    parts = [
        outer * _circle(back),
        leg / 2 * _circle(tip) + [middle, reach],
        inner * _circle(back[::-1]),
        leg / 2 * _circle(tip) + [-middle, reach],
    ]
    legs = [[outer, reach]], [[inner, reach]], [[-inner, reach]], [[-outer, reach]]
    way = [parts[0], legs[0], parts[1], legs[1], parts[2], legs[2], parts[3], legs[3]]
    return np.concatenate([np.asarray(part) for part in way])


def _circle(angle: FloatArray) -> FloatArray:
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _counter_clockwise(curve: FloatArray) -> FloatArray:
    return curve if signed_area_mm2(curve) > 0 else curve[::-1].copy()
