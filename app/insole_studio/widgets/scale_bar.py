"""A scale bar: the length of objects on the screen."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

ROUND_LENGTHS_MM = (1, 2, 5, 10, 20, 50, 100, 200)
LONGEST_PX = 120.0


class ScaleBar(QWidget):
    """The longest round length that fits, drawn to scale."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._mm_per_px = 0.0
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def show_scale(self, mm_per_px: float) -> None:
        """Draw for another scale; 0 hides the bar."""
        self._mm_per_px = mm_per_px
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size for bar and number."""
        return QSize(int(LONGEST_PX) + 64, 22)

    def minimumSizeHint(self) -> QSize:
        """Return the size hint: the bar does not shrink."""
        return self.sizeHint()

    @property
    def length_mm(self) -> int:
        """The drawn length."""
        longest = LONGEST_PX * self._mm_per_px
        fitting = [length for length in ROUND_LENGTHS_MM if length <= longest]
        return fitting[-1] if fitting else ROUND_LENGTHS_MM[0]

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw bar, ends and number."""
        if self._mm_per_px <= 0:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.palette().windowText().color(), 1.5))
        width, middle = self.length_mm / self._mm_per_px, self.height() / 2
        painter.drawLine(QPointF(2, middle), QPointF(2 + width, middle))
        for x in (2.0, 2 + width):
            painter.drawLine(QPointF(x, middle - 4), QPointF(x, middle + 4))
        beside = self.rect().adjusted(round(width) + 10, 0, 0, 0)
        painter.drawText(beside, Qt.AlignmentFlag.AlignVCenter, f"{self.length_mm} mm")
        painter.end()
