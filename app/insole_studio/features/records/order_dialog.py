"""Shop, due date and remarks of an order."""

from __future__ import annotations

from datetime import date

from PySide6.QtWidgets import (
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
from insole_core.records.order import Order
from insole_studio.features.records.order_rows import event_text
from insole_studio.texts import tr
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_labels import mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.notes_field import NotesField

_WIDTH_PX = 420
_MOST_STEPS = 8
"""Of its history, the latest."""


class OrderDialog(QDialog):
    """A form; it is accepted once the date is one of the calendar."""

    def __init__(self, order: Order, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Order {number}").format(number=order.number))
        self.setMinimumWidth(_WIDTH_PX)
        self.shop = QLineEdit(order.shop)
        self.shop.setMaxLength(MOST_NAME)
        self.due = DateField("" if order.due_on is None else order.due_on.isoformat())
        self.remarks = NotesField()
        self.remarks.setPlainText(order.remarks)
        self.due_on = order.due_on
        self.refusal = MessageLabel("warning")
        self.history = MessageLabel("quiet")
        self.history.say_all([event_text(event) for event in order.events[-_MOST_STEPS:]])
        buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.keep = buttons.addButton(tr("Keep"), role.AcceptRole)
        buttons.addButton(tr("Cancel"), role.RejectRole)
        buttons.accepted.connect(self._try)
        buttons.rejected.connect(self.reject)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Shop"), self.shop)
        form.addRow(tr("Due"), self.due)
        form.addRow(tr("Remarks"), self.remarks)
        mark_labels(form)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(form)
        layout.addWidget(self.history)
        layout.addWidget(self.refusal)
        layout.addWidget(buttons)

    def _try(self) -> None:
        try:
            day = read_day("visit", self.due.text(), date.today())
        except InputError as error:
            self.refusal.say(error.message)
        else:
            self.due_on = date.fromisoformat(day) if day else None
            self.accept()
