"""The colours of a map with their numbers in mm."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QLinearGradient, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

BAR_PX = 140
NUMBER_PX = 72


class Legend(QWidget):
    """A strip of colour between its least and its greatest number."""

    def __init__(self, colors: Sequence[str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colors = colors
        self._limits: tuple[float, float] | None = None
        self.setVisible(False)

    def show_limits(self, limits_mm: tuple[float, float] | None) -> None:
        """Show other numbers; None hides the legend."""
        self._limits = limits_mm
        self.setVisible(limits_mm is not None)
        self.update()

    def sizeHint(self) -> QSize:
        """Room for the strip and two numbers."""
        return QSize(BAR_PX + 2 * NUMBER_PX, 22)

    def minimumSizeHint(self) -> QSize:
        """The same: it does not shrink."""
        return self.sizeHint()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw number, strip, number."""
        if self._limits is None:
            return
        painter = QPainter(self)
        strip = QRectF(NUMBER_PX, 5, BAR_PX, self.height() - 10)
        gradient = QLinearGradient(strip.topLeft(), strip.topRight())
        for number, color in enumerate(self._colors):
            gradient.setColorAt(number / (len(self._colors) - 1), QColor(color))
        painter.fillRect(strip, gradient)
        low, high = (f"{limit:.1f}" for limit in self._limits)
        left = QRectF(0, 0, NUMBER_PX - 6, self.height())
        right = QRectF(strip.right() + 6, 0, NUMBER_PX, self.height())
        vertical = Qt.AlignmentFlag.AlignVCenter
        painter.drawText(left, vertical | Qt.AlignmentFlag.AlignRight, low)
        painter.drawText(right, vertical | Qt.AlignmentFlag.AlignLeft, f"{high} mm")
        painter.end()
