"""A layout that places widgets in a row and wraps to the next line."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QMargins, QPoint, QRect, QSize
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget

from insole_studio.widgets.emptied import remove_widgets


class FlowLayout(QLayout):
    """Lays items out like text: left to right, then down; too wide an item gets its own line.

    Parameters
    ----------
    is_centred
        Whether each line stands in the middle; by default at the left.
    """

    def __init__(
        self, parent: QWidget, margin_px: int, gap_px: int, *, is_centred: bool = False
    ) -> None:
        super().__init__(parent)
        self._items: list[QLayoutItem] = []
        self._gap_px = gap_px
        self._is_centred = is_centred
        self.setContentsMargins(QMargins(margin_px, margin_px, margin_px, margin_px))

    def addItem(self, item: QLayoutItem) -> None:
        """Append an item."""
        self._items.append(item)

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:
        """Return an item; None beyond the end."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:
        """Remove and return an item; None beyond the end."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def hasHeightForWidth(self) -> bool:
        """Return True: a narrower layout needs more lines."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines at this width."""
        return self._flow(QRect(0, 0, width, 0), place=False)

    def sizeHint(self) -> QSize:
        """Return the minimum size: the layout takes the space that there is."""
        return self.minimumSize()

    def minimumSize(self) -> QSize:
        """Return the size of the largest item."""
        size = QSize()
        for item in self._items:
            size = size.expandedTo(item.minimumSize())
        return size.grownBy(self.contentsMargins())

    def setGeometry(self, rect: QRect) -> None:
        """Place all items."""
        super().setGeometry(rect)
        self._flow(rect, place=True)

    def _flow(self, rect: QRect, place: bool) -> int:
        margins = self.contentsMargins()
        inner = rect.marginsRemoved(margins)
        y, lines = inner.top(), self._lines(inner.width())
        for line in lines:
            used_px = sum(size.width() for _, size in line) + self._gap_px * (len(line) - 1)
            x = inner.left() + ((inner.width() - used_px) // 2 if self._is_centred else 0)
            for item, size in line:
                if place:
                    item.setGeometry(QRect(QPoint(x, y), size))
                x += size.width() + self._gap_px
            y += max(size.height() for _, size in line) + self._gap_px
        return y - (self._gap_px if lines else 0) + margins.bottom() - rect.top()

    def _lines(self, width_px: int) -> list[list[tuple[QLayoutItem, QSize]]]:
        """Return the items of each line, with their sizes."""
        lines: list[list[tuple[QLayoutItem, QSize]]] = []
        x = 0
        for item in self._items:
            if item.isEmpty():  # hidden
                continue
            size = item.sizeHint()
            if size.width() > width_px:
                wraps = item.hasHeightForWidth()
                height = item.heightForWidth(width_px) if wraps else size.height()
                size = QSize(width_px, height)
            if not lines or x + size.width() > width_px:
                lines.append([])
                x = 0
            lines[-1].append((item, size))
            x += size.width() + self._gap_px
        return lines


class FlowRow(QWidget):
    """A row of widgets that wraps where there is no room for all of them."""

    def __init__(self, *parts: QWidget, gap_px: int = 8, is_centred: bool = False) -> None:
        super().__init__()
        self._layout = FlowLayout(self, 0, gap_px, is_centred=is_centred)
        self.show_parts(parts)

    def show_parts(self, parts: Iterable[QWidget]) -> None:
        """Show widgets in place of those before, which go."""
        remove_widgets(self._layout)
        for part in parts:
            self._layout.addWidget(part)
