"""The controller of the chosen tool: runs its gestures from press to release."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QObject, Signal

from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import (
    ContextMenuItem,
    SurfaceContext,
    Tool,
    show_again,
)
from insole_studio.scene.pointer import AnyGesture, PointerEvent, RunningGesture
from insole_studio.scene.pointer_moves import keep_every_move


class ToolController(QObject):
    """The chosen tool, shared by all views."""

    tool_changed = Signal()
    gesture_ended = Signal()

    def __init__(self, case: Case, tools: Sequence[Tool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self.tools = {tool.key: tool for tool in tools}
        self._gesture = RunningGesture()
        self.tool = tools[0]
        case.foot_changed.connect(self.cancel)

    def take(self, key: str) -> None:
        """Choose another tool."""
        self.cancel()
        self.tool = self.tools[key]
        keep_every_move(self.tool.draws)
        self.tool_changed.emit()

    def reset(self) -> None:
        """Choose the first tool, and let every tool forget what was set for the case before."""
        for tool in self.tools.values():
            tool.reset()
        self.take(next(iter(self.tools)))

    @property
    def is_busy(self) -> bool:
        """Whether a gesture is running."""
        return bool(self._gesture)

    def press(self, event: PointerEvent, surface: SurfaceContext) -> bool:
        """Start a gesture; return False to leave the press to the camera."""
        self.cancel()
        gesture = self.tool.press(self._case, event, surface)
        if gesture is None:
            return False
        self._gesture.begin(gesture)
        return True

    def begin(self, gesture: AnyGesture) -> None:
        """Run a gesture of a panel, which is fed by `drag` as well: of a chart, of a slider."""
        self.cancel()
        self._gesture.begin(gesture)

    def drag(self, event: Any) -> None:
        """Continue the gesture or, if the event is its last, finish it."""
        if self._gesture.send(event):
            self.gesture_ended.emit()

    def cancel(self) -> bool:
        """Cancel the gesture without effect; return False if there is none."""
        if not self._gesture.close():
            return False
        self._case.end_preview()
        self.gesture_ended.emit()
        return True

    def take_back(self, *, everything: bool = False) -> bool:
        """Take back a step of the tool's own, or all of them; return False if there is none."""
        if not self.tool.own_step(self._case):
            return False
        if everything:
            self.tool.reset()
        else:
            self.tool.take_back()
        show_again(self._case)
        return True

    def double_click(self, event: PointerEvent, surface: SurfaceContext) -> bool:
        """Handle a double click; return False to leave it to the camera."""
        return not self.is_busy and self.tool.double_click(self._case, event, surface)

    def offers(self, event: PointerEvent, surface: SurfaceContext) -> tuple[ContextMenuItem, ...]:
        """Return the context menu items."""
        return () if self.is_busy else self.tool.offers(self._case, event, surface)

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Handle the wheel; return False to leave it to the camera."""
        return not self.is_busy and self.tool.wheel(self._case, event, steps)

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Handle an arrow key, one step right or up; return False if nothing was moved."""
        return not self.is_busy and self.tool.nudge(self._case, event, right, up)
