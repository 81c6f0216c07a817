"""When the next backup is due."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta

_DAYS_OF_WEEK = 7


@dataclass(frozen=True)
class BackupSchedule:
    """An hour of every day, or of one day of the week, by the clock of the computer.

    Parameters
    ----------
    weekday
        0 for Monday to 6 for Sunday; None for every day.
    hour
        0 to 23.
    """

    weekday: int | None
    hour: int

    def latest(self, now: datetime) -> datetime:
        """Return the last scheduled moment that has come.

        Parameters
        ----------
        now
            In the time zone of the schedule.
        """
        moment = now.replace(hour=self.hour, minute=0, second=0, microsecond=0)
        if moment > now:
            moment -= timedelta(days=1)
        if self.weekday is not None:
            moment -= timedelta(days=(moment.weekday() - self.weekday) % _DAYS_OF_WEEK)
        return moment

    def is_due(self, newest: datetime | None, now: datetime) -> bool:
        """Return whether a backup has to be made, also one that was missed.

        Parameters
        ----------
        newest
            When the last one was made. One from the future was made by a clock that was wrong.
        """
        if newest is None or newest - now > timedelta(hours=1):
            return True
        return newest < self.latest(now)
