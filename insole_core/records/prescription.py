"""Versions of a prescription, as values."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date

from insole_core.geometry.side import Side


@dataclass(frozen=True)
class Base:
    """The version that somebody's work is based on.

    Parameters
    ----------
    is_mine
        Whether this version was begun by the present editing, so that it is continued; otherwise
        the next saving begins a new one.
    """

    version_id: str
    revision: int
    is_mine: bool = False


@dataclass(frozen=True)
class VersionSummary:
    """One version in the history of a foot's prescription.

    Parameters
    ----------
    number
        1 for the first version of this foot on this visit.
    is_closed
        Whether it can no longer change: signed, ordered, kept, or followed by another one.
    signed_by
        None while it is not signed.
    """

    id: str
    visit_id: str
    side: Side
    number: int
    author: str
    station: str
    reason: str
    program_version: str
    created_at: str
    changed_at: str
    revision: int
    is_closed: bool
    signed_by: str | None = None
    signed_at: str | None = None
    signature: str | None = None
    capture_id: str | None = None


@dataclass(frozen=True)
class ScannedFoot:
    """A version of a prescription that holds the last scan of a foot.

    Parameters
    ----------
    scanned_on
        Day of the visit that it was scanned on.
    """

    side: Side
    version_id: str
    scanned_on: date
