"""The capture stage in a window of its own: sensors are in use only while it is open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Signal

from insole_studio.features.capture.stage import CaptureStage
from insole_studio.services.stage_window import StageWindow


class CaptureWindow(StageWindow[CaptureStage]):
    """Opens the capture stage; closed, it switches the sensors off.

    A capture that runs keeps its finished views. What was captured is handed on when the window is
    closed: both feet of a visit, one after the other.
    """

    captured = Signal(object)
    """The path of a session that is to be opened."""

    def __init__(self, make: Callable[[], CaptureStage]) -> None:
        super().__init__(make)
        self._waiting: list[Path] = []

    def connect_stage(self, stage: CaptureStage) -> None:
        """Collect what is captured, until the stage is closed."""
        stage.kept.connect(self._waiting.append)
        stage.closed.connect(self.hand_on)

    def hand_on(self) -> None:
        """Hand on the next session that waits, if any."""
        if self._waiting:
            self.captured.emit(self._waiting.pop(0))

    def close(self) -> None:
        """Close the stage with the program; nothing is opened any more."""
        self._waiting.clear()
        super().close()
