"""A text field of a few lines."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QPlainTextEdit

_HEIGHT_PX = 64


class NotesField(QPlainTextEdit):
    """A text field of a few lines; Tab moves the focus."""

    left = Signal()
    """The focus has left the field, whose text may have changed."""

    def __init__(self) -> None:
        super().__init__()
        self.setTabChangesFocus(True)
        self.setFixedHeight(_HEIGHT_PX)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Announce that the text may have changed."""
        super().focusOutEvent(event)
        self.left.emit()
