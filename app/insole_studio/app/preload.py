"""Loads what the first foot needs, once the window is there and while nobody waits for it."""

from __future__ import annotations

from importlib import import_module

from PySide6.QtCore import QObject, QTimer

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
