"""A pointer for the keyboard: everything that the mouse does in a view, without a mouse.

The Page keys choose a handle and the arrows drag it; away from handles the arrows move a
crosshair, Enter clicks there, Space presses and releases. A drag by arrow keys is one gesture;
any other key ends it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.pointer import Phase, PointerEvent
from insole_studio.scene.view_camera import ViewTransform

if TYPE_CHECKING:
    from insole_studio.scene.scene_view import SceneView

DRAG_MM = 0.5
CROSS_MM = 2.0
COARSE, FINE = 10.0, 0.1
ORBIT_DEG = 5.0
PAN_PX = 40.0
ZOOM = 0.88
RING_PX = 13.0
ARM_PX = (5.0, 15.0)
"""Inner and outer end of the arms of the crosshair."""
_RING = np.linspace(0.0, 2 * np.pi, 33)

ARROWS: dict[int, tuple[int, int]] = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


class KeyboardCursor:
    """Translates keys into presses, moves and releases of a pointer."""

    def __init__(self, view: SceneView) -> None:
        self._view = view
        self._place: FloatArray | None = None
        """Position of the cursor, (3,) mm; None while it is hidden."""
        self.handle: str | None = None
        """The handle that the arrows drag."""
        self.holds = False
        """Whether a gesture is running."""
        self._has_clicked = False
        """Whether an object was just placed, which the arrows may then move."""

    @property
    def is_shown(self) -> bool:
        """Whether the crosshair or the ring around a handle is visible."""
        return self._place is not None

    def take(self, event: QKeyEvent) -> bool:
        """Handle a key; return False if it is not used here."""
        modifiers = event.modifiers()
        if modifiers & Qt.KeyboardModifier.AltModifier:
            return self._turn_view(event)
        if event.key() in ARROWS:
            return self._arrow(*ARROWS[event.key()], modifiers)
        act = _ACTS.get(event.key())
        return act is not None and act(self, modifiers)

    def let_go(self) -> bool:
        """Finish the keyboard gesture and keep its result; return False if there is none."""
        if not self.holds:
            return False
        self.holds = False
        self._view.go_on(self._event(Phase.RELEASE))
        self.refresh()
        return True

    def forget(self) -> None:
        """Hide the cursor because the mouse or another tool has taken over."""
        self._place, self.handle, self._has_clicked = None, None, False
        self.refresh()

    def refresh(self) -> None:
        """Redraw the cursor; if its handle has moved, follow it."""
        if self.handle is not None and not self.holds:
            place = self._place_of(self.handle)
            self.handle, self._place = (None, None) if place is None else (self.handle, place)
        if self._place is None:
            self._view.show_pointer((), None)
        else:
            figure = _ring if self.handle is not None else _cross
            self._view.show_pointer(figure(self._view.look, self._place), self._event(Phase.MOVE))

    def _arrow(self, right: int, up: int, modifiers: Qt.KeyboardModifier) -> bool:
        if self.handle is not None and not self.holds and not self._press(modifiers):
            return True
        if self.holds:
            by_mm = DRAG_MM if self.handle is not None else CROSS_MM
            self._move(right, up, by_mm * _factor(modifiers), modifiers)
        elif not self._nudge(right, up, modifiers):
            self._move(right, up, CROSS_MM * _factor(modifiers), modifiers)
        return True

    def _nudge(self, right: int, up: int, modifiers: Qt.KeyboardModifier) -> bool:
        """Move the selected object, unless the crosshair is being moved."""
        if self._place is not None and not self._has_clicked:
            return False
        if not self._view.nudge(self._event(Phase.MOVE, modifiers), right, up):
            return False
        self.forget()
        return True

    def _move(self, right: int, up: int, by_mm: float, modifiers: Qt.KeyboardModifier) -> None:
        self._has_clicked = False
        look = self._view.look
        x, y = self._pixel()
        by_px = by_mm / look.mm_per_px
        pixel = (x + right * by_px, y - up * by_px)
        moved = self._view.event_at(Phase.MOVE, pixel, self.handle, True, _has_shift(modifiers))
        hit = moved.surface_mm
        # A handle moves in the image plane: the skin below it may be far away.
        is_free = hit is None or self.handle is not None
        self._place = look.point_at(*pixel) if is_free else hit
        if self.holds:
            self._view.go_on(moved)
        self.refresh()

    def _press(self, modifiers: Qt.KeyboardModifier) -> bool:
        self.holds = self._view.begin(self._event(Phase.PRESS, modifiers))
        return self.holds

    def _hold(self, modifiers: Qt.KeyboardModifier) -> bool:
        """Press or release, on Space."""
        if not self.let_go():
            self._press(modifiers)
            self.refresh()
        return True

    def _click(self, modifiers: Qt.KeyboardModifier) -> bool:
        """Release, or click at the cursor, on Enter."""
        if not self.let_go() and self._press(modifiers):
            self.let_go()
            self._has_clicked = self.handle is None
        return True

    def _choose(self, step: int) -> bool:
        """Go to the next handle (`step` 1) or to the previous one (-1)."""
        self.let_go()
        names = [handle.name for handle in self._view.handles]
        if not names:
            return False
        at = names.index(self.handle) if self.handle in names else (-1 if step > 0 else 0)
        self.handle = names[(at + step) % len(names)]
        self.refresh()
        return True

    def _home(self, _modifiers: Qt.KeyboardModifier) -> bool:
        self.let_go()
        self.handle, self._place = None, self._start()
        self.refresh()
        return True

    def _lift(self, steps: float, modifiers: Qt.KeyboardModifier) -> bool:
        self.let_go()
        if not self._view.lift(self._event(Phase.MOVE, modifiers), steps):
            self._view.change_camera(self._view.camera.zoomed(ZOOM**steps))
        self.refresh()
        return True

    def _remove(self, modifiers: Qt.KeyboardModifier) -> bool:
        self.let_go()
        return self.is_shown and self._view.remove(self._event(Phase.MOVE, modifiers))

    def _menu(self, modifiers: Qt.KeyboardModifier) -> bool:
        self.let_go()
        self._view.offer_menu(self._event(Phase.PRESS, modifiers))
        return True

    def _escape(self, _modifiers: Qt.KeyboardModifier) -> bool:
        was_held, self.holds = self.holds, False
        if self._view.give_up() or was_held:
            self.refresh()
            return True
        was_shown = self.is_shown
        self.forget()
        return was_shown

    def _turn_view(self, event: QKeyEvent) -> bool:
        """Rotate the camera with Alt and arrows; pan it with Shift as well."""
        right, up = ARROWS.get(event.key(), (0, 0))
        if (right, up) == (0, 0):
            return False
        look, camera = self._view.look, self._view.camera
        if _has_shift(event.modifiers()):
            shift = (right * look.right + up * look.up) * PAN_PX * look.mm_per_px
            self._view.change_camera(camera.centred(look.focal_mm + shift))
        else:
            self._view.change_camera(camera.orbited(right * ORBIT_DEG, up * ORBIT_DEG))
        self.refresh()
        return True

    def _event(
        self, phase: Phase, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
    ) -> PointerEvent:
        fine = self.holds or bool(modifiers & Qt.KeyboardModifier.ControlModifier)
        return self._view.event_at(phase, self._pixel(), self.handle, fine, _has_shift(modifiers))

    def _pixel(self) -> tuple[float, float]:
        place = self._start() if self._place is None else self._place
        x, y = self._view.look.pixels_of(place)[0]
        return float(x), float(y)

    def _start(self) -> FloatArray:
        """Return the start of the cursor: where the tool is usually used, or mid-view."""
        start = self._view.start_mm
        return self._view.look.focal_mm if start is None else np.array(start)

    def _place_of(self, name: str) -> FloatArray | None:
        return next((np.array(h.position_mm) for h in self._view.handles if h.name == name), None)


def _factor(modifiers: Qt.KeyboardModifier) -> float:
    if _has_shift(modifiers):
        return COARSE
    return FINE if modifiers & Qt.KeyboardModifier.ControlModifier else 1.0


def _has_shift(modifiers: Qt.KeyboardModifier) -> bool:
    return bool(modifiers & Qt.KeyboardModifier.ShiftModifier)


def _ring(look: ViewTransform, place: FloatArray) -> tuple[FloatArray, ...]:
    radius = RING_PX * look.mm_per_px
    circle = np.cos(_RING)[:, None] * look.right + np.sin(_RING)[:, None] * look.up
    return (place + radius * circle,)


def _cross(look: ViewTransform, place: FloatArray) -> tuple[FloatArray, ...]:
    near, far = (length * look.mm_per_px for length in ARM_PX)
    arms = (look.right, -look.right, look.up, -look.up)
    return tuple(np.stack([place + near * arm, place + far * arm]) for arm in arms)


_ACTS: dict[int, Callable[[KeyboardCursor, Qt.KeyboardModifier], bool]] = {
    Qt.Key.Key_Space: KeyboardCursor._hold,
    Qt.Key.Key_Return: KeyboardCursor._click,
    Qt.Key.Key_Enter: KeyboardCursor._click,
    Qt.Key.Key_Home: KeyboardCursor._home,
    Qt.Key.Key_PageDown: lambda keys, _modifiers: keys._choose(1),
    Qt.Key.Key_PageUp: lambda keys, _modifiers: keys._choose(-1),
    Qt.Key.Key_Plus: lambda keys, modifiers: keys._lift(1.0, modifiers),
    Qt.Key.Key_Minus: lambda keys, modifiers: keys._lift(-1.0, modifiers),
    Qt.Key.Key_Delete: KeyboardCursor._remove,
    Qt.Key.Key_Menu: KeyboardCursor._menu,
    Qt.Key.Key_F10: KeyboardCursor._menu,
    Qt.Key.Key_Escape: KeyboardCursor._escape,
}
