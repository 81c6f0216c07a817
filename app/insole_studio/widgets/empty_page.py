"""The page shown while there is no content: what comes next, and buttons that offer it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.icons import icon

_LIST_PX = 520
"""Greatest width of the list."""


@dataclass(frozen=True)
class ListedRow:
    """One row of the list: its key, the name of its icon, its text, and what to add to it."""

    key: str
    icon: str
    text: str
    detail: str


class EmptyPage(QWidget):
    """One sentence, a row of buttons, and a list; both signals carry a key."""

    chosen = Signal(str)
    listed_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sentence = QLabel()
        self._sentence.setWordWrap(True)
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._offers = QHBoxLayout()
        self._offers.setSpacing(8)
        self._list = QWidget()
        self._list.setMaximumWidth(_LIST_PX)
        self._grid = QGridLayout(self._list)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(2)
        self._grid.setColumnStretch(1, 1)
        self._list.hide()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(24, 24, 24, 24)
        layout.addStretch(1)
        layout.addWidget(self._sentence)
        layout.addSpacing(8)
        layout.addLayout(self._offers)
        layout.addSpacing(16)
        centred = QHBoxLayout()
        centred.addStretch(1)
        centred.addWidget(self._list, 8)
        centred.addStretch(1)
        layout.addLayout(centred)
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

    def show_list(self, title: str, rows: Sequence[ListedRow]) -> None:
        """Show a list below the buttons; no rows hide it."""
        while (item := self._grid.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        heading = QLabel(title)
        heading.setObjectName("heading")
        self._grid.addWidget(heading, 0, 0, 1, 2)
        for number, row in enumerate(rows, start=1):
            self._grid.addWidget(self._row_button(row), number, 0)
            detail = ElidedLabel(row.detail)
            detail.setObjectName("quiet")
            self._grid.addWidget(detail, number, 1)
        self._list.setVisible(bool(rows))

    def _row_button(self, row: ListedRow) -> QPushButton:
        button = QPushButton(icon(row.icon), row.text.replace("&", "&&"))
        button.setObjectName("row")
        button.setFlat(True)
        button.setProperty("row", row.key)
        button.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        button.clicked.connect(self._choose_listed)
        return button

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("offer"))

    def _choose_listed(self) -> None:
        self.listed_chosen.emit(self.sender().property("row"))
