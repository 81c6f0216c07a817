"""The running gesture: a drag as one generator."""

from __future__ import annotations

from collections.abc import Generator
from inspect import GEN_RUNNING, getgeneratorstate
from typing import Any, TypeAlias

from insole_studio.scene.pointer import PointerEvent

Gesture = Generator[None, PointerEvent, None]
"""Started by the press; receives every move, and ends at the release."""
AnyGesture: TypeAlias = Generator[None, Any, None]
"""A gesture in a view, or one of a panel, which receives the values of that panel."""


class RunningGesture:
    """Starts, feeds and ends one gesture at a time."""

    def __init__(self) -> None:
        self._gesture: AnyGesture | None = None

    def __bool__(self) -> bool:
        """Whether a gesture is running."""
        return self._gesture is not None

    def begin(self, gesture: AnyGesture) -> None:
        """Run a gesture up to its first wait."""
        self._gesture = gesture
        next(gesture)

    def send(self, event: Any) -> bool:
        """Pass an event to the gesture; return True if that ended it."""
        if self._gesture is None:
            return False
        try:
            self._gesture.send(event)
        except StopIteration:
            self._gesture = None
            return True
        return False

    def close(self) -> bool:
        """Cancel the gesture without effect; return False if none can be cancelled."""
        if self._gesture is None or getgeneratorstate(self._gesture) == GEN_RUNNING:
            return False  # called from within the running gesture itself
        self._gesture.close()
        self._gesture = None
        return True
