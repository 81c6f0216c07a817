"""A bubble beside a field that explains why its input was rejected."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtWidgets import QLabel, QWidget

SHOWN_MS = 8000
WIDTH_PX = 260
GAP_PX = 4


class ValidationBubble(QLabel):
    """A bubble above its field, or below if there is no space; hides after a while.

    It is a window of its own: a native 3-D view would cover any widget of the same window.
    """

    def __init__(self, field: QWidget) -> None:
        super().__init__(field, Qt.WindowType.ToolTip)
        self.setObjectName("warning")
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setWordWrap(True)
        self.setFixedWidth(WIDTH_PX)
        self._field = field
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(SHOWN_MS)
        self._timer.timeout.connect(self.hide)

    def say(self, sentence: str) -> None:
        """Show a sentence beside the field if the field is visible."""
        if not self._field.isVisible():
            return
        self.setText(sentence)
        self.adjustSize()
        self.move(self._beside())
        self.show()
        self._timer.start()

    def _beside(self) -> QPoint:
        field, window = self._field, self._field.window()
        there = field.mapToGlobal(QPoint(0, 0))
        right = window.mapToGlobal(QPoint(window.width() - self.width(), 0)).x()
        above = there.y() - self.height() - GAP_PX
        fits = above >= window.mapToGlobal(QPoint(0, 0)).y()
        y = above if fits else there.y() + field.height() + GAP_PX
        return QPoint(min(there.x(), right), y)
