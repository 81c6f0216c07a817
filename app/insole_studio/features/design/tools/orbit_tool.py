"""The default tool: rotate the view, and select."""

from __future__ import annotations

from insole_studio.document.case import Case
from insole_studio.features.design.tools.editable_pads import is_arch, selected_pelott
from insole_studio.features.design.tools.pelott_tool import (
    grab_pelott,
    nudge_pelott,
    pelott_at,
    pelott_handles,
    pelott_offers,
    raise_pelott,
)
from insole_studio.features.design.tools.rocker_line import (
    ROCKER_LINE,
    carry_rocker_line,
    nudge_rocker,
    rocker_handles,
    selected_rocker,
)
from insole_studio.features.design.tools.tool import ContextMenuItem, SurfaceContext, Tool
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, PointerEvent
from insole_studio.texts import tr


class OrbitTool(Tool):
    """Tool that rotates the view; a click selects a correction, whose handles can be dragged."""

    key = "orbit"
    turns_view = True

    def __init__(self, behind_heads_mm: float) -> None:
        self._behind_heads_mm = behind_heads_mm

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if is_arch(case):
            return tr("Drag a handle to change the arch, drag beside it to turn the view")
        if selected_pelott(case) is not None:
            return tr("Drag a handle to change the pelott, drag beside it to turn the view")
        if selected_rocker(case) is not None:
            return tr("Drag the handle to move the rocker line, drag beside it to turn the view")
        return tr("Drag to turn, Shift and drag to move, wheel to zoom, double click to centre")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the selected pad, or of the selected rocker."""
        return pelott_handles(case, surface) + rocker_handles(case, surface)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the pad at the pointer."""
        return pelott_offers(case, event)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the selected pad by keys; the wheel itself zooms."""
        return event.by_key and raise_pelott(case, event, steps)

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a handle, or update the selection and let the camera rotate."""
        if event.handle == ROCKER_LINE:
            return carry_rocker_line(case, event)
        if event.handle is not None:
            return grab_pelott(case, event, self._behind_heads_mm)
        design = case.record.design
        pad = pelott_at(design, event) if design is not None else None
        case.select(pad.id if pad is not None else None)
        return None

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected pad, or the line of the selected rocker, by one step."""
        return nudge_rocker(case, event, right, up) or nudge_pelott(case, event, right, up)
