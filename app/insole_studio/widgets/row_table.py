"""A table of rows to choose one from, by mouse or keyboard."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import (
    QAbstractTableModel,
    QCollator,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    Signal,
)
from PySide6.QtGui import QBrush, QColor, QFont, QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

_WARNING = QColor("#b3261e")
_WARNING_ON_DARK = QColor("#ff9a8f")
_DARK_BELOW = 128
_MOST_DIGITS = 20
_MEASURED_ROWS = 200
"""By which the widths of columns are chosen, of however many."""


@dataclass(frozen=True)
class TableRow:
    """One row: its key, the text of each column, and whether it needs attention.

    Parameters
    ----------
    tip
        What more there is to say of it; empty for nothing.
    """

    key: str
    cells: tuple[str, ...]
    attention: bool = False
    tip: str = ""


@dataclass(frozen=True)
class Sorting:
    """By which column a table is sorted."""

    column: int
    is_descending: bool = False

    @property
    def order(self) -> Qt.SortOrder:
        """As Qt calls it."""
        order = Qt.SortOrder
        return order.DescendingOrder if self.is_descending else order.AscendingOrder


class RowTable(QTableView):
    """A table whose rows are chosen by a double click or Enter; texts are shown as they are.

    A click on a heading sorts by it, a second one the other way round, a third one not any more.
    Whoever shows a part of many rows sorts them where they come from (`sort_chosen`), and shows
    more of them once the end is in sight (`end_reached`).
    """

    chosen = Signal(str)
    """The key of the row that was chosen."""
    current_changed = Signal(str)
    """The key of the row that the cursor is on; empty if it is on none."""
    sort_chosen = Signal(object)
    """Emitted with a `Sorting`, or None for the order in which the rows come by themselves."""
    end_reached = Signal()
    """The last row is in sight."""

    def __init__(
        self,
        headings: Sequence[str],
        stretched: int = 0,
        parent: QWidget | None = None,
        *,
        sorts: bool = True,
    ) -> None:
        """Make an empty table.

        Parameters
        ----------
        stretched
            Number of the column that takes the space which the others leave.
        sorts
            Whether it sorts its rows; otherwise they come as they are to be shown.
        """
        super().__init__(parent)
        self._sorts = sorts
        self.setObjectName("rows")
        self._rows = _Rows(headings, self)
        self.setModel(self._rows)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setShowGrid(False)
        self.setTabKeyNavigation(False)
        self.setWordWrap(False)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionsClickable(True)
        header.sectionClicked.connect(self._sort_by)
        self._given: tuple[TableRow, ...] = ()
        """The rows in the order in which they came."""
        self._sorted_by: Sorting | None = None
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        for column in range(len(headings)):
            mode = QHeaderView.ResizeMode
            kind = mode.Stretch if column == stretched else mode.ResizeToContents
            header.setSectionResizeMode(column, kind)
        header.setResizeContentsPrecision(_MEASURED_ROWS)
        self.verticalScrollBar().valueChanged.connect(self._look_for_end)
        self.doubleClicked.connect(self._choose)
        self.selectionModel().currentRowChanged.connect(self._announce)

    @property
    def rows(self) -> tuple[TableRow, ...]:
        """The rows that are shown."""
        return self._rows.rows

    @property
    def current_key(self) -> str:
        """The key of the row that the cursor is on; empty if it is on none."""
        number = self.currentIndex().row()
        return self._rows.rows[number].key if number >= 0 else ""

    def show_headings(self, headings: Sequence[str], tips: Sequence[str] = ()) -> None:
        """Show other headings; a column without one is hidden.

        Parameters
        ----------
        tips
            What more there is to say of each; empty for nothing.
        """
        self._rows.name_columns(headings, tips)
        for column, heading in enumerate(headings):
            self.setColumnHidden(column, not heading)

    def show_rows(self, rows: Sequence[TableRow]) -> None:
        """Show rows; the cursor stays on the row of the same key, and the table as it is sorted."""
        if tuple(rows) == self._given:
            return
        self._given = tuple(rows)
        self._show_sorted()

    def _sort_by(self, column: int) -> None:
        """Sort by a column: upwards, downwards, or in the order in which the rows came."""
        up, down = Sorting(column), Sorting(column, is_descending=True)
        after: dict[Sorting | None, Sorting | None] = {up: down, down: None}
        self._sorted_by = after.get(self._sorted_by, up)
        header = self.horizontalHeader()
        header.setSortIndicatorShown(self._sorted_by is not None)
        if self._sorted_by is not None:
            header.setSortIndicator(column, self._sorted_by.order)
        self._show_sorted()
        self.sort_chosen.emit(self._sorted_by)

    def _show_sorted(self) -> None:
        before, place = self.current_key, self.verticalScrollBar().value()
        self._rows.replace(self._in_order())
        self.verticalScrollBar().setValue(place)
        keys = [row.key for row in self._rows.rows]
        if before in keys:
            self.selectRow(keys.index(before))
        self._announce()

    def take_first(self) -> bool:
        """Move the cursor to the first row; return whether there is one."""
        if not self._rows.rows:
            return False
        self.selectRow(0)
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose the current row on Enter."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.current_key:
            self.chosen.emit(self.current_key)
        else:
            super().keyPressEvent(event)

    def _in_order(self) -> list[TableRow]:
        """Return the rows as they are sorted; those with an empty cell come last in any case."""
        if self._sorted_by is None or not self._sorts:
            return list(self._given)
        column = self._sorted_by.column
        collator = QCollator()
        full = [row for row in self._given if row.cells[column]]
        full.sort(
            key=lambda row: collator.sortKey(_padded(row.cells[column])),
            reverse=self._sorted_by.is_descending,
        )
        return [*full, *(row for row in self._given if not row.cells[column])]

    def _look_for_end(self, place: int) -> None:
        bar = self.verticalScrollBar()
        if bar.maximum() > 0 and place >= bar.maximum() - bar.pageStep() // 2:
            self.end_reached.emit()

    def _choose(self, index: QModelIndex) -> None:
        self.chosen.emit(self._rows.rows[index.row()].key)

    def _announce(self) -> None:
        self.current_changed.emit(self.current_key)


def _padded(text: str) -> str:
    """Return a text in which numbers sort by their value: 9 before 10, in every locale."""
    return re.sub(r"\d+", lambda digits: digits[0].zfill(_MOST_DIGITS), text.casefold())


_Index = QModelIndex | QPersistentModelIndex
_NOWHERE = QModelIndex()


class _Rows(QAbstractTableModel):
    """The rows as Qt's views ask for them."""

    def __init__(self, headings: Sequence[str], table: QTableView) -> None:
        super().__init__(table)
        self._headings = tuple(headings)
        self._tips: tuple[str, ...] = ()
        self._table = table
        self.rows: tuple[TableRow, ...] = ()

    def replace(self, rows: Sequence[TableRow]) -> None:
        """Show other rows."""
        self.beginResetModel()
        self.rows = tuple(rows)
        self.endResetModel()

    def name_columns(self, headings: Sequence[str], tips: Sequence[str] = ()) -> None:
        """Give the columns other headings, and tips."""
        self._headings, self._tips = tuple(headings), tuple(tips)
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(headings) - 1)

    def rowCount(self, parent: _Index = _NOWHERE) -> int:
        """Return the number of rows."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index = _NOWHERE) -> int:
        """Return the number of columns."""
        return 0 if parent.isValid() else len(self._headings)

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the heading of a column, and what more there is to say of it."""
        if orientation is Qt.Orientation.Horizontal and role == Qt.ItemDataRole.DisplayRole:
            return self._headings[section]
        if orientation is Qt.Orientation.Horizontal and role == Qt.ItemDataRole.ToolTipRole:
            return self._tips[section] or None if self._tips else None
        return None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return text, colour and weight of a cell."""
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.cells[index.column()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return row.tip or None
        if row.attention and role == Qt.ItemDataRole.ForegroundRole:
            is_dark = self._table.palette().base().color().lightness() < _DARK_BELOW
            return QBrush(_WARNING_ON_DARK if is_dark else _WARNING)
        if row.attention and role == Qt.ItemDataRole.FontRole:
            font = QFont(self._table.font())
            font.setBold(True)
            return font
        return None
