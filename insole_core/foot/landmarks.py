"""The landmarks of a foot, on which corrections and measures are based, found on its surface.

All points are in the insole frame. Outermost points are found by `SoleSurface.support`, which fits
how a rounded border turns towards its end, so that neither noise nor a border that was measured in
part moves them much. The metatarsal heads lie under the skin: they are placed by the usual
proportions between the outermost points of the ball (table `_HEADS`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from insole_core.foot.border_fit import UsualBorder
from insole_core.foot.foot import Foot
from insole_core.foot.levelling import is_cut_behind
from insole_core.foot.outermost import ramp
from insole_core.foot.rear_axes import Axis, achilles_axis, calcaneus_axis
from insole_core.foot.round_end import UsualEnd
from insole_core.foot.sole_surface import LowFoot, SoleSurface
from insole_core.foot.toe_end import GUESS, SURE, End
from insole_core.geometry.arrays import FloatArray

HEADS = tuple(f"metatarsal_head_{number}" for number in range(1, 6))
TOE_TIPS = tuple(f"toe_tip_{number}" for number in range(1, 6))
AXES = ("achilles_lower", "achilles_upper", "calcaneus_lower", "calcaneus_upper")
NAMES = (
    "pternion", "heel_centre", "heel_medial", "heel_lateral", "metatarsale_tibiale",
    "metatarsale_fibulare", *HEADS, *TOE_TIPS, "arch_apex", *AXES,
)  # fmt: skip

_TIBIALE, _FIBULARE = (0.60, 0.80), (0.50, 0.75)  # shares of the length where the ball is widest
_USUAL_TIBIALE, _USUAL_FIBULARE, _USUAL_HEEL = 0.737, 0.64, 0.17
_HEEL, _REAR = (0.10, 0.22), (0.0, 0.12)
_MEDIAL, _LATERAL = np.array([1.0, 0.0]), np.array([-1.0, 0.0])
_HEADS = np.array(
    [  # share across from the 1st to the 5th head, and ahead of their line in ball widths
        (0.0, 0.0), (0.31, 0.124), (0.555, 0.11), (0.782, 0.061), (1.0, 0.0),
    ]
)  # fmt: skip
_FIRST, _FIFTH = np.array([-0.167, 0.03]), np.array([0.145, 0.085])
"""From the outermost points of the ball to the heads, in ball widths: medial, ahead."""
_BEHIND = UsualEnd((22.0, 8.0), (32.0, 10.0), (30.0, 20.0), (50.0, 25.0))
_MEDIAL_HEEL = UsualBorder((29, 29, 31, 7), (23, 24, 26, 6), (60, 60, 60, 20), 80, np.inf, True)
_LATERAL_HEEL = UsualBorder((26, 26, 28, 7), (19, 20, 22, 6), (60, 60, 60, 20), 80, np.inf, True)
_MEDIAL_BORDER = UsualBorder(
    (22, 18, 18, 6), (22, 20, 20, 9), (26, 24, 20, 10), 50, 10, alike_mm=16
)
_LATERAL_BORDER = UsualBorder(
    (13, 12.5, 12, 4), (10, 10, 10, 5), (20, 20, 20, 9), 50, 30, alike_mm=25
)
_ARCH = (0.25, 0.85)  # shares of the way from heel centre to 1st head
_ARCH_RISE_MM = 3.0  # least height of a clear arch
_OUTER_TOES, _TOES = {"toe_tip_1": _MEDIAL, "toe_tip_5": _LATERAL}, (0.82, 0.97)
"""Toes whose side is one of the foot, and shares of the length where it lies."""
_OF_HEEL = ("pternion", "heel_medial", "heel_lateral")
_OF_BALL = ("metatarsale_tibiale", "metatarsale_fibulare")
_FACET_MM2, _COARSE = (8.0, 40.0), 0.35  # of a plane facet about an end, and the confidence then
_UNPLACED = 0.45  # most confidence in the ball's ends, which are sought by a length that is a guess
_LIKELY = 0.7  # confidence of a place by proportions, of that of the places around it


@dataclass(frozen=True, eq=False)
class Landmark:
    """A point of the foot.

    Parameters
    ----------
    point : (3,) float64, mm, insole frame
    confidence
        0 (a guess from the usual proportions) to 1 (set by the user).
    origin
        "shape" or "hand".
    deviation_mm
        Standard deviation of an outermost point in its direction, where contours give it.
    is_coarse
        Whether the triangles about an outermost point are too large to tell where it is.
    """

    point: FloatArray
    confidence: float
    origin: str = "shape"
    deviation_mm: float | None = None
    is_coarse: bool = False


Landmarks: TypeAlias = Mapping[str, Landmark]


def find_landmarks(foot: Foot) -> dict[str, Landmark]:
    """Find the landmarks of a foot by its shape; those of a missing part at their usual positions.

    Returns
    -------
    dict
        By the names in `NAMES`; the rear axes only where the back of the heel and the leg were
        measured. It is cached with the foot and must not be modified.
    """
    return foot.derived.get("landmarks", (), lambda: dict(_search(foot)))


def with_places(
    foot: Foot, landmarks: Landmarks, places: Mapping[str, tuple[float, float, float]]
) -> dict[str, Landmark]:
    """Replace landmarks by those that the user set.

    Parameters
    ----------
    foot
    landmarks
    places
        The user's points by name, mm, insole frame.

    Returns
    -------
    dict
        All landmarks by name.
    """
    by_hand = {name: Landmark(np.array(point), 1.0, "hand") for name, point in places.items()}
    return {**landmarks, **by_hand}


def _search(foot: Foot) -> Iterator[tuple[str, Landmark]]:
    sole = _along_foot_axis(foot)
    pternion = _pternion(sole)
    ends = {
        "pternion": pternion,
        "heel_medial": sole.support(_MEDIAL, _HEEL, _USUAL_HEEL, _MEDIAL_HEEL),
        "heel_lateral": sole.support(_LATERAL, _HEEL, _USUAL_HEEL, _LATERAL_HEEL),
        **_ball(sole, pternion),
    }
    if is_cut_behind(foot.even.points):
        ends |= {name: replace(ends[name], confidence=GUESS) for name in _OF_HEEL}
    tips = dict(zip(TOE_TIPS, _toe_tips(foot, sole), strict=True))
    longest = max(tips.values(), key=lambda tip: float(tip.point[1]))
    if min(ends["pternion"].confidence, longest.confidence) <= GUESS:
        ends |= {name: _at_most(ends[name], _UNPLACED) for name in _OF_BALL}
    for name, end in ends.items():
        yield name, _landmark(foot, sole, end)
    middle = (ends["heel_medial"].point + ends["heel_lateral"].point) / 2
    heel = sole.on_sole(
        np.array([middle[0], sole.back_mm + float(np.mean(_HEEL)) * foot.length_mm])
    )
    yield "heel_centre", Landmark(sole.to_insole(heel), _least(ends, "heel"))
    tibiale, fibulare = (ends[f"metatarsale_{name}"].point for name in ("tibiale", "fibulare"))
    heads = [sole.on_sole(xy) for xy in _head_places(tibiale, fibulare)]
    for name, head in zip(HEADS, heads, strict=True):
        yield name, Landmark(sole.to_insole(head), _LIKELY * _least(ends, "metatarsale"))
    for name, tip in tips.items():
        yield name, _landmark(foot, sole, tip)
    apex, rise = _arch_apex(sole, heel, heads[0])
    yield "arch_apex", Landmark(sole.to_insole(apex), SURE if rise > _ARCH_RISE_MM else GUESS)
    yield from _axes(foot)


def _toe_tips(foot: Foot, sole: SoleSurface) -> list[End]:
    """Find the tips; where another scanner's file lacks a side of the toes, one may be cut."""
    tips = sole.toe_tips()
    if foot.mesh.touches is None:
        for name, outwards in _OUTER_TOES.items():
            number = TOE_TIPS.index(name)
            tips[number] = _at_most(tips[number], sole.support(outwards, _TOES).confidence)
    return tips


