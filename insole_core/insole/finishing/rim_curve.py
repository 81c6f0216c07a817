"""The rim of a finished insole: the height of its edge all the way round, and its edits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import Place, ranges_of
from insole_core.insole.finishing.edge import Edge
from insole_core.insole.finishing.fair_heights import fair_heights
from insole_core.insole.prescription.finish import RimStation

RIM_SIGMA_MM = 8.0
"""Standard deviation of the Gaussian along the edge that smooths the rim."""
_SAME_PLACE_MM, _SAME_HEIGHT_MM = 2.0, 0.05
_FOLLOWING_MM = 8.0  # pitch at which the rim between two stations over "foot" follows the foot
_TURNS = 3  # knots repeated beyond either end, so that the interpolation is periodic
_LEAST_GAP_MM = 4.0
"""Least distance of two stations along the edge: nearer ones would make a step."""
_HEIGHT_STEP_MM = 0.1
_ALONG_STEP = 0.001
Stations = tuple[RimStation, ...]


@dataclass(frozen=True, eq=False)
class PlacedStation:
    """A station on its place.

    Parameters
    ----------
    number
        Index into `Finish.rim`.
    arc_mm
        Arc length along the edge.
    place_mm
        Its point of the edge, insole frame.
    height_mm
        What it asks for, over the heel's floor; `RimCurve.height_mm` runs beside it where the rim
        would bend too sharply.
    """

    number: int
    station: RimStation
    arc_mm: float
    place_mm: Place
    height_mm: float


@dataclass(frozen=True, eq=False)
class RimCurve:
    """Heights of the rim over the heel's floor, one at each point of the edge.

    Parameters
    ----------
    height_mm : (n,) float64
        The designed rim, H(s).
    stations
        In the order of their arc lengths.
    """

    edge: Edge
    height_mm: FloatArray
    stations: tuple[PlacedStation, ...]

    def height_at(self, arc_mm: float) -> float:
        """Interpolate the designed rim, in mm over the heel's floor."""
        return float(self.edge.at(self.height_mm, arc_mm))


@dataclass(frozen=True, eq=False)
class Rim:
    """What the rim of a design refers to; it stays while stations are moved.

    All heights are in mm over the heel's floor, the lowest place of the heel.

    Parameters
    ----------
    contact_mm : (n,) float64
        The contact surface at the points of the edge: the zero of stations over "foot", and the
        rim of a finish without stations.
    flank_mm : (n,) float64
        How far up the foot itself reaches beside the edge: a higher rim stands free.
    toes_mm
        Level of the toe zone: the zero of stations over "toes".
    """

    edge: Edge
    contact_mm: FloatArray
    flank_mm: FloatArray
    toes_mm: float

    def curve(self, stations: tuple[RimStation, ...]) -> RimCurve:
        """Compute the designed rim through stations, in any order.

        A periodic interpolation without overshoot (PCHIP), smoothed by a Gaussian of 8 mm, and
        bent by at most 0.36 mm in steps of 5 mm: see `fair_heights`.

        Raises
        ------
        DesignError
            If two stations at one place ask for different heights.
        """
        placed = sorted(
            (self._placed(number, station) for number, station in enumerate(stations)),
            key=lambda p: p.arc_mm,
        )
        if not placed:
            return RimCurve(self.edge, fair_heights(self.contact_mm, self.edge.step_mm), ())
        knots = list(_without_twins(placed, self.edge.length_mm))
        even = scipy.ndimage.gaussian_filter1d(
            self._interpolated(knots), RIM_SIGMA_MM / self.edge.step_mm, mode="wrap"
        )
        return RimCurve(self.edge, fair_heights(even, self.edge.step_mm), tuple(placed))

    def zero_mm(self, arc_mm: float, over: str) -> float:
        """Return the height from which a station over "heel", "toes" or "foot" is counted."""
        if over == "foot":
            return float(self.edge.at(self.contact_mm, arc_mm))
        return self.toes_mm if over == "toes" else 0.0

    def station_at(self, arc_mm: float, height_mm: float, over: str = "heel") -> RimStation:
        """Return the station at a place of the edge.

        Parameters
        ----------
        height_mm
            Over the heel's floor, whatever `over` says; limited to the range of stations.
        """
        arc_mm %= self.edge.length_mm
        allowed = ranges_of(RimStation)["height_mm"]
        height = float(allowed.nearest(height_mm - self.zero_mm(arc_mm, over)))
        along = float(self.edge.along_of(np.asarray(arc_mm)))
        return RimStation(
            border=self.edge.border_of(arc_mm), along=along, height_mm=height, over=over
        )

    def _placed(self, number: int, station: RimStation) -> PlacedStation:
        arc_mm = self.edge.arc_of(station.border, station.along)
        height_mm = self.zero_mm(arc_mm, station.over) + station.height_mm
        return PlacedStation(number, station, arc_mm, self.edge.point_at(arc_mm), height_mm)

    def _interpolated(self, knots: list[PlacedStation]) -> FloatArray:
        """Interpolate stations at the points of the edge, without overshoot."""
        length_mm = self.edge.length_mm
        pairs = zip(knots, [*knots[1:], knots[0]], strict=True)
        parts = [self._way(start, end) for start, end in pairs]
        arc_mm, height_mm = np.concatenate(parts).T
        order = np.argsort(arc_mm)
        turns = np.arange(-_TURNS, _TURNS + 1) * length_mm
        arcs = (arc_mm[order] + turns[:, None]).ravel()
        return np.asarray(
            scipy.interpolate.PchipInterpolator(arcs, np.tile(height_mm[order], len(turns)))(
                self.edge.arc_mm
            )
        )

    def _way(self, start: PlacedStation, end: PlacedStation) -> FloatArray:
        """Return knots (k, 2) of arc length and height from one station to before the next."""
        length_mm = self.edge.length_mm
        way_mm = (end.arc_mm - start.arc_mm) % length_mm or length_mm
        follows = start.station.over == end.station.over == "foot"
        count = max(1, round(way_mm / _FOLLOWING_MM)) if follows else 1
        share = np.arange(count) / count
        arc_mm = (start.arc_mm + share * way_mm) % length_mm
        if not follows:
            return np.array([[start.arc_mm, start.height_mm]])
        over = start.station.height_mm + share * (end.station.height_mm - start.station.height_mm)
        return np.column_stack([arc_mm, over + self.edge.at(self.contact_mm, arc_mm)])


