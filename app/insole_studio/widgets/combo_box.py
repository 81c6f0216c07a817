"""A combo box whose entries have a stored value and a displayed text."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QWidget


class ComboBox(QComboBox):
    """A combo box that shows texts and returns the stored values."""

    edited = Signal(str)
    """Emitted when the user, not the program, chose another value."""

    def __init__(self, options: Sequence[tuple[str, str]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        for word, text in options:
            self.addItem(text, word)
        self.activated.connect(self._pass_on)

    def show_value(self, word: str) -> None:
        """Select a value without emitting `edited`."""
        with QSignalBlocker(self):
            self.setCurrentIndex(self.findData(word))

    def _pass_on(self, number: int) -> None:
        self.edited.emit(self.itemData(number))
