"""What is done between the events of the window: modules are loaded, garbage is collected."""

from __future__ import annotations

import gc
from importlib import import_module

from PySide6.QtCore import QObject, QTimer

from insole_studio.native_heap import return_freed_memory

INTERVAL_MS = 1000
MODULES = (
    "scipy.spatial",
    "scipy.ndimage",
    "scipy.interpolate",
    "scipy.sparse.linalg",
    "scipy.sparse.csgraph",
    "matplotlib.pyplot",
    "pyvista",
    "pyvista.plotting",
    "pyvistaqt",
    "insole_studio.features.foot.stage",
    "insole_studio.scene.painter",
)
"""In parts of less than half a second: between two of them the window answers."""
PAUSE_MS = 50


class GarbageCollection(QObject):
    """Collects from a timer of the window's thread, and nowhere else.

    By itself Python collects wherever an object happens to be made: in a background thread, or
    within Qt while it hands over an event or a list of its widgets. Either may destroy Qt objects
    of another thread or in the midst of their use, which ends the process. The generations are
    those of Python, but for what a case leaves: a closed stage is a cycle that holds a foot, and
    the oldest generation would keep as many feet as are opened within minutes.
    """

    def __init__(self) -> None:
        super().__init__()
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


class Preload(QObject):
    """Imports one module after the other between the events of the window.

    Not in a thread: two threads that import packages with circular imports may find them half made.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._left = list(MODULES)
        self._timer = QTimer(self)
        self._timer.setInterval(PAUSE_MS)
        self._timer.timeout.connect(self._import_next)
        self._timer.start()

    def _import_next(self) -> None:
        import_module(self._left.pop(0))
        if not self._left:
            self._timer.stop()
