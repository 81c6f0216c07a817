"""The page shown while there is no content: what comes next, and buttons that offer it."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget


class EmptyPage(QWidget):
    """One sentence, and a row of buttons."""

    chosen = Signal(str)
    """Emitted with the key of a button."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = QLabel()
        self._sentence.setWordWrap(True)
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._offers = QHBoxLayout()
        self._offers.setSpacing(8)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 24, 24, 24)
        layout.addStretch(1)
        layout.addWidget(self._sentence)
        layout.addSpacing(8)
        layout.addLayout(self._offers)
        layout.addSpacing(16)
        layout.addStretch(2)

    def show_offers(self, sentence: str, offers: dict[str, str]) -> None:
        """Show what comes next.

        Parameters
        ----------
        sentence
            What to do next.
        offers
            Button texts by key; the first is the default.
        """
        self._sentence.setText(sentence)
        while (item := self._offers.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        self._offers.addStretch()
        for number, (key, text) in enumerate(offers.items()):
            button = QPushButton(text)
            button.setDefault(number == 0)
            button.setProperty("offer", key)
            button.clicked.connect(self._choose)
            self._offers.addWidget(button)
        self._offers.addStretch()

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("offer"))
