"""Backups that are made by themselves, at one of the stations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Final

from insole_core.errors import InputError, OutputError
from insole_core.progress import SILENT, Progress
from insole_core.records.backup.back_up import BackupReport, back_up
from insole_core.records.backup.backup_folder import BackupFolder
from insole_core.records.clinic import setting_of, write_setting
from insole_core.records.context import RecordsContext
from insole_core.records.rights import Right, require

SCHEDULE_VALUE: Final = "backup_schedule"
"""Key of the clinic's settings."""
LEAST_HOURS, MOST_HOURS = 1, 24 * 31


@dataclass(frozen=True)
class BackupSchedule:
    """Which station makes backups, where to, and how often.

    Parameters
    ----------
    folder
        With a backup in it already: the mount point of a disk that is not connected has none.
    station
        Name of the computer; a folder is a path of its.
    """

    folder: Path
    every_hours: int
    station: str

    def checked(self) -> BackupSchedule:
        """Return the schedule as it is stored.

        Raises
        ------
        InputError
        """
        if not LEAST_HOURS <= self.every_hours <= MOST_HOURS:
            raise InputError(
                "Backups are made every {least} to {most} hours; choose such a number.",
                least=LEAST_HOURS,
                most=MOST_HOURS,
            )
        return self


def schedule_of(context: RecordsContext) -> BackupSchedule | None:
    """Return the clinic's schedule; None where backups are made by hand."""
    with context.database.reading() as connection:
        values = setting_of(connection, SCHEDULE_VALUE)
    if values is None:
        return None
    return BackupSchedule(Path(values["folder"]), values["every_hours"], values["station"])


def set_schedule(context: RecordsContext, schedule: BackupSchedule | None) -> None:
    """Let backups be made by themselves, or by hand only.

    Raises
    ------
    InputError
        When the schedule cannot be kept.
    NotAllowed
    """
    values = None
    if schedule is not None:
        schedule = schedule.checked()
        values = {**vars(schedule), "folder": str(schedule.folder)}
    with context.database.writing() as connection:
        require(connection, context.author, Right.SET_UP)
        write_setting(connection, SCHEDULE_VALUE, values)
        hours = 0 if schedule is None else schedule.every_hours
        context.log(connection, "changed", "clinic", SCHEDULE_VALUE, every_hours=hours)


def back_up_if_due(
    context: RecordsContext,
    settings: Mapping[str, Path] | None = None,
    progress: Progress = SILENT,
    now: datetime | None = None,
) -> BackupReport | None:
    """Make the backup that is due at this station; return None if none is.

    Raises
    ------
    OutputError
        When it is due, and its disk is not connected or full.
    RecordsError, Cancelled
        As for `back_up`.
    """
    schedule = schedule_of(context)
    if schedule is None or schedule.station != context.author.station:
        return None
    try:
        BackupFolder(schedule.folder).head()
        snapshots = BackupFolder(schedule.folder).snapshots()
    except InputError as error:
        raise OutputError(
            "No backup can be made, since {folder} holds none yet; connect its disk, or make the "
            "first backup there by hand.",
            folder=schedule.folder,
        ) from error
    newest = snapshots[-1].made_at if snapshots else None
    if not is_due(newest, timedelta(hours=schedule.every_hours), now or datetime.now(UTC)):
        return None
    return back_up(context, schedule.folder, settings, progress)


def is_due(newest: datetime | None, every: timedelta, now: datetime) -> bool:
    """Return whether it is time for another backup.

    Parameters
    ----------
    newest
        When the last one was made. One from the future was made by a clock that was wrong.
    """
    return newest is None or now - newest >= every or newest - now > timedelta(hours=1)
