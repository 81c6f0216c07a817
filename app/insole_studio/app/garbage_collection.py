"""Collects Python's cyclic garbage between the events of the window."""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

INTERVAL_MS = 1000


class GarbageCollection(QObject):
    """Collects from a timer of the window's thread, and nowhere else.

    By itself Python collects wherever an object happens to be made: in a background thread, or
    within Qt while it hands over an event. Either may destroy Qt objects of another thread or in
    the midst of their use, which ends the process. The generations are those of Python.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        timer = QTimer(self)
        timer.timeout.connect(collect_due)
        timer.start(INTERVAL_MS)


def collect_due() -> None:
    """Collect the oldest generation of which as much has come together as Python waits for."""
    for generation in (2, 1, 0):
        if gc.get_count()[generation] > gc.get_threshold()[generation]:
            gc.collect(generation)
            return
