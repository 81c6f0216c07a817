"""The foot stage in a window of its own: from a session to a foot on the bench."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Signal

from insole_studio.features.foot.stage import ReconstructStage
from insole_studio.services.stage_window import StageWindow


class FootWindow(StageWindow[ReconstructStage]):
    """Opens the foot stage on a session."""

    foot_made = Signal(object)
    """A `ScannedFoot` that is to be put onto the bench."""
    unreadable = Signal(object)
    closed = Signal()

    def open_session(self, path: Path, hand_over: bool = True) -> None:
        """Show the stage with a session; one that it shows already stays as it is."""
        if self.stage is not None and self.stage.path == path and not hand_over:
            self.open()
            return
        self.open()
        assert self.stage is not None
        self.stage.open_session(path, hand_over)

    def connect_stage(self, stage: ReconstructStage) -> None:
        """Hand on what is made."""
        stage.foot_made.connect(self.foot_made)
        stage.unreadable.connect(self.unreadable)
        stage.closed.connect(self.closed)
