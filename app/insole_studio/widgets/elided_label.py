"""A one-line text that can be unfolded over several lines."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel

LEAST_PX = 120


class ElidedLabel(QLabel):
    """A label that elides its text if too narrow, and then shows all of it as tooltip."""

    overflowed = Signal(bool)
    """Whether the text does not fit into one line at the current width."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.setMinimumWidth(LEAST_PX)

    @property
    def needed_px(self) -> int:
        """Width of the whole text in one line."""
        return self.fontMetrics().horizontalAdvance(self.text()) + 2

    def unfold(self, unfolded: bool) -> None:
        """Show the whole text over several lines, or one elided line."""
        self.setWordWrap(unfolded)
        self.updateGeometry()
        self.update()

    def setText(self, text: str) -> None:
        """Show another text."""
        super().setText(text)
        self._note_room()

    def sizeHint(self) -> QSize:
        """Return the size of one line."""
        return QSize(self.needed_px, super().minimumSizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """Return a width that fits the beginning of the text."""
        return QSize(LEAST_PX, self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Emit whether the text fits."""
        super().resizeEvent(event)
        self._note_room()

    def _note_room(self) -> None:
        too_long = self.width() < self.needed_px
        self.setToolTip(self.text() if too_long else "")
        self.overflowed.emit(too_long)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the elided line or the whole text."""
        if self.wordWrap():
            super().paintEvent(event)
            return
        shown = self.fontMetrics().elidedText(
            self.text(), Qt.TextElideMode.ElideRight, self.width()
        )
        painter = QPainter(self)
        line = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        self.style().drawItemText(
            painter,
            self.rect(),
            line,
            self.palette(),
            self.isEnabled(),
            shown,
            self.foregroundRole(),
        )
        painter.end()
