"""The fields of an order, and its latest steps."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from insole_core.records.order import Order
from insole_studio.features.records.order_rows import event_text
from insole_studio.features.records.record_form import RecordDialog
from insole_studio.texts import tr
from insole_studio.widgets.message_label import MessageLabel

_MOST_STEPS = 8
"""Of its history, the latest."""


class OrderDialog(RecordDialog[Order]):
    """A form of an order."""

    def __init__(self, order: Order, parent: QWidget | None = None) -> None:
        super().__init__(tr("Order {number}").format(number=order.number), order, parent)
        self.history = MessageLabel("quiet")
        self.history.say_all([event_text(event) for event in order.events[-_MOST_STEPS:]])
        self.below.addWidget(self.history)
