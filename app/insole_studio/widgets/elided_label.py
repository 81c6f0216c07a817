"""A text in one line that can be unfolded over several."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel

LEAST_PX = 120


class ElidedLabel(QLabel):
    """Leaves out its end where there is no room; the whole text is its tooltip then."""

    overflowed = Signal(bool)
    """Whether one line at this width is too short."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.setMinimumWidth(LEAST_PX)

    @property
    def needed_px(self) -> int:
        """The width of the whole text in one line."""
        return self.fontMetrics().horizontalAdvance(self.text()) + 2

    def unfold(self, unfolded: bool) -> None:
        """Show all of the text, or one line of it."""
        self.setWordWrap(unfolded)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        """Ask for one line."""
        return QSize(self.needed_px, super().minimumSizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """Be content with the beginning."""
        return QSize(LEAST_PX, self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell whether there is room."""
        super().resizeEvent(event)
        too_long = self.width() < self.needed_px
        self.setToolTip(self.text() if too_long else "")
        self.overflowed.emit(too_long)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the line, or all of them."""
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
