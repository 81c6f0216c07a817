"""The table of views and of how well each is registered."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import (
    QMargins,
    QModelIndex,
    QPersistentModelIndex,
    QSignalBlocker,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from insole_studio.features.foot.rows import ViewRow
from insole_studio.texts import localised, tr, with_capital
from insole_studio.view_names import view_text

_NAME = Qt.ItemDataRole.UserRole
_CHIP_PX = 12
_TICK_PX = 8
_ROW_PX = 26
_MOST_LINES = 5


class ViewTable(QTableWidget):
    """One row per view; its tick decides whether the view is used."""

    view_chosen = Signal(str)
    view_switched = Signal(str, bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        columns = _columns()
        self.setColumnCount(len(columns))
        self.setHorizontalHeaderLabels([title for title, _tip, _text in columns])
        for number, (_title, tip, _text) in enumerate(columns):
            item = self.horizontalHeaderItem(number)
            if item is not None:
                item.setToolTip(tip)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_PX)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        # An empty box would be invisible in the dark theme.
        self.setStyleSheet("QTableView::indicator:unchecked { border: 1px solid palette(text); }")
        self.setItemDelegateForColumn(0, _TickedDelegate(self))
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(len(columns) - 1, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        self.currentCellChanged.connect(self._choose)
        self.itemChanged.connect(self._switch)

    def show_rows(self, rows: Sequence[ViewRow], selected: str) -> None:
        """Replace the rows."""
        with QSignalBlocker(self):
            self.setRowCount(len(rows))
            for number, row in enumerate(rows):
                self._show_row(number, row)
                if row.name == selected:
                    self.setCurrentCell(number, max(self.currentColumn(), 0))
        lines = min(max(len(rows), 2), _MOST_LINES)
        self.setFixedHeight(self.horizontalHeader().sizeHint().height() + lines * _ROW_PX + 4)

    def _show_row(self, number: int, row: ViewRow) -> None:
        for column, (_title, _tip, text) in enumerate(_columns()):
            item = QTableWidgetItem(text(row))
            if 0 < column < len(_columns()) - 1:
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            item.setToolTip(text(row))
            if not row.is_used:
                item.setForeground(self.palette().placeholderText())
            self.setItem(number, column, item)
        first = self.item(number, 0)
        if first is not None:
            first.setCheckState(Qt.CheckState.Checked if row.on else Qt.CheckState.Unchecked)
            first.setIcon(_chip(row.color))
            first.setData(_NAME, row.name)

    def _choose(self, row: int, *_others: int) -> None:
        item = self.item(row, 0)
        if item is not None:
            self.view_chosen.emit(item.data(_NAME))

    def _switch(self, item: QTableWidgetItem) -> None:
        if item.column() == 0:
            on = item.checkState() is Qt.CheckState.Checked
            self.view_switched.emit(item.data(_NAME), on)


class _TickedDelegate(QStyledItemDelegate):
    """Makes room for a tick of the theme, which Qt takes for one of the usual size."""

    def sizeHint(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QSize:
        """Return a size that cuts no name off."""
        return super().sizeHint(option, index).grownBy(QMargins(0, 0, _TICK_PX, 0))


def _columns() -> tuple[tuple[str, str, Callable[[ViewRow], str]], ...]:
    """Return heading, explanation and cell text of every column."""
    return (
        (tr("View"), tr("Tick: the view is used"), lambda row: view_text(row.name)),
        (
            tr("Markers"),
            tr("Markers that determine the pose, of those that were found"),
            lambda row: f"{row.used} / {row.found}",
        ),
        (
            tr("Image, px"),
            tr("Distance in the colour image from where the pose puts them, root mean square"),
            lambda row: _number(row.reprojection_px, 2),
        ),
        (
            tr("Mean, mm"),
            tr("Distance of the markers in space from the reference system, mean"),
            lambda row: _number(row.residual_mm and row.residual_mm[0], 1),
        ),
        (
            tr("RMS, mm"),
            tr("Distance of the markers in space from the reference system, root mean square"),
            lambda row: _number(row.residual_mm and row.residual_mm[1], 1),
        ),
        (
            tr("Max, mm"),
            tr("Distance of the markers in space from the reference system, the greatest"),
            lambda row: _number(row.residual_mm and row.residual_mm[2], 1),
        ),
        (
            tr("At foot, mm"),
            tr("How uncertain the pose leaves the place of the foot (standard deviation)"),
            lambda row: f"± {localised(row.displacement_mm)}" if row.displacement_mm else "–",
        ),
        (
            tr("Frames"),
            tr("Depth frames that are used, of those that were recorded"),
            lambda row: f"{row.frames - row.left_out} / {row.frames}" if row.frames else "–",
        ),
        (tr("Remarks"), tr("Why a view is not used, or what is to be known of it"), _remark),
    )


def _remark(row: ViewRow) -> str:
    if not row.on:
        return tr("Left out by hand")
    return with_capital(row.trouble) or tr("Good")


def _number(value: float | None, decimals: int) -> str:
    return "–" if value is None else localised(value, f".{decimals}f")


def _chip(color: tuple[int, int, int]) -> QIcon:
    chip = QPixmap(_CHIP_PX, _CHIP_PX)
    chip.fill(QColor("white"))
    painter = QPainter(chip)
    painter.fillRect(1, 1, _CHIP_PX - 2, _CHIP_PX - 2, QColor(*color))
    painter.end()
    icon = QIcon(chip)
    icon.addPixmap(chip, QIcon.Mode.Selected)  # otherwise it is tinted with the selection
    return icon
