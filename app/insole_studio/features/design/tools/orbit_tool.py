"""The default tool: rotate the view, and select."""

from __future__ import annotations

from insole_studio.document.case import Case
from insole_studio.features.design.correction_names import name_of
from insole_studio.features.design.tools.hand import Hand
from insole_studio.features.design.tools.tool import ContextMenuItem, SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, PointerEvent
from insole_studio.texts import tr


class OrbitTool(Tool):
    """Tool that rotates the view; a click selects a correction, whose handles can be dragged."""

    key = "orbit"
    turns_view = True

    def __init__(self, behind_heads_mm: float) -> None:
        self._hand = Hand(behind_heads_mm)

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        held = self._hand.held(case)
        if held is not None and held.has_grips:
            return tr("{name}: drag a handle to change it, drag beside it to turn the view").format(
                name=name_of(held)
            )
        return tr("Drag to turn, Shift and drag to move, wheel to zoom, double click to centre")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the selected correction."""
        return self._hand.handles(case, surface)

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the pad at the pointer."""
        return self._hand.offers(case, event)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Raise the selected correction by keys; the wheel itself zooms."""
        return event.by_key and self._hand.wheel(case, event, steps)

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a handle, or update the selection and let the camera rotate."""
        if event.handle is not None:
            return self._hand.grab(case, event)
        if case.record.design is not None:
            pad = self._hand.at(case, event)
            case.select(None if pad is None else pad.id)
        return None

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the selected correction by one step."""
        return self._hand.nudge(case, event, right, up)
