"""Presenter of the section through the insole, which may follow the pointer."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import QObject, QTimer

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.fields import Place
from insole_core.insole.grips import place_at
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.pointer import PointerEvent
from insole_studio.texts import tr

_FRAME_MS = 16
STEP_MM = 0.5


class SectionPanel(Protocol):
    """The section panel as its presenter sees it."""

    def show_sentence(self, sentence: str) -> None: ...  # noqa: D102
    def show_cut(  # noqa: D102
        self,
        top: FloatArray,
        bottom: FloatArray,
        skin: FloatArray,
        ends: tuple[str, str],
        *,
        cover: FloatArray | None,
        at_mm: float | None,
    ) -> None: ...


class SectionPresenter:
    """Cuts the insole again whenever insole or plane change."""

    def __init__(
        self,
        panel: SectionPanel,
        *,
        case: Case,
        surface: InsolePreview,
        section: SectionModel,
        tool_controller: ToolController,
    ) -> None:
        self._panel = panel
        self._case = case
        self._surface = surface
        self._section = section
        self._tool_controller = tool_controller
        tool_controller.tool_changed.connect(self.show)
        surface.changed.connect(self.show)
        section.changed.connect(self.show)
        self.show()

    def show(self) -> None:
        """Show the section, or how to obtain one."""
        plane, side = self._section.plane, self._case.side
        if plane is None or side is None:
            self._panel.show_sentence(self._next_step())
            return
        profile = self._section.profile(self._surface)
        if profile is None:
            self._panel.show_sentence(tr("The section lies beside the insole."))
            return
        self._panel.show_cut(
            profile.top,
            profile.bottom,
            profile.skin,
            end_words(plane, side),
            cover=profile.cover,
            at_mm=0.0 if self._section.follows else None,  # the pointer is the plane's origin
        )

    def _next_step(self) -> str:
        if self._section.follows:
            return tr("Point at the insole or the foot to cut the insole there")
        if self._tool_controller.tool.key == "section":
            return tr("Click on the sole to cut the insole there")
        return tr("Choose the section tool and click on the sole.")


def end_words(plane: SectionPlane, side: Side) -> tuple[str, str]:
    """Return the anatomical directions at the left and right end of a section."""
    x, y = plane.along
    if abs(y) > abs(x):
        words, forward = (tr("Heel"), tr("Toes")), y > 0
    else:
        words, forward = (tr("Lateral"), tr("Medial")), (x > 0) == (side is Side.LEFT)
    return words if forward else (words[1], words[0])


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
        self._timer.setInterval(_FRAME_MS)
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
