"""Cards side by side, as many to a row as fit; the rows scroll where they are too high."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QScrollArea, QWidget

_GAP_PX = 8


class CardGrid(QScrollArea):
    """Cards of equal width, in rows of equal length as far as possible."""

    wrapped = Signal(bool)
    """Whether the cards need more than one row by now."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self._cards: list[QWidget] = []
        self._columns = 0
        self.is_wrapped = False
        self._inner = QWidget()
        self._layout = QGridLayout(self._inner)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(_GAP_PX)
        self.setWidget(self._inner)

    def show_cards(self, cards: Sequence[QWidget]) -> None:
        """Show these cards in this order; those that are no longer there are taken out."""
        if list(cards) != self._cards:
            for card in self._cards:
                self._layout.removeWidget(card)
            self._cards = list(cards)
            self._place()

    def minimumSizeHint(self) -> QSize:
        """Return the size of one card: the rest can be scrolled to."""
        size = QSize(0, 0)
        for card in self._cards:
            size = size.expandedTo(card.minimumSizeHint())
        return size.grownBy(self._layout.contentsMargins())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap anew."""
        super().resizeEvent(event)
        if self._columns_that_fit() != self._columns:
            self._place()

    def _columns_that_fit(self) -> int:
        count = len(self._cards)
        if not count:
            return 0
        least_px = max(card.minimumSizeHint().width() for card in self._cards) + _GAP_PX
        most = max(1, (self.width() + _GAP_PX) // least_px)
        return ceil(count / ceil(count / most))

    def _place(self) -> None:
        for column in range(self._columns):
            self._layout.setColumnStretch(column, 0)
        self._columns = self._columns_that_fit()
        for place, card in enumerate(self._cards):
            self._layout.addWidget(card, *divmod(place, self._columns))
        for column in range(self._columns):
            self._layout.setColumnStretch(column, 1)
        if self.is_wrapped != (self._columns < len(self._cards)):
            self.is_wrapped = not self.is_wrapped
            self.wrapped.emit(self.is_wrapped)
