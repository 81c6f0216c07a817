"""The section tool: place a vertical plane through the insole, drag and turn it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.geometry.rounding import rounded
from insole_core.insole.grips import place_at
from insole_studio.document.case import Case
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    SurfaceContext,
    Tool,
    nudge_mm,
)
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.texts import tr

ARM_MM = 45.0
PLACE_STEP_MM = 0.5
TURN_STEP_DEG = 1.0

Change = Callable[[SectionPlane, PointerEvent, PointerEvent], SectionPlane]


class SectionTool(Tool):
    """Tool that places the section by a click; its handles move and turn it."""

    key = "section"

    def __init__(self, section: SectionModel) -> None:
        self._section = section

    def hint(self, _case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        if self._section.plane is None:
            return tr("Click on the sole to cut the insole there")
        return tr("Drag the middle to move the section, its end to turn it")

    def handles(self, _case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the section."""
        plane = self._section.plane
        if plane is None:
            return ()
        end = np.array(plane.origin_mm) + ARM_MM * plane.along
        return (
            Handle("section-move", surface.place(*plane.origin_mm), _move_hint(), "move"),
            Handle("section-turn", surface.place(*end), _turn_hint()),
        )

    def press(self, _case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab a handle, or place the section at the point under the pointer."""
        plane = self._section.plane
        if plane is not None and event.handle in _CHANGES:
            return self._drag(event, plane, _CHANGES[event.handle])
        if event.surface_mm is None:
            return None
        turn = plane.turn_deg if plane is not None else 0.0
        put = SectionPlane(place_at(event.surface_mm, PLACE_STEP_MM), turn)
        return self._drag(event, put, _moved)

    def offers(
        self, _case: Case, _event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the section."""
        if self._section.plane is None:
            return ()
        text = tr("Remove the section")
        return (ContextMenuItem(text, lambda: self._section.show(None), removes=True),)

    def nudge(self, _case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Move the section by 0.5 mm."""
        plane = self._section.plane
        if plane is None:
            return False
        moved = np.array(plane.origin_mm) + nudge_mm(event, right, up)
        self._section.show(replace(plane, origin_mm=place_at(moved, 0.01)))
        return True

    def _drag(self, press: PointerEvent, plane: SectionPlane, change: Change) -> Gesture:
        before, event = self._section.plane, press
        self._section.show(plane)
        try:
            while event.phase is not Phase.RELEASE:
                event = yield
                self._section.show(change(plane, press, event))
        except GeneratorExit:
            self._section.show(before)
            raise


def _moved(plane: SectionPlane, press: PointerEvent, event: PointerEvent) -> SectionPlane:
    start, now = press.place_mm(0.0), event.place_mm(0.0)
    if start is None or now is None:
        return plane
    return replace(
        plane, origin_mm=place_at(np.array(plane.origin_mm) + (now - start)[:2], PLACE_STEP_MM)
    )


def _turned(plane: SectionPlane, _press: PointerEvent, event: PointerEvent) -> SectionPlane:
    place = event.place_mm(0.0)
    if place is None:
        return plane
    x, y = place[:2] - np.array(plane.origin_mm)
    turn = float(np.degrees(np.arctan2(y, x)))
    return replace(plane, turn_deg=rounded(turn, TURN_STEP_DEG))


def _move_hint() -> str:
    return tr("Drag to move the section")


def _turn_hint() -> str:
    return tr("Drag to turn the section")


_CHANGES: dict[str | None, Change] = {"section-move": _moved, "section-turn": _turned}
