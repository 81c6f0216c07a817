"""A button whose text goes on in the next line where it has no room."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QVBoxLayout


class WrappedButton(QPushButton):
    """A flat button of one or more lines; Qt's own has one, and is as wide as that."""

    def __init__(self) -> None:
        super().__init__()
        self._lines = QLabel()
        self._lines.setWordWrap(True)
        self._lines.setTextFormat(Qt.TextFormat.PlainText)
        self._lines.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._room = QVBoxLayout(self)
        self._room.setContentsMargins(6, 4, 6, 4)
        self._room.addWidget(self._lines)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)

    def text(self) -> str:
        """Return what it says."""
        return self._lines.text()

    def setText(self, text: str) -> None:
        """Say something else."""
        self._lines.setText(text)
        self.setAccessibleName(text)
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        """Return the size in one line."""
        line = self._lines.fontMetrics().size(0, self.text())
        return line.grownBy(self._room.contentsMargins())

    def minimumSizeHint(self) -> QSize:
        """Return the size of the longest word."""
        return self._room.totalMinimumSize()
