"""The capture stage in a window of its own: sensors are in use only while it is open."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from insole_studio.stages.capture.stage import CaptureStage


class CaptureWindow(QObject):
    """Opens the capture stage, and closes it with the program.

    Parameters
    ----------
    make
        Constructs the stage.
    """

    captured = Signal(object)
    """The path of a session that is to be opened."""

    def __init__(self, make: Callable[[], CaptureStage], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._make = make
        self.stage: CaptureStage | None = None

    def open(self) -> None:
        """Show the stage; one that is open comes to the front.

        Raises
        ------
        InputError
            When the reference system or the emulated session cannot be read.
        """
        if self.stage is None:
            self.stage = self._make()
            self.stage.captured.connect(self.captured)
            self.stage.closed.connect(self._forget)
        self.stage.show()
        self.stage.raise_()
        self.stage.activateWindow()

    def close(self) -> None:
        """Switch the sensors off; a capture that runs keeps its finished views."""
        if self.stage is not None:
            self.stage.close()

    def _forget(self) -> None:
        if self.stage is not None:
            self.stage.deleteLater()
        self.stage = None
