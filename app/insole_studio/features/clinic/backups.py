"""Backups of the record: now, and on a schedule, with a notice when one has not been made."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InputError, InsoleError
from insole_core.messages import Message
from insole_core.progress import Progress
from insole_studio.jobs import Jobs
from insole_studio.services.app_services import AppServices
from insole_studio.settings import BackupDay
from insole_studio.texts import fill, tr, translate_core_message

if TYPE_CHECKING:
    from insole_core.records.backup.back_up import BackupReport
    from insole_core.records.backup.schedule import BackupSchedule
    from insole_core.records.records import Records

BACKUP, LOOK = "backup", "backup-look"
NOTICE = "backup-missing"
LOOK_EVERY_MS = 60_000
RETRY_AFTER = timedelta(minutes=30)
MEGABYTE = 1e6


@dataclass(frozen=True)
class BackupState:
    """What is known of the backups.

    Parameters
    ----------
    opened_by
        What opens them: "passphrase" or "private key"; empty until they are set up.
    newest
        When the last one in the folder was made; None when there is none, or it cannot be read.
    """

    opened_by: str
    newest: datetime | None


class Backups(QObject):
    """Makes backups in jobs of its own: a long one keeps nothing else waiting."""

    finished = Signal(object)
    """Emitted with the `BackupReport`."""
    failed = Signal(object)
    settings_requested = Signal()

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._settings = services.settings
        self.jobs = Jobs(self)
        self._retry_at: datetime | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)
        services.clinic.state_changed.connect(self.look)

    @property
    def is_running(self) -> bool:
        """Whether a backup is being made."""
        return self.jobs.is_running(BACKUP)

    @property
    def folder(self) -> Path | None:
        """Where backups go; None until a folder is chosen."""
        return Path(self._settings.backup_folder) if self._settings.backup_folder else None

    @property
    def schedule(self) -> BackupSchedule | None:
        """When they are made by themselves; None for never."""
        from insole_core.records.backup.schedule import BackupSchedule

        day = self._settings.backup_day
        if day == "never":
            return None
        return BackupSchedule(None if day == "daily" else int(day), self._settings.backup_hour)

    def set_plan(
        self, folder: Path | None, day: BackupDay, hour: int, *, is_ready: bool = True
    ) -> None:
        """Keep where and when backups are made, and make one that is due.

        Parameters
        ----------
        is_ready
            Whether the record knows yet how to encrypt them.
        """
        self._settings.backup_folder = "" if folder is None else str(folder)
        self._settings.backup_day, self._settings.backup_hour = day, hour
        self._services.save_settings()
        self._retry_at = None
        if is_ready:
            self.look()

    def look(self) -> None:
        """Make a backup if one is due, also one that was missed while the program did not run."""
        planned = self.folder is not None and self._settings.backup_day != "never"
        if not planned:
            self._timer.stop()
            self._services.notices.drop(NOTICE)
            return
        if not self._timer.isActive():
            self._timer.start()
        now = datetime.now().astimezone()
        is_waiting = self._retry_at is not None and now < self._retry_at
        folder, clinic = self.folder, self._services.clinic
        if clinic.is_open and not clinic.is_read_only and not self.is_running and not is_waiting:
            assert folder is not None
            self.jobs.start(
                LOOK, lambda _progress: newest_in(folder), self._go_on, self._note_failure
            )

    def begin(self, *, is_first: bool = False) -> None:
        """Make a backup in the background.

        Parameters
        ----------
        is_first
            Whether the folder may be without backups; else a disk that is not connected is told,
            and nothing written into the empty folder that stands in its place.
        """
        folder = self.folder
        if folder is None or self.is_running:
            return
        records = self._services.clinic.ask_now(lambda found: found)
        saved = self._services.paths.backed_up_folders

        def run(progress: Progress) -> BackupReport:
            from insole_core.records.backup.back_up import back_up

            if not is_first:
                _check_there(folder)
            return back_up(records.context, folder, saved, progress)

        self.jobs.start(BACKUP, run, self._finish, self._note_failure)

    def cancel(self) -> None:
        """Stop the running backup; the ones before stay as they are."""
        self.jobs.cancel(BACKUP)

    def close(self) -> None:
        """Stop all jobs, and look no more."""
        self._timer.stop()
        self.jobs.close()

    def _go_on(self, newest: datetime | None) -> None:
        schedule = self.schedule
        if schedule is None:
            return
        if schedule.is_due(newest, datetime.now().astimezone()):
            self.begin()
        else:
            self._services.notices.drop(NOTICE)

    def _finish(self, report: BackupReport) -> None:
        self._retry_at = None
        self._services.notices.drop(NOTICE)
        self._services.messages.say(report_text(report))
        if report.damaged:
            self._warn(damaged_text(report))
        self.finished.emit(report)

    def _note_failure(self, error: Exception) -> None:
        self._retry_at = datetime.now().astimezone() + RETRY_AFTER
        if not isinstance(error, InsoleError):
            raise error
        reason = translate_core_message(error.message)
        self._warn(tr("No backup was made: {reason}").format(reason=reason))
        self.failed.emit(error)

    def _warn(self, sentence: str) -> None:
        self._services.notices.put(
            NOTICE, sentence, (tr("Backup…"), self.settings_requested.emit), stays=True
        )


def newest_in(folder: Path) -> datetime | None:
    """Return when the newest backup in a folder was made; None for a folder without any.

    Raises
    ------
    InputError
        When the folder is not there, as on a disk that is not connected.
    """
    from insole_core.records.backup.backup_folder import BackupFolder

    if not folder.is_dir():
        raise _not_there(folder)
    snapshots = BackupFolder(folder).snapshots()
    return snapshots[-1].made_at if snapshots else None


def read_state(records: Records, folder: Path | None) -> BackupState:
    """Return what is known of the backups of a record."""
    from insole_core.records.backup.back_up import key_of_backups

    key = key_of_backups(records.context)
    newest = None if folder is None or not folder.is_dir() else newest_in(folder)
    return BackupState("" if key is None else key.opened_by, newest)


def report_text(report: BackupReport) -> str:
    """Say what a backup has written; all of it was read again."""
    return fill(
        tr(
            "Backup {number} is made: {rows} entries and {files} files, {new_mb:.1f} MB of them "
            "new. All that was written has been read again and is right."
        ),
        number=report.snapshot.number,
        rows=report.rows,
        files=report.contents,
        new_mb=report.written_bytes / MEGABYTE,
    )


def damaged_text(report: BackupReport) -> str:
    """Say that the record itself has lost files."""
    sentence = tr(
        "{count} files are missing or damaged in the record and are not in the backup; verify the "
        "record, and restore them from an earlier backup."
    )
    return sentence.format(count=len(report.damaged))


def _check_there(folder: Path) -> None:
    from insole_core.records.backup.backup_folder import HEAD_FILE

    if not (folder / HEAD_FILE).is_file():
        raise _not_there(folder)


def _not_there(folder: Path) -> InputError:
    return InputError(
        Message(
            "The folder of the backups, {folder}, is not there; connect its disk, or choose "
            "another folder.",
            folder=folder,
        )
    )
