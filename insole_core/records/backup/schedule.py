"""When the next backup is due."""

from __future__ import annotations

from datetime import datetime, timedelta


def is_due(newest: datetime | None, every: timedelta, now: datetime) -> bool:
    """Return whether it is time for another backup.

    Parameters
    ----------
    newest
        When the last one was made. One from the future was made by a clock that was wrong.
    """
    return newest is None or now - newest >= every or newest - now > timedelta(hours=1)
