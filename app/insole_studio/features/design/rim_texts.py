"""Translated words for the stations of a rim."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.insole.finishing.rim_curve import PlacedStation
from insole_studio.texts import localised, tr

HEEL_SHARE = 0.05
"""A station nearer to the middle of the heel than this share of its border stands behind it."""
LEVELS: dict[str, Callable[[], str]] = {
    "heel": lambda: tr("over the heel"),
    "toes": lambda: tr("over the toe zone"),
    "foot": lambda: tr("over the foot's own surface"),
}


def station_text(placed: PlacedStation) -> str:
    """Return place and height of a station in one line."""
    height = localised(placed.station.height_mm)
    level = LEVELS[placed.station.over]()
    return f"{place_text(placed)}: {height} mm {level}"


def place_text(placed: PlacedStation) -> str:
    """Return where a station stands."""
    station = placed.station
    if station.along < HEEL_SHARE:
        return tr("Behind the heel")
    border = tr("Medial") if station.border == "medial" else tr("Lateral")
    return f"{border}, {localised(round(100 * station.along), 'g')} %"
