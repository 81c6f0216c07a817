"""A field for one word out of several."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QComboBox, QWidget


class ComboBox(QComboBox):
    """Shows texts, gives words."""

    edited = Signal(str)
    """The user, not the program, chose another word."""

    def __init__(self, options: Sequence[tuple[str, str]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        for word, text in options:
            self.addItem(text, word)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.activated.connect(self._pass_on)

    def show_value(self, word: str) -> None:
        """Show a word without `edited`."""
        with QSignalBlocker(self):
            self.setCurrentIndex(self.findData(word))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Change only what has the focus: a panel is scrolled over it."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

    def _pass_on(self, number: int) -> None:
        self.edited.emit(self.itemData(number))
