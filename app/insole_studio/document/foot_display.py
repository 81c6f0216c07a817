"""Prepares the surface of the active foot for display, in the background."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from insole_core.foot.display_surface import DisplaySurface
from insole_core.foot.foot import DISPLAY, Foot
from insole_core.geometry.transforms import inverse
from insole_core.progress import Progress
from insole_studio.document.case import Case
from insole_studio.jobs import Jobs

CHANNEL = "foot-display"


class FootDisplay(QObject):
    """Keeps the evened surface of the active foot; a foot in another pose keeps its surface."""

    changed = Signal()
    """The surface of the active foot is ready."""

    def __init__(self, case: Case, jobs: Jobs, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._last: Foot | None = None
        case.closing.connect(self._forget)
        case.foot_changed.connect(self._refresh)

    @property
    def surface(self) -> DisplaySurface | None:
        """Return the surface of the active foot; None while it is being computed."""
        return None if self._case.foot is None else known_display(self._case.foot)

    def _forget(self) -> None:
        self._jobs.cancel(CHANNEL)
        self._last = None

    def _refresh(self) -> None:
        self._jobs.cancel(CHANNEL)
        foot, last = self._case.foot, self._last
        self._last = foot
        if foot is None or known_display(foot) is not None:
            return
        before = None if last is None else known_display(last)
        if last is not None and before is not None and _is_same_scan(foot, last):
            step = foot.source2insole @ inverse(last.source2insole)
            moved = before.transformed(step)
            foot.derived.get(DISPLAY, (), lambda: moved)
            return
        self._compute(foot)

    def _compute(self, foot: Foot) -> None:
        def compute(_progress: Progress) -> DisplaySurface:
            return foot.display_surface()

        def take(_surface: DisplaySurface) -> None:
            self.changed.emit()

        def fail(error: Exception) -> None:
            raise error

        self._jobs.start(CHANNEL, compute, take, fail)


def known_display(foot: Foot) -> DisplaySurface | None:
    """Return the surface of a foot for display if it was computed before."""
    surface: DisplaySurface | None = foot.derived.known(DISPLAY, ())
    return surface


def _is_same_scan(foot: Foot, other: Foot) -> bool:
    return foot.mesh.triangles is other.mesh.triangles
