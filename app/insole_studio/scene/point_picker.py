"""Pick points on a surface: a click picks, a drag rotates the view."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.pointer import PointerEvent
from insole_studio.scene.scene_view import OfferedItem

_STILL_PX = 4.0


class PointPicker:
    """Picks points with the pointer of a view.

    Parameters
    ----------
    picked
        Called with the point (3,), mm, in the frame of the surface.
    """

    def __init__(self, picked: Callable[[FloatArray], None]) -> None:
        self.is_on = False
        self._picked = picked
        self._pressed: PointerEvent | None = None

    @property
    def turns_view(self) -> bool:
        """Whether a drag beside the surface turns the view."""
        return True

    def press(self, event: PointerEvent) -> bool:
        """Accept a press on the surface."""
        if not self.is_on or event.surface_mm is None:
            return False
        self._pressed = event
        return True

    def move(self, event: PointerEvent) -> None:
        """Ignore the move: only the release counts."""

    def release(self, event: PointerEvent) -> None:
        """Pick the point if the pointer has not moved since the press."""
        pressed, self._pressed = self._pressed, None
        if pressed is None or pressed.surface_mm is None:
            return
        if np.hypot(*np.subtract(event.pixel, pressed.pixel)) <= _STILL_PX:
            self._picked(pressed.surface_mm)

    def cancel(self) -> bool:
        """Forget a press."""
        held, self._pressed = self._pressed is not None, None
        return held

    def double_click(self, event: PointerEvent) -> bool:
        """Leave the double click to the camera."""
        return False

    def offers(self, event: PointerEvent) -> Sequence[OfferedItem]:
        """Return no context menu items."""
        return ()

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Leave the wheel to the camera."""
        return False

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Leave the arrow keys to others."""
        return False
