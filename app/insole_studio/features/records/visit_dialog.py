"""The fields of a visit: day, reason, findings, weight, shoe size, and whether to capture."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.days import read_day
from insole_core.errors import InputError
from insole_core.records.field_checks import MOST_NAME
from insole_core.records.visit import CaptureState, Visit
from insole_studio.texts import localised, tr
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_labels import mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.notes_field import NotesField

_WIDTH_PX = 460


class VisitDialog(QDialog):
    """A form; it is accepted once all that is typed can be right."""

    def __init__(self, visit: Visit, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Visit"))
        self.setMinimumWidth(_WIDTH_PX)
        self.visit = visit
        self.day = DateField(visit.visited_on.isoformat())
        self.reason = QLineEdit(visit.reason)
        self.reason.setMaxLength(MOST_NAME)
        self.findings = NotesField()
        self.findings.setPlainText(visit.findings)
        self.weight = QLineEdit(_text(visit.weight_kg))
        self.shoe_size = QLineEdit(_text(visit.shoe_size_eu))
        self.capture = QCheckBox(tr("The capture room has to capture the feet"))
        self.capture.setChecked(visit.capture_state is CaptureState.WANTED)
        self.refusal = MessageLabel("warning")
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.keep = buttons.addButton(tr("Keep"), role.AcceptRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        buttons.accepted.connect(self._try)
        buttons.rejected.connect(self.reject)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Day"), self.day)
        form.addRow(tr("Reason"), self.reason)
        form.addRow(tr("Findings"), self.findings)
        form.addRow(tr("Weight (kg)"), self.weight)
        form.addRow(tr("Shoe size EU"), self.shoe_size)
        form.addRow("", self.capture)
        mark_labels(form)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(form)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)
        self.reason.setFocus()

    def _try(self) -> None:
        try:
            self.visit = self._read(date.today())
        except InputError as error:
            self.refusal.say(error.message)
        else:
            self.accept()

    def _read(self, today: date) -> Visit:
        """Return the visit as it was typed.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        day = read_day("visit", self.day.text(), today)
        visit = replace(
            self.visit,
            visited_on=date.fromisoformat(day) if day else self.visit.visited_on,
            reason=self.reason.text(),
            findings=self.findings.toPlainText(),
            weight_kg=_number(self.weight.text()),
            shoe_size_eu=_number(self.shoe_size.text()),
            capture_state=self._capture_state(),
        )
        return visit.checked(today)

    def _capture_state(self) -> CaptureState:
        before = self.visit.capture_state
        if self.capture.isChecked() == (before is CaptureState.WANTED):
            return before
        return CaptureState.WANTED if self.capture.isChecked() else CaptureState.NONE


def _text(value: float | None) -> str:
    return "" if value is None else localised(value, "g")


def _number(text: str) -> float | None:
    """Return what was typed as a number; None for nothing.

    Raises
    ------
    InputError
        When it is no number.
    """
    text = text.strip()
    if not text:
        return None
    try:
        return float(text.replace(",", "."))
    except ValueError:
        raise InputError("{text} is no number; write it such as 72.5.", text=text[:40]) from None
