"""Moves of the pointer: none is lost, though fewer are handled than come in while a view draws."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, QObject, Qt, QTimer
from PySide6.QtGui import QMouseEvent


class PointerMoves(QObject):
    """Hands over the moves that came in while others were handled, all at once.

    Parameters
    ----------
    handle
        Receives one or more moves, the oldest first.
    """

    def __init__(self, handle: Callable[[list[QMouseEvent]], None], parent: QObject) -> None:
        super().__init__(parent)
        self._handle = handle
        self._waiting: list[QMouseEvent] = []
        self._turn = QTimer(self)
        """Ends when the events that have come in are handled, before anything is drawn."""
        self._turn.setSingleShot(True)
        self._turn.setInterval(0)
        self._turn.timeout.connect(self.hand_over)

    def take(self, event: QMouseEvent) -> None:
        """Handle a move at once; those that follow before the next turn of the events wait."""
        self._waiting.append(event.clone())
        if not self._turn.isActive():
            self.hand_over()

    def hand_over(self) -> None:
        """Handle what waits; the order of moves and other events is kept by calling this first."""
        if self._waiting:
            waiting, self._waiting = self._waiting, []
            self._turn.start()
            self._handle(waiting)


def keep_every_move(on: bool) -> None:
    """Let Qt report every move of the pointer, not only the newest of those that wait.

    Where Qt leaves some out (X11), a line that is drawn fast loses its way.
    """
    attribute = Qt.ApplicationAttribute.AA_CompressHighFrequencyEvents
    QCoreApplication.setAttribute(attribute, not on)
