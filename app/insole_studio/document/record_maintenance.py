"""What the window does for the record by itself: backups, and files that nobody needs."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.progress import Progress
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.jobs import Jobs

if TYPE_CHECKING:
    from insole_core.records.backup.back_up import BackupReport
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

BACKUP = "backup"
LOOK_MS = 5 * 60 * 1000


class RecordMaintenance(QObject):
    """Makes the backups that are due at this station, and once a day lets unused files go.

    Parameters
    ----------
    settings
        Folders that belong to a backup, by name.
    jobs
        Jobs of the backups alone, which take minutes: the record's own keep saving.
    """

    made = Signal()
    failed = Signal(object)
    """Emitted with the error that kept it from the record."""

    def __init__(
        self,
        clinic: ClinicRecord,
        settings: Mapping[str, Path],
        jobs: Jobs,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._settings = settings
        self._jobs = jobs
        self._swept_on: date | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def look(self) -> None:
        """Make the backup that is due, in the background, after the sweep of the day."""
        if not self._clinic.is_open or self._jobs.is_running(BACKUP):
            return
        settings, today = self._settings, date.today()
        sweeps, self._swept_on = self._swept_on != today, today

        def maintain(records: Records, progress: Progress) -> BackupReport | None:
            from insole_core.records.backup.schedule import back_up_if_due
            from insole_core.records.retention import sweep_contents

            if records.is_read_only:
                return None
            if sweeps:
                sweep_contents(records.context)
            return back_up_if_due(records.context, settings, progress)

        self._clinic.start_work(self._jobs, BACKUP, maintain, self._tell, self._fail)

    def close(self) -> None:
        """Cancel a running backup; the next one goes on where it was."""
        self._timer.stop()
        self._jobs.close()

    def _tell(self, report: BackupReport | None) -> None:
        if report is not None:
            self.made.emit()

    def _fail(self, error: Exception) -> None:
        log.warning("the record was not maintained: %s", error)
        self.failed.emit(error)
