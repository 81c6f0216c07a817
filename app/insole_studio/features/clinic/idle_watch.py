"""Notices that nobody has touched keyboard or mouse for some minutes."""

from __future__ import annotations

import time

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer, Signal

LOOK_EVERY_MS = 5000
_INPUT = frozenset(
    {
        QEvent.Type.KeyPress,
        QEvent.Type.MouseButtonPress,
        QEvent.Type.MouseMove,
        QEvent.Type.Wheel,
        QEvent.Type.TouchBegin,
        QEvent.Type.TouchUpdate,
        QEvent.Type.TabletPress,
        QEvent.Type.TabletMove,
    }
)


class IdleWatch(QObject):
    """Looks at the events of the application while it runs, and costs nothing otherwise."""

    idle = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._most_s = 0.0
        self._monotonic_s = self._clock_s = 0.0
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_EVERY_MS)
        self._timer.timeout.connect(self._look)

    @property
    def is_running(self) -> bool:
        """Whether somebody's time runs."""
        return self._timer.isActive()

    def start(self, most_s: float) -> None:
        """Emit `idle` after so many seconds without input."""
        self.stop()
        self._most_s = most_s
        self._note_input()
        QCoreApplication.instance().installEventFilter(self)  # type: ignore[union-attr]
        self._timer.start()

    def stop(self) -> None:
        """Look no more."""
        if self._timer.isActive():
            self._timer.stop()
            QCoreApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Note input; none is withheld."""
        if event.type() in _INPUT and event.spontaneous():
            self._note_input()
        return False

    def _note_input(self) -> None:
        self._monotonic_s, self._clock_s = time.monotonic(), time.time()

    def _look(self) -> None:
        # The monotonic clock stands still while a computer sleeps, and the other one may jump.
        idle_s = max(time.monotonic() - self._monotonic_s, time.time() - self._clock_s)
        if idle_s >= self._most_s:
            self.stop()
            self.idle.emit()
