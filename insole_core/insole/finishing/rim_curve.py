"""The rim of a finished insole: the height of its edge all the way round.

For a window: `Rim` is what stays while stations are moved, `Rim.curve(stations)` is computed anew
at each step of a drag, and `Rim.station_at` is the station under a pointer.
"""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.finishing.edge import Edge
from insole_core.insole.prescription.design import Place, RimStation


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

        Raises
        ------
        DesignError
            If two stations at one place ask for different heights.
        """
        raise NotImplementedError

    def zero_mm(self, arc_mm: float, over: str) -> float:
        """Return the height from which a station over "heel", "toes" or "foot" is counted."""
        raise NotImplementedError

    def station_at(self, arc_mm: float, height_mm: float, over: str = "heel") -> RimStation:
        """Return the station at a place of the edge.

        Parameters
        ----------
        height_mm
            Over the heel's floor, whatever `over` says; limited to the range of stations.
        """
        raise NotImplementedError
