"""A drag as one generator, and the one that is under way."""

from __future__ import annotations

from collections.abc import Generator
from inspect import GEN_RUNNING, getgeneratorstate

from insole_studio.scene.pointer import PointerEvent

Gesture = Generator[None, PointerEvent, None]
"""Started with the press; receives every move, and ends at the release."""


class RunningGesture:
    """Begins, feeds and ends a gesture."""

    def __init__(self) -> None:
        self._gesture: Gesture | None = None

    def __bool__(self) -> bool:
        """Whether a gesture is under way."""
        return self._gesture is not None

    def begin(self, gesture: Gesture) -> None:
        """Lead a gesture up to its first wait."""
        self._gesture = gesture
        next(gesture)

    def send(self, event: PointerEvent) -> bool:
        """Continue it; True when it has ended by this event."""
        if self._gesture is None:
            return False
        try:
            self._gesture.send(event)
        except StopIteration:
            self._gesture = None
            return True
        return False

    def close(self) -> bool:
        """Give it up, as if it had never begun; False when there is none that could be."""
        if self._gesture is None or getgeneratorstate(self._gesture) == GEN_RUNNING:
            return False  # what it has just done may have led here
        self._gesture.close()
        self._gesture = None
        return True
