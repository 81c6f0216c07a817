"""What the pages of the record show, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.side import Side


@dataclass(frozen=True)
class FootLine:
    """What a visit holds of one foot.

    Parameters
    ----------
    text
        Device and corrections of the newest version.
    version
        Its number and author.
    is_signed
        Whether that version is signed.
    """

    side: Side
    text: str
    version: str = ""
    is_signed: bool = False


@dataclass(frozen=True)
class VisitRow:
    """One visit of the time line.

    Parameters
    ----------
    day
        With the time at which it was begun, where that is known: there may be two on one day.
    notes
        A line each: a capture that is waited for, who has it open; what was found; orders.
    photos
        Number of them.
    scan, scan_details
        When it was scanned, and when the sensors were calibrated; and what each step left.
    """

    id: str
    day: str
    reason: str
    feet: tuple[FootLine, ...] = ()
    notes: tuple[str, ...] = ()
    photos: int = 0
    scan: tuple[str, ...] = ()
    scan_details: tuple[str, ...] = ()


@dataclass(frozen=True)
class PictureKey:
    """Which small picture: of a visit, a side, and the foot or its insole."""

    visit: str
    side: Side
    kind: str


@dataclass(frozen=True)
class Trend:
    """A measure over time: its name with the unit, and a value for each of its days, ISO 8601."""

    name: str
    days: tuple[str, ...]
    values: tuple[float, ...]
    side: Side | None = None
