"""The orders of the clinic as a list, and what can be done with the chosen one."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QPushButton, QVBoxLayout, QWidget

from insole_core.records.order import MOST_DAYS_UNTIL_DUE, OrderState
from insole_studio.features.records.rows import state_text
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox, allow
from insole_studio.widgets.layouts import FlowRow
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.row_table import RowTable, TableRow

OPEN, ALL = "open", "all"


class OrdersPage(QWidget):
    """A table of orders, those that are due first on top."""

    state_chosen = Signal(str)
    """Which orders to show: `OPEN`, `ALL`, or the value of a state."""
    search_edited = Signal(str)
    move_requested = Signal(str, str)
    """The id of an order, and the value of the state to bring it to."""
    order_chosen = Signal(str)
    edit_requested = Signal(str)
    revise_requested = Signal(str)
    papers_requested = Signal(str)
    folder_requested = Signal(str)
    patients_requested = Signal()
    nest_requested = Signal()
    """To nest those that are listed."""
    days_edited = Signal(int)
    """After how many days new orders are due; 0 for no due date."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        states = [(state.value, state_text(state)) for state in OrderState]
        self._title = QLabel(tr("Orders"))
        self._title.setObjectName("title")
        self.search = QLineEdit()
        self.search.setPlaceholderText(tr("Patient, order or shop"))
        self.search.setClearButtonEnabled(True)
        self.search.setAccessibleName(tr("Search the orders"))
        self.search.textChanged.connect(self.search_edited)
        self.shown = ComboBox([(OPEN, tr("Open orders")), (ALL, tr("All orders")), *states])
        self.shown.setAccessibleName(tr("Which orders"))
        self.shown.edited.connect(self.state_chosen)
        self.days = NumberField(
            tr("days"), least=0, greatest=MOST_DAYS_UNTIL_DUE, step=1, decimals=0
        )
        self.days.setSpecialValueText(tr("no due date"))
        self.days.edited.connect(self._edit_days)
        self._days_label = QLabel(tr("&New orders are due after"))
        self._days_label.setBuddy(self.days)
        headings = (
            tr("Patient"), tr("Order"), tr("Revision"), tr("State"), tr("Due"), tr("Shop"),
            tr("Ordered"),
        )  # fmt: skip
        self.table = RowTable(headings, sorts=False)
        self.table.setAccessibleName(tr("Orders"))
        self.table.chosen.connect(self.order_chosen)
        self.table.current_changed.connect(self._show_chosen)
        self._count = QLabel()
        self._count.setObjectName("quiet")
        self.to_state = ComboBox(states)
        self.to_state.setAccessibleName(tr("New state"))
        self.move_button = QPushButton(tr("Bring to this state"))
        self.move_button.clicked.connect(self._request_move)
        self.cancel_button = QPushButton(tr("Cancel the order"))
        self.cancel_button.clicked.connect(self._request_cancel)
        self.open_button = self._button(tr("Open the visit"), self.order_chosen)
        self.edit_button = self._button(tr("Shop and due date…"), self.edit_requested)
        self.revise_button = self._button(tr("Revise…"), self.revise_requested)
        self.papers_button = self._button(tr("Print the papers…"), self.papers_requested)
        self.folder_button = self._button(tr("Open the folder"), self.folder_requested)
        self.nest_button = QPushButton(tr("Nest the orders…"))
        self.nest_button.clicked.connect(self.nest_requested)
        self._lay_out()
        self._show_chosen()

    @property
    def _of_chosen(self) -> tuple[QWidget, ...]:
        """The widgets that need a chosen order."""
        return (
            self.open_button, self.revise_button, self.edit_button, self.papers_button,
            self.folder_button, self.to_state, self.move_button, self.cancel_button,
        )  # fmt: skip

    def show_orders(
        self, title: str, rows: Sequence[TableRow], count: int, *, of_person: bool
    ) -> None:
        """Show orders: those of the clinic that are searched for, or all those of a person.

        Parameters
        ----------
        count
            How many there are; the rows are the first of them.
        """
        self._title.setText(title)
        for part in (self.search, self.shown, self._days_label, self.days):
            part.setVisible(not of_person)
        self._count.setText(
            tr("One order")
            if count == 1
            else tr("{count} orders").format(count=count)
            if len(rows) == count
            else tr("The first {shown} of {count} orders").format(shown=len(rows), count=count)
        )
        self.table.show_rows(rows)
        allow(
            self.nest_button,
            "" if rows else tr("There is no order in the list."),
            tr("The pieces of several orders on one block or sheet"),
        )
        self._show_chosen()

    def show_days(self, days: int) -> None:
        """Show after how many days new orders are due."""
        self.days.show_value(days)

    def _button(self, text: str, request: SignalInstance) -> QPushButton:
        """Return a button that asks for something with the chosen order."""
        button = QPushButton(text)
        button.clicked.connect(lambda: request.emit(self.table.current_key))
        return button

    def _lay_out(self) -> None:
        back = QPushButton(tr("Patients"))
        back.clicked.connect(self.patients_requested)
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(back)
        top.addWidget(self._title)
        top.addWidget(self.search, 1)
        top.addWidget(self.shown)
        top.addSpacing(16)
        top.addWidget(self._days_label)
        top.addWidget(self.days)
        bottom = QHBoxLayout()
        bottom.addWidget(FlowRow(*self._of_chosen), 1)
        bottom.addWidget(self.nest_button, 0, Qt.AlignmentFlag.AlignTop)
        bottom.addWidget(self._count, 0, Qt.AlignmentFlag.AlignTop)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 16, 24, 16)
        layout.setSpacing(16)
        layout.addLayout(top)
        layout.addWidget(self.table, 1)
        layout.addLayout(bottom)

    def _edit_days(self, days: float) -> None:
        self.days_edited.emit(round(days))

    def _show_chosen(self) -> None:
        tips: dict[QWidget, str] = {
            self.revise_button: tr("Open its visit, and export the next revision of its files")
        }
        why_not = "" if self.table.current_key else tr("Choose an order in the list first.")
        for part in self._of_chosen:
            allow(part, why_not, tips.get(part, ""))

    def _request_move(self) -> None:
        self.move_requested.emit(self.table.current_key, self.to_state.currentData())

    def _request_cancel(self) -> None:
        self.move_requested.emit(self.table.current_key, OrderState.CANCELLED.value)
