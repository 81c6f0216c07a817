"""The orders of the clinic as a list by state, and what can be done with the chosen one."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from insole_core.records.order import MOST_DAYS_UNTIL_DUE, OrderState
from insole_studio.features.records.order_rows import state_text
from insole_studio.texts import tr
from insole_studio.widgets.combo_box import ComboBox
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.row_table import RowTable, TableRow

OPEN = "open"


class OrdersPage(QWidget):
    """A table of orders, those that are due first on top."""

    state_chosen = Signal(str)
    """Which orders to show: `OPEN` or the value of a state."""
    move_requested = Signal(str, str)
    """The id of an order, and the value of the state to bring it to."""
    order_chosen = Signal(str)
    edit_requested = Signal(str)
    patients_requested = Signal()
    days_edited = Signal(int)
    """After how many days new orders are due; 0 for no due date."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        states = [(state.value, state_text(state)) for state in OrderState]
        self._title = QLabel(tr("Orders"))
        self._title.setObjectName("title")
        self.shown = ComboBox([(OPEN, tr("Open orders")), *states])
        self.shown.setAccessibleName(tr("Which orders"))
        self.shown.edited.connect(self.state_chosen)
        self.days = NumberField(
            tr("days"), least=0, greatest=MOST_DAYS_UNTIL_DUE, step=1, decimals=0
        )
        self.days.setSpecialValueText(tr("no due date"))
        self.days.edited.connect(self._edit_days)
        self._days_label = QLabel(tr("&New orders are due after"))
        self._days_label.setBuddy(self.days)
        headings = (tr("Patient"), tr("Order"), tr("State"), tr("Due"), tr("Shop"))
        self.table = RowTable(headings)
        self.table.setAccessibleName(tr("Orders"))
        self.table.chosen.connect(self.order_chosen)
        self.table.current_changed.connect(self._show_chosen)
        self.to_state = ComboBox(states)
        self.to_state.setAccessibleName(tr("New state"))
        self.move_button = QPushButton(tr("Bring to this state"))
        self.move_button.clicked.connect(self._request_move)
        self.open_button = QPushButton(tr("Open the visit"))
        self.open_button.clicked.connect(self._request_open)
        self.edit_button = QPushButton(tr("Shop and due date…"))
        self.edit_button.clicked.connect(self._request_edit)
        back = QPushButton(tr("Patients"))
        back.clicked.connect(self.patients_requested)
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(back)
        top.addWidget(self._title)
        top.addStretch(1)
        top.addWidget(self._days_label)
        top.addWidget(self.days)
        top.addSpacing(16)
        top.addWidget(self.shown)
        bottom = QHBoxLayout()
        bottom.setSpacing(8)
        for part in self._of_chosen:
            bottom.addWidget(part)
        bottom.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 16, 24, 16)
        layout.setSpacing(16)
        layout.addLayout(top)
        layout.addWidget(self.table, 1)
        layout.addLayout(bottom)
        self._show_chosen()

    @property
    def _of_chosen(self) -> tuple[QWidget, ...]:
        """The widgets that need a chosen order."""
        return self.open_button, self.edit_button, self.to_state, self.move_button

    def show_orders(self, title: str, rows: Sequence[TableRow], *, of_person: bool) -> None:
        """Show orders: those of the clinic in a state, or all those of a person."""
        self._title.setText(title)
        for part in (self.shown, self._days_label, self.days):
            part.setVisible(not of_person)
        self.table.show_rows(rows)
        self._show_chosen()

    def show_days(self, days: int) -> None:
        """Show after how many days new orders are due."""
        self.days.show_value(days)

    def _edit_days(self, days: float) -> None:
        self.days_edited.emit(round(days))

    def _show_chosen(self) -> None:
        for part in self._of_chosen:
            part.setEnabled(bool(self.table.current_key))

    def _request_move(self) -> None:
        self.move_requested.emit(self.table.current_key, self.to_state.currentData())

    def _request_edit(self) -> None:
        self.edit_requested.emit(self.table.current_key)

    def _request_open(self) -> None:
        self.order_chosen.emit(self.table.current_key)