def _at_most(end: End, confidence: float) -> End:
    return replace(end, confidence=min(end.confidence, confidence))


def _landmark(foot: Foot, sole: SoleSurface, end: End) -> Landmark:
    point = sole.to_insole(end.point)
    coarse = float(ramp(foot.even.facet_mm2(point), _FACET_MM2))
    confidence = min(end.confidence, SURE - (SURE - _COARSE) * coarse)
    is_coarse = coarse > 0 and confidence < end.confidence
    return Landmark(point, confidence, deviation_mm=end.deviation_mm, is_coarse=is_coarse)


def _along_foot_axis(foot: Foot) -> SoleSurface:
    """Return the sole, rotated so that pternion and tip of the 2nd toe lie along y."""
    sole = SoleSurface(LowFoot.of(foot))
    for _ in range(2):
        sole = sole.along(sole.second_toe_tip().point - _pternion(sole).point)
    return sole


def _pternion(sole: SoleSurface) -> End:
    return sole.rear(_REAR, _BEHIND)


def _ball(sole: SoleSurface, pternion: End) -> dict[str, End]:
    """Find the outermost points of the ball, along the line from the heel to the ball's middle.

    Not along the foot axis: when the toes point to a side, that would favour one of them.
    """
    tibiale, fibulare = _across_ball(sole)
    body = sole.along((tibiale.point + fibulare.point) / 2 - pternion.point)
    names = ("metatarsale_tibiale", "metatarsale_fibulare")
    return {
        name: replace(end, point=sole.from_insole(body.to_insole(end.point)))
        for name, end in zip(names, _across_ball(body), strict=True)
    }


