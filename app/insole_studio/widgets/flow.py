"""A layout that places widgets in a row and wraps to the next line."""

from __future__ import annotations

from PySide6.QtCore import QMargins, QRect, QSize
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget


class FlowLayout(QLayout):
    """Lays items out like text: left to right, then down; too wide an item gets its own line."""

    def __init__(self, parent: QWidget, margin_px: int, gap_px: int) -> None:
        super().__init__(parent)
        self._items: list[QLayoutItem] = []
        self._gap_px = gap_px
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
        x, y, line_height = rect.left() + margins.left(), rect.top() + margins.top(), 0
        right = rect.left() + rect.width() - margins.right()
        for item in self._items:
            left = rect.left() + margins.left()
            width, height = item.sizeHint().toTuple()
            if line_height and x + width > right:
                x, y, line_height = left, y + line_height + self._gap_px, 0
            if width > right - left:
                width = right - left
                height = item.heightForWidth(width) if item.hasHeightForWidth() else height
            if place:
                item.setGeometry(QRect(x, y, width, height))
            x += width + self._gap_px
            line_height = max(line_height, height)
        return y + line_height + margins.bottom() - rect.top()
