"""How the dialogs of the clinic write times."""

from __future__ import annotations

from datetime import datetime


def moment_text(moment: datetime | str) -> str:
    """Return a time as the clock of this computer shows it.

    Parameters
    ----------
    moment
        With its time zone, or ISO 8601 as the record writes it.
    """
    if isinstance(moment, str):
        try:
            moment = datetime.fromisoformat(moment)
        except ValueError:
            return str(moment)
    return moment.astimezone().strftime("%Y-%m-%d %H:%M")
