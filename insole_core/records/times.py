"""The written form of times in the record."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Final

TIME_FORMAT: Final = "%Y-%m-%dT%H:%M:%S.%fZ"


def utc_now() -> str:
    """Return the present time as the record writes it: ``2026-11-20T10:00:00.000000Z``."""
    return datetime.now(UTC).strftime(TIME_FORMAT)