def _across_ball(sole: SoleSurface) -> tuple[End, End]:
    return (
        sole.support(_MEDIAL, _TIBIALE, _USUAL_TIBIALE, _MEDIAL_BORDER),
        sole.support(_LATERAL, _FIBULARE, _USUAL_FIBULARE, _LATERAL_BORDER),
    )


def _least(ends: Mapping[str, End], part: str) -> float:
    """Return the confidence of the less certain of two ends."""
    return min(end.confidence for name, end in ends.items() if name.startswith(part))


def _head_places(tibiale: FloatArray, fibulare: FloatArray) -> FloatArray:
    """Return the points (5, 2) below the metatarsal heads, medial = +x."""
    ball = float(np.hypot(*(tibiale - fibulare)[:2]))
    first, fifth = tibiale[:2] + ball * _FIRST, fibulare[:2] + ball * _FIFTH
    across, ahead = _HEADS.T
    places = first + across[:, None] * (fifth - first)
    places[:, 1] += ahead * ball
    return np.asarray(places)


def _arch_apex(sole: SoleSurface, heel: FloatArray, head: FloatArray) -> tuple[FloatArray, float]:
    """Find the highest point of the sole between the heel and the 1st head, and its height."""
    share = np.linspace(*_ARCH, 61)
    way = heel[:2] + share[:, None] * (head - heel)[:2]
    heights = np.array([sole.on_sole(xy)[2] for xy in way])
    chord = heel[2] + share * (head[2] - heel[2])
    highest = int((heights - chord).argmax())
    return np.array([*way[highest], heights[highest]]), float((heights - chord)[highest])


def _axes(foot: Foot) -> Iterator[tuple[str, Landmark]]:
    axes: dict[str, Axis | None] = {
        "achilles": achilles_axis(foot),
        "calcaneus": calcaneus_axis(foot),
    }
    for name, axis in axes.items():
        if axis is not None:
            yield f"{name}_lower", Landmark(axis.lower, axis.confidence)
            yield f"{name}_upper", Landmark(axis.upper, axis.confidence)


def moved(landmark: Landmark, point: FloatArray) -> Landmark:
    """Return a landmark moved by the user to a point (3,), mm, insole frame."""
    return Landmark(point, 1.0, "hand")
