"""Dragging the volume of interest: each face of the box moves along its own axis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.recording.box import Box
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent, RunningGesture
from insole_studio.scene.scene_view import OfferedItem
from insole_studio.texts import tr

STEP_MM = 1.0
LEAST_MM = 20.0
"""Smallest length of a side of the box."""
_SHORTEST = 0.3
"""Smallest share of an axis that must lie in the image plane for a drag along it."""


def box_handles(box: Box) -> tuple[Handle, ...]:
    """Return a handle in the middle of every face."""
    low, high = np.array(box.min_mm), np.array(box.max_mm)
    handles = []
    for axis, name in enumerate("xyz"):
        for end, side in (("min", low), ("max", high)):
            x, y, z = np.where(np.arange(3) == axis, side, (low + high) / 2).tolist()
            hint = tr("Drag the face of the box along its axis")
            handles.append(Handle(f"box-{name}-{end}", (x, y, z), hint))
    return tuple(handles)


def box_edges(box: Box) -> list[FloatArray]:
    """Return the twelve edges of a box as lines (2, 3), mm."""
    corners = np.array([box.min_mm, box.max_mm])
    edges = []
    for axis in range(3):
        first, second = (other for other in range(3) if other != axis)
        for i in (0, 1):
            for j in (0, 1):
                line = corners.copy()
                line[:, first], line[:, second] = corners[i, first], corners[j, second]
                edges.append(line)
    return edges


class BoxDragger:
    """Drags the faces of a box with the pointer of a view.

    Parameters
    ----------
    box
        Returns the current box; None if there is none.
    preview
        Called with the box during the drag.
    apply
        Called with the box on release.
    """

    def __init__(
        self,
        box: Callable[[], Box | None],
        preview: Callable[[Box], None],
        apply: Callable[[Box], None],
    ) -> None:
        self._box = box
        self._preview = preview
        self._apply = apply
        self._gesture = RunningGesture()

    @property
    def turns_view(self) -> bool:
        """Whether a drag beside the handles turns the view: there is no tool for it here."""
        return True

    def press(self, event: PointerEvent) -> bool:
        """Grab a face; return False to leave the press to the camera."""
        box = self._box()
        if box is None or not (event.handle or "").startswith("box-"):
            return False
        _, name, end = str(event.handle).split("-")
        axis = "xyz".index(name)
        if np.linalg.norm(_on_screen(event, axis)) < _SHORTEST:
            return False
        self._gesture.begin(self._drag(event, box, axis, end == "max"))
        return True

    def move(self, event: PointerEvent) -> None:
        """Continue the drag."""
        self._gesture.send(event)

    def release(self, event: PointerEvent) -> None:
        """Finish the drag."""
        self.move(event)

    def cancel(self) -> bool:
        """Cancel the drag; return False if there is none."""
        box = self._box()
        if box is None or not self._gesture.close():
            return False
        self._preview(box)
        return True

    def double_click(self, event: PointerEvent) -> bool:
        """Leave the double click to the camera."""
        del event
        return False

    def offers(self, event: PointerEvent) -> tuple[OfferedItem, ...]:
        """Return no context menu items."""
        del event
        return ()

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Leave the wheel to the camera."""
        del event, steps
        return False

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Leave the arrow keys to others."""
        del event, right, up
        return False

    def _drag(self, press: PointerEvent, start: Box, axis: int, is_max: bool) -> Gesture:
        box, event = start, press
        along = _on_screen(press, axis)
        while event.phase is not Phase.RELEASE:
            event = yield
            moved_px = np.subtract(event.pixel, press.pixel) * [1, -1]
            by_mm = float(moved_px @ along / (along @ along)) * press.look.mm_per_px
            box = _with_face(start, axis, is_max, by_mm)
            self._preview(box)
        self._apply(box)


def _on_screen(event: PointerEvent, axis: int) -> FloatArray:
    """Return the direction (2,) of an axis in the image, right and up."""
    return np.array([event.look.right[axis], event.look.up[axis]])


def _with_face(box: Box, axis: int, is_max: bool, by_mm: float) -> Box:
    low, high = list(box.min_mm), list(box.max_mm)
    if is_max:
        high[axis] = max(rounded(high[axis] + by_mm, STEP_MM), low[axis] + LEAST_MM)
    else:
        low[axis] = min(rounded(low[axis] + by_mm, STEP_MM), high[axis] - LEAST_MM)
    return replace(box, min_mm=(low[0], low[1], low[2]), max_mm=(high[0], high[1], high[2]))
