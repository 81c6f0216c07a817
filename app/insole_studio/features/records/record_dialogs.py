"""Dialogs with the fields of a visit, an order and a follow-up."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import date
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.records.order import Order
from insole_core.records.record_field import check_fields, typed_fields
from insole_core.records.visit import CaptureState, FollowUp, Visit
from insole_studio.features.records.record_form import (
    label_of,
    new_editor,
    new_line,
    show_text,
    shown_texts,
    text_in,
)
from insole_studio.features.records.rows import event_text
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import allow, mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow
from insole_studio.widgets.text_fields import NotesField

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Value = TypeVar("Value", bound="DataclassInstance")

_WIDTH_PX = 460
_FOLLOW_UPS_SIZE = (640, 440)
_MOST_STEPS = 8
"""Of its history, the latest."""


class FieldsDialog(QDialog, Generic[Value]):
    """A form of all fields of a value; it is accepted once all that is typed can be right.

    Attributes
    ----------
    value
        As it was typed, once it is accepted.
    typed
        The fields alone, by their names.
    """

    def __init__(self, title: str, value: Value, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(_WIDTH_PX)
        self.value = value
        self.typed: Mapping[str, Any] = {}
        kind = type(value)
        self.editors = {name: new_editor(f) for name, f in typed_fields(kind).items()}
        for name, text in shown_texts(value).items():
            show_text(self.editors[name], text)
        self.refusal = MessageLabel("warning")
        self.form = QFormLayout()
        self.form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for name, editor in self.editors.items():
            self.form.addRow(label_of(kind, name), editor)
        mark_labels(self.form)
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.keep = buttons.addButton(tr("Keep"), role.AcceptRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        buttons.accepted.connect(self._try)
        buttons.rejected.connect(self.reject)
        self.below = QVBoxLayout()
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(self.form)
        layout.addLayout(self.below)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)

    def read(self, today: date) -> Value:
        """Return the value as it was typed; a needed day that was emptied stays.

        Raises
        ------
        InputError
            Names the first field that cannot be right.
        """
        fields = typed_fields(type(self.value))
        read = {n: fields[n].read(text_in(editor), today) for n, editor in self.editors.items()}
        self.typed = {n: v for n, v in read.items() if v is not None or not fields[n].is_needed}
        return replace(self.value, **self.typed)

    def _try(self) -> None:
        try:
            self.value = self.read(date.today())
        except InputError as error:
            self.refusal.say(error.message)
        else:
            self.accept()


class VisitDialog(FieldsDialog[Visit]):
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


class OrderDialog(FieldsDialog[Order]):
    """A form of an order."""

    def __init__(self, order: Order, parent: QWidget | None = None) -> None:
        super().__init__(tr("Order {number}").format(number=order.number), order, parent)
        self.history = MessageLabel("quiet")
        self.history.say_all([event_text(event) for event in order.events[-_MOST_STEPS:]])
        self.below.addWidget(self.history)


class FollowUpDialog(QDialog):
    """The follow-ups of a person, the newest first, and a form for another one.

    Parameters
    ----------
    begun
        What is filled in of that to begin with.
    """

    def __init__(
        self, begun: FollowUp, before: Sequence[FollowUp], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Follow-up"))
        self.resize(*_FOLLOW_UPS_SIZE)
        self._person_id = begun.person_id
        fields = typed_fields(FollowUp)
        day, outcome, notes = (label_of(FollowUp, name) for name in fields)
        self.table = RowTable((day, outcome, notes, tr("By")), stretched=2)
        self.table.setAccessibleName(tr("Follow-ups so far"))
        self.table.show_rows([_row(follow_up) for follow_up in before])
        self.outcome = new_line(fields["outcome"])
        self.outcome.setText(begun.outcome)
        self.outcome.setPlaceholderText(tr("Better, the same, worse; in a word or two"))
        self.notes = NotesField()
        self.notes.setPlainText(begun.notes)
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.add = buttons.addButton(tr("Add follow-up"), role.AcceptRole)
        buttons.addButton(tr("Close"), role.RejectRole)
        buttons.accepted.connect(self._try)
        buttons.rejected.connect(self.reject)
        self.refusal = MessageLabel("warning")
        self.outcome.textChanged.connect(self._allow)
        self._allow()
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(outcome, self.outcome)
        form.addRow(notes, self.notes)
        mark_labels(form)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(self.table, 1)
        layout.addLayout(form)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)
        self.outcome.setFocus()

    def follow_up(self) -> FollowUp:
        """Return what was typed, as of today."""
        return FollowUp(
            self._person_id, date.today(), self.outcome.text().strip(), self.notes.toPlainText()
        )

    def _allow(self) -> None:
        is_typed = bool(self.outcome.text().strip())
        allow(self.add, "" if is_typed else tr("Type the outcome first."))

    def _try(self) -> None:
        try:
            check_fields(self.follow_up(), date.today())
        except InputError as error:
            self.refusal.say(error.message)
        else:
            self.accept()


def _row(follow_up: FollowUp) -> TableRow:
    notes = " ".join(follow_up.notes.split())
    cells = (follow_up.on_date.isoformat(), follow_up.outcome, notes, follow_up.author)
    return TableRow(follow_up.id, cells, tip=follow_up.notes)
