"""The first tool: look around, pick up what is there."""

from __future__ import annotations

from insole_studio.document.case import Case
from insole_studio.features.design.tools.pelott_tool import (
    grab_pelott,
    nudge_pelott,
    pelott_at,
    pelott_handles,
    pelott_offers,
    raise_pelott,
    selected_pelott,
)
from insole_studio.features.design.tools.tool import ContextMenuItem, SurfaceContext, Tool
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, PointerEvent
from insole_studio.texts import tr


class OrbitTool(Tool):
    """Turns the view; a click on a correction selects it, its handles stay at hand."""

    key = "orbit"

    def hint(self, case: Case) -> str:
        """Say in one short sentence what one can do now."""
        if selected_pelott(case) is not None:
            return tr("Drag a handle to change the pelott, drag beside it to turn the view")
        return tr("Drag to turn, Shift and drag to move, wheel to zoom, double click to centre")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Give the spots that can be grabbed."""
        return pelott_handles(case, surface)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Offer to remove the pad at a place."""
        return pelott_offers(case, event)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the selected pad by keys; the wheel is the camera's."""
        return event.by_key and raise_pelott(case, event, steps)

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a handle; select or leave what is under the pointer, and let the camera turn."""
        if event.handle is not None:
            return grab_pelott(case, event)
        design = case.record.design
        pad = pelott_at(design, event) if design is not None else None
        case.select(pad.id if pad is not None else None)
        return None

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected pad by a little."""
        return nudge_pelott(case, event, right, up)
