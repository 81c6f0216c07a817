"""Collects Python's cyclic garbage between the events of the window."""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

from insole_studio.native_heap import return_freed_memory

INTERVAL_MS = 1000


class GarbageCollection(QObject):
    """Collects from a timer of the window's thread, and nowhere else.

    By itself Python collects wherever an object happens to be made: in a background thread, or
    within Qt while it hands over an event. Either may destroy Qt objects of another thread or in
    the midst of their use, which ends the process. The generations are those of Python, but for
    what a case leaves: a closed stage is a cycle that holds a foot, and the oldest generation would
    keep as many feet as are opened within minutes.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._is_case_left = False
        timer = QTimer(self)
        timer.timeout.connect(self._collect)
        timer.start(INTERVAL_MS)

    def leave_case(self) -> None:
        """Collect soon all that the case before has left."""
        self._is_case_left = True

    def _collect(self) -> None:
        if not self._is_case_left:
            collect_due()
            return
        self._is_case_left = False
        gc.collect()
        return_freed_memory()


def collect_due() -> None:
    """Collect the oldest generation of which as much has come together as Python waits for."""
    for generation in (2, 1, 0):
        if gc.get_count()[generation] > gc.get_threshold()[generation]:
            gc.collect(generation)
            return
