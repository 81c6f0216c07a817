"""The volume of interest: its faces dragged along their own axes, and its limits as numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QPushButton, QWidget

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.recording.box import Box
from insole_studio.scene.pointer import Gesture, Handle, Phase, PointerEvent, RunningGesture
from insole_studio.scene.scene_view import OfferedItem
from insole_studio.texts import tr
from insole_studio.widgets.number_field import NumberField

STEP_MM = 1.0
LEAST_MM = 20.0
"""Smallest length of a side of the box."""
_SHORTEST = 0.3
"""Smallest share of an axis that must lie in the image plane for a drag along it."""
_FARTHEST_MM = 600.0
_FIELD_PX = 88


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


class BoxFields(QWidget):
    """Fields for the six limits of the box, mm, reference frame."""

    edited = Signal(object)
    reset_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        grid.addWidget(QLabel(tr("from")), 0, 1)
        grid.addWidget(QLabel(tr("to")), 0, 2)
        self._fields: list[tuple[NumberField, NumberField]] = []
        for row, text in enumerate((tr("Across"), tr("Along the foot"), tr("Height")), start=1):
            grid.addWidget(QLabel(text), row, 0)
            pair = (_field(f"{text}, {tr('from')}"), _field(f"{text}, {tr('to')}"))
            self._fields.append(pair)
            for column, field in enumerate(pair, start=1):
                grid.addWidget(field, row, column)
                field.edited.connect(self._edit)
        self.reset = QPushButton(tr("As recorded"))
        self.reset.clicked.connect(self.reset_requested)
        grid.addWidget(self.reset, 4, 1, 1, 2)
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(2, 1)

    def show_box(self, box: Box) -> None:
        """Show a box."""
        for (low, high), least, greatest in zip(self._fields, box.min_mm, box.max_mm, strict=True):
            low.show_value(least)
            high.show_value(greatest)

    def box(self) -> Box:
        """Return the box entered in the fields, at least as large as dragging allows."""
        lows = [low.value() for low, _ in self._fields]
        highs = [max(high.value(), low.value() + LEAST_MM) for low, high in self._fields]
        return Box((lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2]))

    def _edit(self, _value: float) -> None:
        self.edited.emit(self.box())


def _field(name: str) -> NumberField:
    field = NumberField("mm", least=-_FARTHEST_MM, greatest=_FARTHEST_MM, step=5.0, decimals=0)
    field.setAccessibleName(name)
    field.setToolTip(tr("What lies outside this box is no part of the foot"))
    field.set_room(_FIELD_PX)
    return field
