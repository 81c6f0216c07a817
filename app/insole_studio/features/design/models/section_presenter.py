"""Presenter of the section through the insole."""

from __future__ import annotations

from typing import Protocol

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_studio.document.case import Case
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.texts import tr


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
