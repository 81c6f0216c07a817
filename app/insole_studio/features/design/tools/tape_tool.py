"""The measuring tape: how far it is between points, along the surface and straight."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.surface_path import path_length_mm, resampled
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    Measure,
    SurfaceContext,
    Tool,
    show_again,
)
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import localised, tr

PREFIX = "tape:"


class TapeTool(Tool):
    """Tool that lays a tape over points of foot or insole; it belongs to nobody's prescription."""

    key = "tape"

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Forget what was set for the case before."""
        self._points: tuple[FloatArray, ...] = ()
        self._ways: tuple[FloatArray, ...] = ()
        """Between each point and the next; straight while one of the two is being dragged."""
        self._lies_on: tuple[object, ...] = ()
        """Of which view, foot and design the surface is; the tape is gone with it."""
        self._is_done = False

    def hint(self, case: Case) -> str:
        """Return the length of the tape, or how to lay it."""
        if not self._is_valid(case) or not self._points:
            return tr("Click on foot or insole where the tape begins")
        if not self._ways:
            return tr("Click where it ends")
        how = tr("click to go on, double click to end, Ctrl+Z to take the last point back")
        return f"{self._text()}: {how}"

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the points of the tape."""
        hint = self.hint(case)
        points = self._points if self._is_on(case, surface.subject) else ()
        return tuple(
            Handle(f"{PREFIX}{number}", (float(x), float(y), float(z)), hint)
            for number, (x, y, z) in enumerate(points)
        )

    @property
    def selection(self) -> object:
        """What is drawn again when it changes."""
        return self._ways or self._points

    def measure(self, case: Case, surface: SurfaceContext) -> Measure | None:
        """Return the tape as it lies on a surface, and its length."""
        if not self._ways or not self._is_on(case, surface.subject):
            return None
        middle = resampled(np.concatenate(self._ways), 3)[1]
        return Measure(self._ways, f"{localised(self._along_mm)} mm", middle)

    def own_step(self, case: Case) -> str:
        """Return what Undo takes back before a step of the case."""
        return tr("Lay the tape") if self._points and self._is_valid(case) else ""

    def take_back(self) -> None:
        """Take the last point off the tape."""
        self._points, self._ways = self._points[:-1], self._ways[:-1]
        self._is_done = False

    def double_click(self, case: Case, _event: PointerEvent, _surface: SurfaceContext) -> bool:
        """End the tape: the next click begins another one."""
        self._is_done = self._is_valid(case)
        return True

    def offers(
        self, case: Case, event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the item that removes the tape."""
        if not self._points or not self._is_on(case, event.subject):
            return ()

        def remove() -> None:
            self.reset()
            show_again(case)

        return (ContextMenuItem(tr("Remove the tape"), remove, removes=True),)

    def press(self, case: Case, event: PointerEvent, surface: SurfaceContext) -> Gesture | None:
        """Grab a point of the tape, or lay it on to the point under the pointer."""
        grabbed = (event.handle or "").removeprefix(PREFIX)
        is_on = self._is_on(case, event.subject)
        if is_on and grabbed.isdecimal():
            return self._lay(case, event, surface, int(grabbed))
        if event.surface_mm is None:
            return None
        if not is_on or self._is_done:
            self.reset()
        return self._lay(case, event, surface, len(self._points))

    def _lay(
        self, case: Case, event: PointerEvent, surface: SurfaceContext, number: int
    ) -> Gesture:
        before = self._points, self._ways, self._lies_on
        self._lies_on = _surface_of(case, surface.subject)
        try:
            while True:
                if event.touched_mm:
                    place = event.touched_mm[-1]
                    self._points = (*self._points[:number], place, *self._points[number + 1 :])
                is_over = event.phase is Phase.RELEASE
                self._ways = tuple(self._way(surface, number, n, is_over) for n in self._legs)
                case.preview(case.record)
                if is_over:
                    break
                event = yield
        except GeneratorExit:
            self._points, self._ways, self._lies_on = before
            raise
        case.end_preview()

    @property
    def _legs(self) -> range:
        return range(len(self._points) - 1)

    def _way(self, surface: SurfaceContext, moved: int, leg: int, is_over: bool) -> FloatArray:
        """Return the way of a leg, after a point has moved; the surface is slow to search."""
        if moved not in (leg, leg + 1):
            return self._ways[leg]
        straight = np.stack(self._points[leg : leg + 2])
        found = surface.way(*straight) if is_over else None
        return straight if found is None else found

    def _is_valid(self, case: Case) -> bool:
        """Return whether the surface is still the one that the tape was laid on."""
        return any(self._is_on(case, subject) for subject in Subject)

    def _is_on(self, case: Case, subject: Subject) -> bool:
        return self._lies_on == _surface_of(case, subject)

    def _text(self) -> str:
        straight_mm = path_length_mm(np.stack(self._points))
        return tr("{along} mm along the surface, {straight} mm straight").format(
            along=localised(self._along_mm), straight=localised(straight_mm)
        )

    @property
    def _along_mm(self) -> float:
        return sum(path_length_mm(way) for way in self._ways)


def _surface_of(case: Case, subject: Subject) -> tuple[object, ...]:
    """Return what the surface of a view is made from."""
    record = case.record
    return (
        (subject, record.foot) if subject is Subject.FOOT else (subject, record.foot, record.design)
    )
