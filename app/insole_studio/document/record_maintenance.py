"""What the window does for the record by itself: files that nobody needs, or that must go."""

from __future__ import annotations

import logging
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InsoleError
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.erased_leftovers import ErasedLeftovers

if TYPE_CHECKING:
    from insole_core.records.content_store import SweptContents
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

SWEEP, FORGET = "record-sweep", "record-forget"
LOOK_MS = 5 * 60 * 1000


class RecordMaintenance(QObject):
    """Lets unused files go once a day, and what is left of erased patients at once.

    Parameters
    ----------
    leftovers
        What earlier erasures have left on this computer.
    """

    swept = Signal()

    def __init__(
        self, clinic: ClinicRecord, leftovers: ErasedLeftovers, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._leftovers = leftovers
        self._swept_on: date | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()
        clinic.state_changed.connect(self._forget)
        clinic.changed.connect(self._forget)

    def look(self) -> None:
        """Sweep in the background, unless that was done today."""
        self._forget()
        today = date.today()
        if not self._clinic.is_writable or self._swept_on == today:
            return
        self._swept_on = today
        self._clinic.ask(SWEEP, _sweep, lambda _swept: self.swept.emit(), _note_failure)

    def _forget(self) -> None:
        """Remove what is left of whoever is erased by now, here or before a crash."""
        if self._clinic.is_open and self._leftovers.are_noted:
            self._clinic.ask(FORGET, self._leftovers.erased, self._forget_erased, _note_failure)

    def _forget_erased(self, erased: dict[str, bool]) -> None:
        try:
            self._leftovers.forget(erased)
        except InsoleError as error:
            _note_failure(error)

    def close(self) -> None:
        """Look no more."""
        self._timer.stop()


def _sweep(records: Records) -> SweptContents:
    from insole_core.records.retention import sweep_contents

    return sweep_contents(records.context)


def _note_failure(error: Exception) -> None:
    log.warning("files that nobody needs are still there: %s", error)
