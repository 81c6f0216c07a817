"""The fields of a visit, and whether its feet are to be captured."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

from PySide6.QtWidgets import QCheckBox, QWidget

from insole_core.records.visit import CaptureState, Visit
from insole_studio.features.records.record_form import RecordDialog
from insole_studio.texts import tr


class VisitDialog(RecordDialog[Visit]):
    """A form of a visit."""

    def __init__(self, visit: Visit, parent: QWidget | None = None) -> None:
        super().__init__(tr("Visit"), visit, parent)
        self.capture = QCheckBox(tr("The capture room has to capture the feet"))
        self.capture.setChecked(visit.capture_state is CaptureState.WANTED)
        self.form.addRow("", self.capture)
        self.editors["reason"].setFocus()

    def read(self, today: date) -> Visit:
        """Return the visit as it was typed."""
        return replace(super().read(today), capture_state=self._capture_state())

    def _capture_state(self) -> CaptureState:
        before = self.value.capture_state
        if self.capture.isChecked() == (before is CaptureState.WANTED):
            return before
        return CaptureState.WANTED if self.capture.isChecked() else CaptureState.NONE
