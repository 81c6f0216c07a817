"""What is known of the size of a scan whose unit is not, such as one by photogrammetry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError

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

_MM_PER_PARIS_POINT = 20 / 3
_ALLOWANCE_MM = 15.0  # of the last before the toes (ISO/TS 19407: EU 42 for 265 mm)
_LENGTH_MM = (60.0, 400.0)
_DISTANCE_MM = (5.0, 2000.0)


def known_length_mm(known: KnownFootLength | KnownShoeSize) -> float:
    """Return the length of the foot that is known, or that a shoe of the size is made for.

    Raises
    ------
    InputError
        When no foot is as long.
    """
    if isinstance(known, KnownFootLength):
        length_mm = known.length_mm
    else:
        length_mm = known.size_eu * _MM_PER_PARIS_POINT - _ALLOWANCE_MM
    if not _LENGTH_MM[0] <= length_mm <= _LENGTH_MM[1]:
        raise InputError(
            "A foot of {length_mm:.0f} mm is asked for, but feet are {least:.0f} to {most:.0f} mm "
            "long; correct the length or the shoe size.",
            length_mm=length_mm,
            least=_LENGTH_MM[0],
            most=_LENGTH_MM[1],
        )
    return length_mm


def provisional_mm_per_unit(known: KnownSize, extent: float) -> float:
    """Return the scale of a scan.

    By a known distance it is final. By a length of the foot it takes the longest extent of the scan
    for that; whoever has found the foot in it corrects the scale by its length.

    Parameters
    ----------
    extent
        Longest of the scan, in its own unit.

    Raises
    ------
    InputError
        When the points coincide, or no such thing is as long.
    """
    if not isinstance(known, KnownDistance):
        return known_length_mm(known) / extent
    between = float(np.linalg.norm(np.subtract(known.first, known.second)))
    if not between > 1e-6 * extent:
        raise InputError("The two points of the known distance coincide; set them apart.")
    if not _DISTANCE_MM[0] <= known.distance_mm <= _DISTANCE_MM[1]:
        raise InputError(
            "A distance of {distance_mm:g} mm between the two points is asked for; give one of "
            "{least:.0f} to {most:.0f} mm.",
            distance_mm=known.distance_mm,
            least=_DISTANCE_MM[0],
            most=_DISTANCE_MM[1],
        )
    return known.distance_mm / between
