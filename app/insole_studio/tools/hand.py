"""The hand holds one tool and leads its gestures from press to release."""

from __future__ import annotations

from collections.abc import Sequence
from inspect import GEN_RUNNING, getgeneratorstate

from PySide6.QtCore import QObject, Signal

from insole_studio.scene.pointer import PointerEvent
from insole_studio.tools.tool import Gesture, Ground, MenuOffer, Tool
from insole_studio.workbench.case import Case


class Hand(QObject):
    """The tool in use, shared by all views."""

    tool_changed = Signal()
    gesture_ended = Signal()

    def __init__(self, case: Case, tools: Sequence[Tool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self.tools = {tool.key: tool for tool in tools}
        self._gesture: Gesture | None = None
        self.tool = tools[0]
        case.foot_changed.connect(self.cancel)

    def take(self, key: str) -> None:
        """Take another tool."""
        self.cancel()
        self.tool = self.tools[key]
        self.tool_changed.emit()

    @property
    def is_busy(self) -> bool:
        """Whether a gesture is under way."""
        return self._gesture is not None

    def press(self, event: PointerEvent, ground: Ground) -> bool:
        """Begin a gesture; False leaves the press to the camera."""
        self.cancel()
        gesture = self.tool.press(self._case, event, ground)
        if gesture is None:
            return False
        self._gesture = gesture
        next(gesture)
        return True

    def drag(self, event: PointerEvent) -> None:
        """Continue or, with a release, end the gesture."""
        if self._gesture is None:
            return
        try:
            self._gesture.send(event)
        except StopIteration:
            self._gesture = None
            self.gesture_ended.emit()

    def cancel(self) -> bool:
        """Give the gesture up, as if it had never begun; False when there is none."""
        if self._gesture is None or getgeneratorstate(self._gesture) == GEN_RUNNING:
            return False  # what it has just done may tell of another foot
        self._gesture.close()
        self._gesture = None
        self._case.end_preview()
        self.gesture_ended.emit()
        return True

    def double_click(self, event: PointerEvent, ground: Ground) -> bool:
        """Act on a double click; False leaves it to the camera."""
        return not self.is_busy and self.tool.double_click(self._case, event, ground)

    def offers(self, event: PointerEvent, ground: Ground) -> tuple[MenuOffer, ...]:
        """Give the lines of the menu under the pointer."""
        return () if self.is_busy else self.tool.offers(self._case, event, ground)

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Act on the wheel; False leaves it to the camera."""
        return not self.is_busy and self.tool.wheel(self._case, event, steps)

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Act on an arrow key; False when there is nothing to nudge."""
        return not self.is_busy and self.tool.nudge(self._case, event, right, up)
