"""The page shown while there is no content: what comes next, and buttons that offer it."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from insole_studio.widgets.layouts import FlowRow


class EmptyPage(QWidget):
    """One sentence, and a row of buttons."""

    chosen = Signal(str)
    """Emitted with the key of a button."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = QLabel()
        self._sentence.setWordWrap(True)
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._offers = FlowRow(is_centred=True)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 24, 24, 24)
        layout.addStretch(1)
        layout.addWidget(self._sentence)
        layout.addSpacing(8)
        layout.addWidget(self._offers)
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
        buttons = []
        for number, (key, text) in enumerate(offers.items()):
            button = QPushButton(text)
            button.setDefault(number == 0)
            button.setProperty("offer", key)
            button.clicked.connect(self._choose)
            buttons.append(button)
        self._offers.show_parts(buttons)

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("offer"))
