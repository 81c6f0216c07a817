"""What is known of the size of a scan whose unit is not, such as one by photogrammetry."""

from __future__ import annotations

from dataclasses import dataclass

Point = tuple[float, float, float]


@dataclass(frozen=True)
class KnownFootLength:
    """The length of the foot, from the heel to the tip of the longest toe, mm."""

    length_mm: float


@dataclass(frozen=True)
class KnownShoeSize:
    """The shoe size of the foot, EU (Paris points)."""

    size_eu: float


@dataclass(frozen=True)
class KnownDistance:
    """The distance of two points of the scan, such as the ends of a ruler or a coin's rim.

    Parameters
    ----------
    first, second
        As the file has them, in whatever unit.
    distance_mm
    """

    first: Point
    second: Point
    distance_mm: float


KnownSize = KnownFootLength | KnownShoeSize | KnownDistance
