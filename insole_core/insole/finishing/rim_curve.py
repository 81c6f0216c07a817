"""The rim of a finished insole: the height of its edge all the way round.

For a window: `Rim` is what stays while stations are moved, `Rim.curve(stations)` is computed anew
at each step of a drag, and `Rim.station_at` is the station under a pointer.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.fields import Place, ranges_of
from insole_core.insole.finishing.edge import Edge
from insole_core.insole.finishing.fair_heights import fair_heights
from insole_core.insole.prescription.finish import RimStation

RIM_SIGMA_MM = 8.0
"""Standard deviation of the Gaussian along the edge that smooths the rim."""
_SAME_PLACE_MM, _SAME_HEIGHT_MM = 2.0, 0.05
_FOLLOWING_MM = 8.0  # pitch at which the rim between two stations over "foot" follows the foot
_TURNS = 3  # knots repeated beyond either end, so that the interpolation is periodic


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
