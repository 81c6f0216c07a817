"""Backups of the record: now, on a schedule, and when and how the start page reminds of one."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InsoleError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_studio.jobs import Jobs
from insole_studio.services.app_services import AppServices
from insole_studio.settings import BackupDay, BackupKeep
from insole_studio.texts import fill, moment_text, tr, translate_core_message

if TYPE_CHECKING:
    from insole_core.records.backup.back_up import BackupReport, BackupSchedule, KeepRule
    from insole_core.records.records import Records

_INTERVALS = 2
"""So many may pass without a backup."""
_WEEK = timedelta(days=7)
log = logging.getLogger(__name__)
BACKUP, LOOK, REMIND = "backup", "backup-look", "backup-remind"
NOTICE = "backup-missing"
LOOK_EVERY_MS = 60_000
REMIND_EVERY_MS = 60 * LOOK_EVERY_MS
WAIT_S = 0.1
MONTHS_OF_YEAR = 12
RETRY_AFTER = timedelta(minutes=30)
MEGABYTE = 1e6


@dataclass(frozen=True)
class BackupFacts:
    """What the record knows of its backups.

    Parameters
    ----------
    last
        When any station has made one; None for never.
    has_patients
        Whether there is anything to lose; a sample patient is not.
    """

    last: datetime | None
    has_patients: bool


def _read_facts(records: Records) -> BackupFacts:
    """Return what the record knows of its backups; anybody may know it."""
    from insole_core.records.backup.back_up import last_backup_at
    from insole_core.records.sample_patient import has_patients

    with records.context.database.reading() as connection:
        has_some = has_patients(connection)
    return BackupFacts(last_backup_at(records.context.database), has_some)


def reminder_text(facts: BackupFacts, day: BackupDay, now: datetime) -> str:
    """Return the sentence of the start page; empty while all is well.

    Parameters
    ----------
    day
        Of the plan of this station; backups that are made by hand only are expected every week.
    """
    if facts.last is None:
        if not facts.has_patients:
            return ""
        return tr("There is no backup yet: what is in the record is lost if its disk fails.")
    if not is_overdue(facts.last, day, now):
        return ""
    sentence = tr("The last backup is of {moment}; what was entered since is in no other place.")
    return sentence.format(moment=moment_text(facts.last))


def is_overdue(last: datetime, day: BackupDay, now: datetime) -> bool:
    """Return whether a backup is older than two intervals of a plan."""
    return now - last > _INTERVALS * (timedelta(days=1) if day == "daily" else _WEEK)


@dataclass(frozen=True)
class BackupState:
    """What is known of the backups.

    Parameters
    ----------
    opened_by
        What opens them: "passphrase" or "private key"; empty until they are set up.
    snapshots
        When those in the folder were made, the oldest first; none when it cannot be read.
    """

    opened_by: str
    snapshots: tuple[datetime, ...]


class Backups(QObject):
    """Makes backups in jobs of its own: a long one keeps nothing else waiting."""

    finished = Signal(object)
    """Emitted with the `BackupReport`."""
    failed = Signal(object)
    settings_requested = Signal()
    reminder_changed = Signal(str)
    """Emitted with what the start page says about backups; empty while all is well."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._settings = services.settings
        self.jobs = Jobs(self)
        self._retry_at: datetime | None = None
        self._one_at_a_time = threading.Lock()
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)
        self._hourly = QTimer(self)
        self._hourly.setInterval(REMIND_EVERY_MS)
        self._hourly.timeout.connect(self.remind)
        self._hourly.start()
        services.clinic.state_changed.connect(self.look)
        services.clinic.state_changed.connect(self.remind)

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
        from insole_core.records.backup.back_up import BackupSchedule

        day = self._settings.backup_day
        if day == "never":
            return None
        return BackupSchedule(None if day == "daily" else int(day), self._settings.backup_hour)

    @property
    def keep_rule(self) -> KeepRule | None:
        """Which backups stay; None for all."""
        from insole_core.records.backup.back_up import KeepRule

        rules = {"all": None, "months": KeepRule(), "year": KeepRule(months=MONTHS_OF_YEAR)}
        return rules[self._settings.backup_keep]

    @contextmanager
    def alone(self, progress: Progress) -> Iterator[None]:
        """Let backups and restoring wait for each other, also for one that is being stopped.

        Called in the thread of a job.

        Raises
        ------
        Cancelled
        """
        while not self._one_at_a_time.acquire(timeout=WAIT_S):
            progress.step(0.0, "Waiting until the backup has stopped")
        try:
            yield
        finally:
            self._one_at_a_time.release()

    def remind(self) -> None:
        """Let the start page say if the record has not been backed up for long."""
        clinic = self._services.clinic
        if clinic.is_writable:
            clinic.ask(REMIND, _read_facts, self._show_reminder, self._note_no_facts)
        else:
            self.reminder_changed.emit("")

    def put_off_reminder(self) -> None:
        """Say nothing of backups for a week."""
        self._settings.backup_reminder_from = (date.today() + _WEEK).isoformat()
        self._services.save_settings()
        self.reminder_changed.emit("")

    def set_keep(self, keep: BackupKeep) -> None:
        """Keep which of the backups stay; the next backup removes the others."""
        self._settings.backup_keep = keep
        self._services.save_settings()

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
        self.remind()
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
        if clinic.is_writable and not self.is_running and not is_waiting:
            assert folder is not None
            self.jobs.start(
                LOOK, lambda _progress: newest_in(folder), self._go_on, self._note_failure
            )

    def begin(self, *, is_first: bool = False) -> None:
        """Make a backup in the background.

        Parameters
        ----------
        is_first
            Whether a folder that has not been used before may be without backups; else a disk that
            is not connected is told, and nothing written into the empty folder that stands in its
            place.
        """
        folder = self.folder
        if folder is None or self.is_running:
            return
        records = self._services.clinic.ask_now(lambda found: found)
        saved = self._services.paths.backed_up_folders
        may_begin = is_first and self._settings.backup_used_folder != str(folder)
        keep = self.keep_rule

        def run(progress: Progress) -> BackupReport:
            from insole_core.records.backup.back_up import back_up

            with self.alone(progress):
                if not may_begin:
                    _check_there(folder)
                return back_up(records.context, folder, saved, progress, keep=keep)

        self.jobs.start(BACKUP, run, self._finish, self._note_failure)

    def cancel(self) -> None:
        """Stop the running backup; the ones before stay as they are."""
        self.jobs.cancel(BACKUP)

    def close(self) -> None:
        """Stop all jobs, and look no more."""
        self._timer.stop()
        self._hourly.stop()
        self.jobs.close()

    def _go_on(self, newest: datetime | None) -> None:
        schedule = self.schedule
        if schedule is None or not self._services.clinic.is_open:
            return  # as while it is restored
        if schedule.is_due(newest, datetime.now().astimezone()):
            self.begin()
        else:
            self._services.notices.drop(NOTICE)

    def _show_reminder(self, facts: BackupFacts) -> None:
        put_off = date.today().isoformat() < self._settings.backup_reminder_from
        now = datetime.now().astimezone()
        text = "" if put_off else reminder_text(facts, self._settings.backup_day, now)
        self.reminder_changed.emit(text)

    def _note_no_facts(self, error: Exception) -> None:
        log.info("it is not known when the last backup was made: %s", error)

    def _finish(self, report: BackupReport) -> None:
        self._retry_at = None
        self._settings.backup_used_folder = self._settings.backup_folder
        self._services.save_settings()
        self.remind()
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
    OutputError
        When the folder is not there, as on a disk that is not connected.
    """
    from insole_core.records.backup.backup_folder import BackupFolder, folder_is_away

    if not folder.is_dir():
        raise folder_is_away(folder)
    snapshots = BackupFolder(folder).snapshots()
    return snapshots[-1].made_at if snapshots else None


def read_state(records: Records, folder: Path | None) -> BackupState:
    """Return what is known of the backups of a record."""
    from insole_core.records.backup.back_up import key_of_backups
    from insole_core.records.backup.backup_folder import BackupFolder

    key = key_of_backups(records.context)
    found = [] if folder is None or not folder.is_dir() else BackupFolder(folder).snapshots()
    made = tuple(snapshot.made_at for snapshot in found)
    return BackupState("" if key is None else key.opened_by, made)


def report_text(report: BackupReport) -> str:
    """Say what a backup has written; all of it was read again."""
    sentence = fill(
        tr(
            "Backup {number} is made: patients {patients}, {rows} and {files}, {new_mb:.1f} MB of "
            "them new. All that was written has been read again and is right."
        ),
        number=report.snapshot.number,
        patients=report.patients,
        rows=entries_text(report.rows),
        files=files_text(report.contents),
        new_mb=report.written_bytes / MEGABYTE,
    )
    if report.removed_snapshots:
        removed = tr("Old backups removed: {count}.").format(count=report.removed_snapshots)
        return f"{sentence} {removed}"
    return sentence


def damaged_text(report: BackupReport) -> str:
    """Say that the record itself has lost files."""
    return translate_core_message(
        counted(
            len(report.damaged),
            "One file is missing or damaged in the record and is not in the backup; verify the "
            "record, and restore it from an earlier backup.",
            "{count} files are missing or damaged in the record and are not in the backup; verify "
            "the record, and restore them from an earlier backup.",
        )
    )


def entries_text(count: int) -> str:
    """Return how many rows of the record there are, as a user calls them."""
    return translate_core_message(counted(count, "1 entry", "{count} entries"))


def files_text(count: int) -> str:
    """Return how many files there are."""
    return translate_core_message(counted(count, "1 file", "{count} files"))


def _check_there(folder: Path) -> None:
    from insole_core.records.backup.backup_folder import HEAD_FILE, folder_is_away

    if not (folder / HEAD_FILE).is_file():
        raise folder_is_away(folder)
