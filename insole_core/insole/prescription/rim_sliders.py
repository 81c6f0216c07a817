"""Heel cup and medial flange as one number each: read from the stations of a rim, and set in them.

Only stations over the heel's floor count; those over the toe zone or the foot stay.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import reduce

from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import HEADS_ALONG, Finish, RimStation

_CUP_ALONG, _CUP_FADE = 0.2, 0.4
"""Up to which share of a border the cup is moved as a whole, and where it ends."""
_FLANGE = (0.2, 0.45, HEADS_ALONG)
"""Begin, usual place of the peak, and end of the medial flange, as shares of the border."""
_AS_THE_FOOT = (0.45, HEADS_ALONG, 1.0)
"""Where a rim without stations is kept as the foot when the cup is set."""


def cup_depth_mm(finish: Finish) -> float | None:
    """Return the depth of the heel cup behind the heel; None if no station says it."""
    cup = [s for s in finish.rim if s.over == "heel" and s.along <= _CUP_ALONG]
    return min(cup, key=lambda station: station.along).height_mm if cup else None


def with_cup_depth(finish: Finish, depth_mm: float) -> Finish:
    """Set the depth of the heel cup behind the heel.

    The stations beside the heel move by as much, those before it by less; the medial flange stays.
    A rim without a cup gets one.
    """
    old_mm = cup_depth_mm(finish)
    if old_mm is None:
        return replace(finish, rim=(*_round_heel(depth_mm), *(finish.rim or _as_the_foot())))
    return _moved(finish, depth_mm - old_mm, _cup_weight)


def finish_of(design: InsoleDesign) -> Finish | None:
    """Return the finish of a design, its heel cup as deep as the last active heel cup says.

    So a heel cup means the same with a designed rim as without: the depth that the cup gets.
    """
    if design.finish is None:
        return None
    return reduce(with_cup_depth, _cups_mm(design), design.finish)


def designed_cup_mm(design: InsoleDesign) -> float | None:
    """Return the depth of a design's heel cup; None if only the foot says it.

    Without a designed rim each heel cup lowers what the others leave, so that the least holds.
    """
    finish = finish_of(design)
    return min(_cups_mm(design), default=None) if finish is None else cup_depth_mm(finish)


def _cups_mm(design: InsoleDesign) -> tuple[float, ...]:
    depths = (correction.rim_depth_mm for correction in design.active)
    return tuple(depth_mm for depth_mm in depths if depth_mm is not None)


def medial_flange_mm(finish: Finish) -> float | None:
    """Return the height of the medial flange at its peak; None if no station says it."""
    peak = _peak(finish)
    return None if peak is None else peak.height_mm


def with_medial_flange(finish: Finish, height_mm: float) -> Finish:
    """Set the height of the medial flange at its peak; it falls off to the cup and to the head.

    A rim without a medial flange gets one at its usual place. The peak of a lowered one stays its
    peak: no station of the flange is left higher.
    """
    peak = _peak(finish)
    if peak is None:
        station = RimStation(border="medial", along=_FLANGE[1], height_mm=height_mm)
        others = (s for s in finish.rim if (s.border, s.along) != ("medial", _FLANGE[1]))
        return replace(finish, rim=(*others, station))
    moved = _moved(finish, height_mm - peak.height_mm, lambda s: _flange_weight(s, peak.along))
    rim = (
        replace(s, height_mm=min(s.height_mm, height_mm)) if _is_of_flange(s) else s
        for s in moved.rim
    )
    return replace(moved, rim=tuple(rim))


def _peak(finish: Finish) -> RimStation | None:
    flange = filter(_is_of_flange, finish.rim)
    return max(flange, key=lambda station: station.height_mm, default=None)


def _is_of_flange(station: RimStation) -> bool:
    begin, _, end = _FLANGE
    is_medial = station.border == "medial" and begin < station.along < end
    return is_medial and station.over == "heel"


def _moved(finish: Finish, by_mm: float, weight: Callable[[RimStation], float]) -> Finish:
    return replace(
        finish,
        rim=tuple(
            replace(s, height_mm=s.height_mm + weight(s) * by_mm) if s.over == "heel" else s
            for s in finish.rim
        ),
    )


def _cup_weight(station: RimStation) -> float:
    return min(max((_CUP_FADE - station.along) / (_CUP_FADE - _CUP_ALONG), 0.0), 1.0)


def _flange_weight(station: RimStation, peak: float) -> float:
    begin, _, end = _FLANGE
    if station.border != "medial" or not begin < station.along < end:
        return 0.0
    towards = begin if station.along < peak else end
    return 1.0 if station.along == peak else (station.along - towards) / (peak - towards)


def _round_heel(depth_mm: float) -> tuple[RimStation, ...]:
    return tuple(
        RimStation(border=border, along=along, height_mm=depth_mm)
        for border, along in (("medial", 0.0), ("medial", _CUP_ALONG), ("lateral", _CUP_ALONG))
    )


def _as_the_foot() -> tuple[RimStation, ...]:
    return tuple(
        RimStation(border=border, along=along, height_mm=0.0, over="foot")
        for border in ("medial", "lateral")
        for along in _AS_THE_FOOT
    )
