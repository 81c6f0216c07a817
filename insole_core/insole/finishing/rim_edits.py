"""Edits of a rim by its stations: move, raise, add; each returns the stations of the new rim."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import ranges_of
from insole_core.insole.finishing.rim_curve import Rim
from insole_core.insole.prescription.finish import RimStation

LEAST_GAP_MM = 4.0
"""Least distance of two stations along the edge: nearer ones would make a step."""
HEIGHT_STEP_MM = 0.1
ALONG_STEP = 0.001

Stations = tuple[RimStation, ...]


def moved_station(
    rim: Rim, stations: Stations, number: int, arc_mm: float, height_mm: float
) -> Stations:
    """Return the stations with one of them moved; it stays between its neighbours.

    Parameters
    ----------
    number
        Index of the station.
    arc_mm
        Wanted arc length along the edge; where it stood already, its share stays to the bit.
    height_mm
        Wanted height over the heel's floor, limited to what stations may have.
    """
    station = stations[number]
    before_mm = rim.edge.arc_of(station.border, station.along)
    others = [s for i, s in enumerate(stations) if i != number]
    way_mm = _limited_way(rim, others, before_mm, _signed(rim, arc_mm - before_mm))
    if abs(way_mm) < ALONG_STEP:
        return replaced_station(stations, number, _at_height(rim, station, before_mm, height_mm))
    arc_mm = (before_mm + way_mm) % rim.edge.length_mm
    placed = rim.station_at(arc_mm, height_mm, station.over)
    placed = replace(placed, along=rounded(placed.along, ALONG_STEP))
    return replaced_station(stations, number, _at_height(rim, placed, arc_mm, height_mm))


def raised_station(stations: Stations, number: int, by_mm: float) -> Stations:
    """Return the stations with one of them raised, or lowered by a height below 0."""
    station = stations[number]
    raised = replace(station, height_mm=_within_range(station.height_mm + by_mm, 0.01))
    return replaced_station(stations, number, raised)


def added_station(rim: Rim, stations: Stations, arc_mm: float) -> Stations | None:
    """Return the stations and a further one on the rim as it runs; None if one is too near.

    Raises
    ------
    DesignError
        As `Rim.curve`.
    """
    away = [_signed(rim, rim.edge.arc_of(s.border, s.along) - arc_mm) for s in stations]
    if min(map(abs, away), default=np.inf) < LEAST_GAP_MM:
        return None
    height_mm = rim.curve(stations).height_at(arc_mm)
    placed = rim.station_at(arc_mm, height_mm, _usual_zero(rim, arc_mm))
    placed = replace(placed, along=rounded(placed.along, ALONG_STEP))
    return (*stations, _at_height(rim, placed, arc_mm, height_mm))


def counted_from(rim: Rim, station: RimStation, over: str) -> RimStation:
    """Return the same height counted from another level: "heel", "toes" or "foot"."""
    arc_mm = rim.edge.arc_of(station.border, station.along)
    height_mm = station.height_mm + rim.zero_mm(arc_mm, station.over)
    return _at_height(rim, replace(station, over=over), arc_mm, height_mm)


def replaced_station(stations: Stations, number: int, station: RimStation) -> Stations:
    """Return the stations with another one in the place of one of them."""
    return (*stations[:number], station, *stations[number + 1 :])


def _usual_zero(rim: Rim, arc_mm: float) -> str:
    """Return the level from which a height is usually counted at a place: ahead of the heads, toes.

    Nearer to the heel a station over the toe zone would follow what lies far away.
    """
    is_ahead = arc_mm < rim.edge.medial_head_mm or arc_mm > rim.edge.lateral_head_mm
    return "toes" if is_ahead else "heel"


def _limited_way(rim: Rim, others: list[RimStation], arc_mm: float, way_mm: float) -> float:
    """Return how far a station can go towards another place before it meets a neighbour."""
    away = [_signed(rim, rim.edge.arc_of(s.border, s.along) - arc_mm) for s in others]
    ahead = min((gap for gap in away if gap >= 0), default=np.inf)
    behind = max((gap for gap in away if gap < 0), default=-np.inf)
    most = max(ahead - LEAST_GAP_MM, 0.0)
    least = min(behind + LEAST_GAP_MM, 0.0)
    return float(np.clip(way_mm, least, most))


def _signed(rim: Rim, way_mm: float) -> float:
    """Return a way along the closed edge as the shorter one, > 0 ahead."""
    half = rim.edge.length_mm / 2
    return (way_mm + half) % rim.edge.length_mm - half


def _at_height(rim: Rim, station: RimStation, arc_mm: float, height_mm: float) -> RimStation:
    over_zero = height_mm - rim.zero_mm(arc_mm, station.over)
    return replace(station, height_mm=_within_range(over_zero, HEIGHT_STEP_MM))


def _within_range(height_mm: float, step_mm: float) -> float:
    return float(ranges_of(RimStation)["height_mm"].nearest(rounded(height_mm, step_mm)))
