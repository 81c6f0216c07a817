"""What the window does for the record by itself: files that nobody needs."""

from __future__ import annotations

import logging
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_studio.document.clinic_record import ClinicRecord

if TYPE_CHECKING:
    from insole_core.records.content_store import SweptContents
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

SWEEP = "record-sweep"
LOOK_MS = 5 * 60 * 1000


class RecordMaintenance(QObject):
    """Lets unused files go once a day."""

    swept = Signal()

    def __init__(self, clinic: ClinicRecord, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._swept_on: date | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def look(self) -> None:
        """Sweep in the background, unless that was done today."""
        today = date.today()
        is_ready = self._clinic.is_open and not self._clinic.is_read_only
        if not is_ready or self._swept_on == today:
            return
        self._swept_on = today
        self._clinic.ask(SWEEP, _sweep, lambda _swept: self.swept.emit(), _note_failure)

    def close(self) -> None:
        """Look no more."""
        self._timer.stop()


def _sweep(records: Records) -> SweptContents:
    from insole_core.records.retention import sweep_contents

    return sweep_contents(records.context)


def _note_failure(error: Exception) -> None:
    log.warning("unused files were not swept: %s", error)
