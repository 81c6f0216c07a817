"""The page that the program opens on: search for a patient, today's visits, open orders."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_studio.features.records.rows import visit_headings
from insole_studio.services.person_list import person_headings
from insole_studio.texts import tr
from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.form_parts import allow
from insole_studio.widgets.icons import icon
from insole_studio.widgets.layouts import FlowRow, keep_room
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

MOST_LETTERS = 200
"""Of what is searched for; longer texts are no name."""


class StartPage(QWidget):
    """The clinic's patients; the keyboard focus is in the search line."""

    search_edited = Signal(str)
    person_chosen = Signal(str)
    visit_chosen = Signal(str)
    order_chosen = Signal(str)
    action_requested = Signal(str)
    recent_file_chosen = Signal(str)
    reminder_put_off = Signal()
    more_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.search = QLineEdit()
        self.search.setMaxLength(MOST_LETTERS)
        self.search.setPlaceholderText(tr("Name, birth date, personal number or order"))
        self.search.setAccessibleName(tr("Search patients"))
        self.search.setClearButtonEnabled(True)
        self.search.setObjectName("search")
        self.search.textChanged.connect(self.search_edited)
        self.search.installEventFilter(self)
        self.new_patient = self._button("", tr("New patient…"), "new_patient")
        self.new_patient.setObjectName("primary")
        self._found_title = _heading(tr("Recent patients"))
        self.found = RowTable(person_headings(), sorts=False)
        self.found.setAccessibleName(tr("Patients"))
        self.found.chosen.connect(self.person_chosen)
        self.more = QPushButton(tr("Show more"))
        self.more.clicked.connect(self.more_requested)
        self.found.end_reached.connect(self.more_requested)
        self.more.hide()
        self._nothing = QLabel()
        self._nothing.setObjectName("quiet")
        self._nothing.setWordWrap(True)
        self.today = RowTable(visit_headings())
        self.today.setAccessibleName(tr("Today's visits"))
        self.today.chosen.connect(self.visit_chosen)
        headings = (tr("Patient"), tr("Order"), tr("State"), tr("Due"))
        self.orders = RowTable(headings, sorts=False)
        self.orders.setAccessibleName(tr("Open orders"))
        self.orders.chosen.connect(self.order_chosen)
        self.message = MessageLabel("warning")
        self.remedies: dict[str, QPushButton] = {}
        """Buttons beside the message, by their action."""
        self.reminder = ElidedLabel("")
        self.reminder.setObjectName("quiet")
        self.back_up = self._button("", tr("Backup…"), "backup")
        self.put_off = QPushButton(tr("Remind me in a week"))
        self.put_off.clicked.connect(self.reminder_put_off)
        self._files: dict[str, QPushButton] = {}
        self._recent_row = FlowRow()
        self._of_record = QWidget()
        self._lay_out()

    @property
    def example(self) -> QPushButton:
        """The button that opens the example."""
        return self._files["device"]

    def show_found(self, title: str, rows: Sequence[TableRow], nothing: str) -> None:
        """Show the patients that were found, or the recent ones.

        Parameters
        ----------
        nothing
            What to say where there are no rows.
        """
        self._found_title.setText(title)
        self.found.show_rows(rows)
        self._nothing.setText("" if rows else nothing)
        self._nothing.setVisible(not rows)

    def show_more(self, has_more: bool) -> None:
        """Offer further patients where there are some."""
        self.more.setVisible(has_more)

    def show_day(self, today: Sequence[TableRow], orders: Sequence[TableRow]) -> None:
        """Show today's visits and the open orders."""
        self.today.show_rows(today)
        self.orders.show_rows(orders)

    def show_message(
        self, sentences: Sequence[str], remedies: Sequence[str] = (), *, warns: bool = True
    ) -> None:
        """Say why the record is not there and what to do; nothing where all is well.

        Parameters
        ----------
        remedies
            Actions that may help, each a button below the sentences.
        """
        self.message.setObjectName("warning" if warns else "quiet")
        self.message.style().polish(self.message)  # the style sheet depends on the name
        self.message.say_all(sentences)
        for action, button in self.remedies.items():
            button.setVisible(action in remedies)

    def show_reminder(self, sentence: str) -> None:
        """Remind quietly of something to be done by and by; an empty sentence hides it."""
        self.reminder.setText(sentence)
        for part in (self.reminder, self.back_up, self.put_off):
            part.setVisible(bool(sentence))

    def show_usable(self, usable: bool, *, why_not_add: str) -> None:
        """Show whether patients can be looked for, and why none can be added, if so.

        Files can always be opened.
        """
        self._of_record.setEnabled(usable)
        allow(self.new_patient, why_not_add)

    def show_recent_files(self, files: Sequence[tuple[str, str]]) -> None:
        """Offer the files opened last, each as path and name."""
        buttons = []
        for path, name in files:
            button = QPushButton(name.replace("&", "&&"))
            button.setObjectName("row")
            button.setFlat(True)
            button.setToolTip(path)
            button.setProperty("path", path)
            button.clicked.connect(self._choose_file)
            buttons.append(button)
        self._recent_row.show_parts(buttons)

    def begin(self) -> None:
        """Empty the search line and give it the focus."""
        self.search.clear()
        self.search.setFocus(Qt.FocusReason.OtherFocusReason)

    def changeEvent(self, event: QEvent) -> None:
        """Redraw the icons in the theme's colours."""
        if event.type() == QEvent.Type.PaletteChange:
            for key, button in self._files.items():
                button.setIcon(icon(key))
        super().changeEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let the arrows go from the search line to the list, and Enter open its first row."""
        if watched is self.search and event.type() == QEvent.Type.KeyPress:
            key = cast("QKeyEvent", event).key()
            if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                if self.found.rows and self.search.text().strip():
                    self.person_chosen.emit(self.found.rows[0].key)
                return True
            if key == Qt.Key.Key_Down and self.found.take_first():
                self.found.setFocus(Qt.FocusReason.OtherFocusReason)
                return True
            if key == Qt.Key.Key_Escape and self.search.text():
                self.search.clear()
                return True
        return super().eventFilter(watched, event)

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self.search, 1)
        top.addWidget(self.new_patient)
        top.addWidget(self._button("", tr("Orders"), "orders"))
        grid = QGridLayout()
        grid.setHorizontalSpacing(24)
        grid.setVerticalSpacing(4)
        grid.addWidget(self._found_title, 0, 0)
        grid.addWidget(self.found, 1, 0, 3, 1)
        grid.addWidget(self._nothing, 4, 0)
        grid.addWidget(self.more, 5, 0, Qt.AlignmentFlag.AlignLeft)
        grid.addWidget(_heading(tr("Today's visits")), 0, 1)
        grid.addWidget(self.today, 1, 1)
        grid.addWidget(_heading(tr("Open orders")), 2, 1)
        grid.addWidget(self.orders, 3, 1)
        grid.setColumnStretch(0, 5)
        grid.setColumnStretch(1, 4)
        grid.setRowStretch(1, 2)
        grid.setRowStretch(3, 3)
        inner = QVBoxLayout(self._of_record)
        inner.setContentsMargins(0, 0, 0, 0)
        inner.setSpacing(16)
        inner.addLayout(top)
        inner.addLayout(grid, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(20, 16, 20, 16)
        layout.setSpacing(8)
        layout.addWidget(self.message)
        layout.addWidget(self._remedy_row())
        layout.addWidget(self._of_record, 1)
        layout.addLayout(self._heading_of_files())
        layout.addWidget(self._file_row())
        layout.addWidget(self._recent_row)

    def _remedy_row(self) -> FlowRow:
        for action, text in (
            ("lock", tr("Sign in…")),
            ("accounts", tr("Accounts…")),
            ("audit_log", tr("Audit log…")),
            ("retry_record", tr("Open the record again")),
            ("restore_record", tr("Restore from a backup…")),
            ("record_place", tr("Where the record is…")),
        ):
            self.remedies[action] = button = self._button("", text, action)
            button.hide()
        return FlowRow(*self.remedies.values())

    def _heading_of_files(self) -> QHBoxLayout:
        """Return the heading, beside which the reminder has its room: nothing moves as it comes."""
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(_heading(tr("Without a patient, or from files")), 1)
        for part in (self.reminder, self.back_up, self.put_off):
            keep_room(part)
            part.hide()
            row.addWidget(part)
        return row

    def _file_row(self) -> FlowRow:
        for key, text, action in (
            ("capture", tr("Capture…"), "capture"),
            ("open", tr("Open case…"), "open"),
            ("session", tr("Open session…"), "open_session"),
            ("mesh", tr("Import a scan…"), "open_archive"),
            ("device", tr("Open the example"), "open_example"),
        ):
            self._files[key] = self._button(key, text, action)
        return FlowRow(
            *self._files.values(),
            self._button("", tr("Calibrate sensors…"), "calibrate"),
            self._button("", tr("Restore from a backup…"), "restore_record"),
            gap_px=4,
        )

    def _button(self, icon_name: str, text: str, action: str) -> QPushButton:
        button = QPushButton(text)
        if icon_name:
            button.setIcon(icon(icon_name))
        button.setProperty("action", action)
        button.clicked.connect(self._request)
        return button

    def _request(self) -> None:
        self.action_requested.emit(self.sender().property("action"))

    def _choose_file(self) -> None:
        self.recent_file_chosen.emit(self.sender().property("path"))


def _heading(text: str) -> QLabel:
    heading = ElidedLabel(text)
    heading.setObjectName("heading")
    return heading
