"""Moves the section to the pointer, as long as the user wants it."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.pointer import PointerEvent

FRAME_MS = 16
STEP_MM = 0.5


class SectionFollower(QObject):
    """Cuts where the pointer is, once for all its moves within a frame; not during a gesture."""

    def __init__(
        self,
        section: SectionModel,
        tool_controller: ToolController,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._section = section
        self._tool_controller = tool_controller
        self._place_mm: Place = (0.0, 0.0)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(FRAME_MS)
        self._timer.timeout.connect(self._cut)

    def follow(self, on: bool) -> None:
        """Follow the pointer, or leave the section where it is."""
        self.stop()
        self._section.follow(on)

    def point(self, event: PointerEvent) -> None:
        """Take the place under the pointer."""
        if not self._section.follows or event.surface_mm is None or self._tool_controller.is_busy:
            return
        self._place_mm = place_at(event.surface_mm, STEP_MM)
        if not self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Drop the move that waits for the next frame."""
        self._timer.stop()

    def _cut(self) -> None:
        plane = self._section.plane
        turn_deg = 0.0 if plane is None else plane.turn_deg
        self._section.show(SectionPlane(self._place_mm, turn_deg))
