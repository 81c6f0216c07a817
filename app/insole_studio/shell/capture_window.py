"""The capture stage in a window of its own: sensors are in use only while it is open."""

from __future__ import annotations

from PySide6.QtCore import Signal

from insole_studio.shell.stage_window import StageWindow
from insole_studio.stages.capture.stage import CaptureStage


class CaptureWindow(StageWindow[CaptureStage]):
    """Opens the capture stage; closed, it switches the sensors off.

    A capture that runs keeps its finished views.
    """

    captured = Signal(object)
    """The path of a session that is to be opened."""

    def connect_stage(self, stage: CaptureStage) -> None:
        """Hand on what is captured."""
        stage.captured.connect(self.captured)
