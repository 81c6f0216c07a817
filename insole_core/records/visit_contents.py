"""What a visit holds: one with anything in it is not deleted."""

from __future__ import annotations

from typing import Final

from sqlalchemy import Connection, func, select

from insole_core.errors import RecordsError
from insole_core.records.record_field import typed_fields
from insole_core.records.schema import (
    captures,
    follow_ups,
    orders,
    prescription_versions,
    visit_photos,
)
from insole_core.records.visit import Visit

_HELD: Final = {
    "scans": captures,
    "photos": visit_photos,
    "versions": prescription_versions,
    "orders": orders,
    "follow_ups": follow_ups,
}


def held_by(connection: Connection, visit_id: str) -> dict[str, int]:
    """Return how many things of each kind were scanned, prescribed or ordered on a visit."""
    counts = {}
    for name, table in _HELD.items():
        query = select(func.count()).select_from(table).where(table.c.visit_id == visit_id)
        counts[name] = int(connection.execute(query).scalar_one())
    return counts


def check_empty(connection: Connection, visit: Visit) -> None:
    """Check that a visit holds nothing that somebody has found, scanned, prescribed or ordered.

    Raises
    ------
    RecordsError
        Says what it holds.
    """
    day = visit.visited_on.isoformat()
    counts = held_by(connection, visit.id)
    if any(counts.values()):
        raise RecordsError(
            "The visit of {day} holds scans ({scans}), photos ({photos}), versions of "
            "prescriptions ({versions}), orders ({orders}) or follow-ups ({follow_ups}), and is "
            "kept; only an empty visit can be deleted.",
            day=day,
            **counts,
        )
    fields = typed_fields(Visit).items()
    if visit.measures or any(getattr(visit, name) for name, field in fields if not field.is_needed):
        raise RecordsError(
            "The visit of {day} has a reason, findings, weight, shoe size or measures, and is "
            "kept; clear them under “Edit…” first if it was made by mistake.",
            day=day,
        )
