"""The list of devices and findings: type to filter, look at what would change, apply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, QSize, Qt, Signal
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.form_parts import plain_button

SIZE_PX = QSize(820, 480)
LIST_PX = 300
_KEY = Qt.ItemDataRole.UserRole
_WRAPPED = (1, 3)
"""Columns of the table of changes whose texts may be long."""


@dataclass(frozen=True)
class ChoiceRow:
    """One row of the list; a row without a key is the heading of those below it."""

    key: str
    text: str
    note: str = ""


@dataclass(frozen=True)
class ChoiceDetails:
    """What is said of the chosen row.

    Parameters
    ----------
    changes
        The values that would change, as label, value before and value after.
    notes
        Further sentences, among them the source.
    may_apply
        Whether there is anything to apply.
    """

    title: str
    changes: tuple[tuple[str, str, str], ...] = ()
    notes: tuple[str, ...] = ()
    may_apply: bool = True


@dataclass(frozen=True)
class MenuEntry:
    """An entry of the menu below the list; one without a key is a line between others."""

    key: str
    text: str
    enabled: bool = True


class DevicesView(QDialog):
    """A list with a search line on the left, the differences of what is chosen on the right."""

    search_edited = Signal(str)
    row_chosen = Signal(str)
    apply_requested = Signal(str)
    entry_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Device or finding"))
        self.search = QLineEdit()
        self.search.setPlaceholderText(tr("Type to search: cup, child, plantar fasciitis"))
        self.search.setAccessibleName(tr("Search devices and findings"))
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self.search_edited)
        self.search.installEventFilter(self)
        self.list = QListWidget()
        self.list.setAccessibleName(tr("Devices and findings"))
        self.list.setSpacing(1)
        self.list.setFixedWidth(LIST_PX)
        self.list.currentItemChanged.connect(self._choose)
        self.list.itemActivated.connect(self._apply_chosen)
        self.details = QWidget()
        self.details.setLayout(QVBoxLayout())
        self._scroll = QScrollArea()
        self._scroll.setWidgetResizable(True)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setWidget(self.details)
        self.more = plain_button(tr("More"))
        self.more.setMenu(QMenu(self.more))
        self.close_button = plain_button(tr("Close"), self.reject)
        self.apply_button = QPushButton(tr("Apply"))
        self.apply_button.setObjectName("primary")
        self.apply_button.setDefault(True)
        self.apply_button.clicked.connect(self._apply_chosen)
        self._lay_out()
        self.resize(SIZE_PX)

    @property
    def chosen(self) -> str:
        """Key of the chosen row; empty if there is none."""
        item = self.list.currentItem()
        return "" if item is None else str(item.data(_KEY))

    def show_rows(self, rows: Sequence[ChoiceRow], chosen: str) -> None:
        """Show the rows; the chosen one, or else the first, is selected."""
        self.list.blockSignals(True)
        self.list.clear()
        for row in rows:
            self.list.addItem(_item(row))
        items = [self.list.item(number) for number in range(self.list.count())]
        keyed = [item for item in items if item.data(_KEY)]
        kept = next((item for item in keyed if item.data(_KEY) == chosen), None)
        if keyed:
            self.list.setCurrentItem(kept or keyed[0])
            self.list.scrollToItem(kept or keyed[0])
        self.list.blockSignals(False)
        self.row_chosen.emit(self.chosen)

    def show_details(self, details: ChoiceDetails) -> None:
        """Show what would change."""
        fresh = QWidget()
        column = QVBoxLayout(fresh)
        column.setContentsMargins(16, 12, 16, 12)
        column.setSpacing(8)
        title = _label(details.title, "numbers")
        column.addWidget(title)
        if details.changes:
            column.addLayout(_changes(details.changes))
        for note in details.notes:
            column.addWidget(_label(note, "quiet"))
        column.addStretch(1)
        self._scroll.setWidget(fresh)
        self.details = fresh
        self.apply_button.setEnabled(details.may_apply)

    def show_entries(self, entries: Sequence[MenuEntry]) -> None:
        """Fill the menu below the list."""
        menu = self.more.menu()
        menu.clear()
        for entry in entries:
            if not entry.key:
                menu.addSeparator()
                continue
            action = menu.addAction(entry.text)
            action.setData(entry.key)
            action.setEnabled(entry.enabled)
            action.triggered.connect(self._choose_entry)

    def eventFilter(self, watched: QObject, event: object) -> bool:
        """Let the arrows go through the list while one types."""
        if isinstance(event, QKeyEvent) and event.type() == QKeyEvent.Type.KeyPress:
            step = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1}.get(Qt.Key(event.key()))
            if watched is self.search and step is not None:
                self._go(step)
                return True
        return super().eventFilter(watched, event)  # type: ignore[arg-type]

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.setSpacing(8)
        left.addWidget(self.search)
        left.addWidget(self.list, 1)
        upper = QHBoxLayout()
        upper.setSpacing(12)
        upper.addLayout(left)
        upper.addWidget(self._scroll, 1)
        buttons = QHBoxLayout()
        buttons.setSpacing(8)
        buttons.addWidget(self.more)
        buttons.addStretch(1)
        buttons.addWidget(self.close_button)
        buttons.addWidget(self.apply_button)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 12, 12, 12)
        layout.setSpacing(12)
        layout.addLayout(upper, 1)
        layout.addLayout(buttons)

    def _go(self, step: int) -> None:
        """Select the next row that can be chosen."""
        number = self.list.currentRow() + step
        while 0 <= number < self.list.count():
            if self.list.item(number).data(_KEY):
                self.list.setCurrentRow(number)
                return
            number += step

    def _choose(self) -> None:
        self.row_chosen.emit(self.chosen)

    def _choose_entry(self) -> None:
        action = self.sender()
        assert action is not None
        self.entry_chosen.emit(action.data())  # type: ignore[attr-defined]

    def _apply_chosen(self) -> None:
        if self.chosen and self.apply_button.isEnabled():
            self.apply_requested.emit(self.chosen)


def _item(row: ChoiceRow) -> QListWidgetItem:
    item = QListWidgetItem(row.text)
    item.setData(_KEY, row.key)
    if not row.key:
        font = item.font()
        font.setBold(True)
        item.setFont(font)
        item.setForeground(QGuiApplication.palette().placeholderText())
        item.setFlags(Qt.ItemFlag.ItemIsEnabled)
    if row.note:
        item.setText(f"{row.text}  ·  {row.note}")
    return item


def _changes(changes: Sequence[tuple[str, str, str]]) -> QGridLayout:
    """Return a table of what changes: label, before, an arrow, after."""
    grid = QGridLayout()
    grid.setHorizontalSpacing(12)
    grid.setVerticalSpacing(4)
    for row, (label, before, after) in enumerate(changes):
        texts = ((label, ""), (before, "quiet"), ("→" if before else "", "quiet"), (after, ""))
        for column, (text, name) in enumerate(texts):
            cell = _label(text, name, wraps=column in _WRAPPED)
            grid.addWidget(cell, row, column, Qt.AlignmentFlag.AlignTop)
    for column in _WRAPPED:
        grid.setColumnStretch(column, 1)
    return grid


def _label(text: str, name: str, *, wraps: bool = True) -> QLabel:
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(wraps)
    if name:
        label.setObjectName(name)
    return label