def _without_twins(placed: list[PlacedStation], length_mm: float) -> Iterator[PlacedStation]:
    """Yield the stations, of two equal ones at one place the first.

    Raises
    ------
    DesignError
        If two at one place differ.
    """
    for before, station in zip([placed[-1], *placed[:-1]], placed, strict=True):
        apart_mm = (station.arc_mm - before.arc_mm) % length_mm
        if station is before or apart_mm >= _SAME_PLACE_MM:
            yield station
        elif abs(station.height_mm - before.height_mm) > _SAME_HEIGHT_MM:
            raise DesignError(
                "Two stations of the rim lie at the same place {where}, one {height_mm:.1f} mm "
                "high and one {other_mm:.1f} mm; remove one of them.",
                where="medially" if station.station.border == "medial" else "laterally",
                height_mm=before.height_mm,
                other_mm=station.height_mm,
            )


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
    if abs(way_mm) < _ALONG_STEP:
        return replaced_station(stations, number, _at_height(rim, station, before_mm, height_mm))
    arc_mm = (before_mm + way_mm) % rim.edge.length_mm
    placed = rim.station_at(arc_mm, height_mm, station.over)
    placed = replace(placed, along=rounded(placed.along, _ALONG_STEP))
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
    if min(map(abs, away), default=np.inf) < _LEAST_GAP_MM:
        return None
    height_mm = rim.curve(stations).height_at(arc_mm)
    placed = rim.station_at(arc_mm, height_mm, _usual_zero(rim, arc_mm))
    placed = replace(placed, along=rounded(placed.along, _ALONG_STEP))
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
    most = max(ahead - _LEAST_GAP_MM, 0.0)
    least = min(behind + _LEAST_GAP_MM, 0.0)
    return float(np.clip(way_mm, least, most))


def _signed(rim: Rim, way_mm: float) -> float:
    """Return a way along the closed edge as the shorter one, > 0 ahead."""
    half = rim.edge.length_mm / 2
    return (way_mm + half) % rim.edge.length_mm - half


def _at_height(rim: Rim, station: RimStation, arc_mm: float, height_mm: float) -> RimStation:
    over_zero = height_mm - rim.zero_mm(arc_mm, station.over)
    return replace(station, height_mm=_within_range(over_zero, _HEIGHT_STEP_MM))


def _within_range(height_mm: float, step_mm: float) -> float:
    return float(ranges_of(RimStation)["height_mm"].nearest(rounded(height_mm, step_mm)))
