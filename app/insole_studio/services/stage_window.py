"""A stage in a window of its own, constructed when first opened."""

from __future__ import annotations

from typing import Generic, TypeVar

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

Stage = TypeVar("Stage", bound=QWidget)


class StageWindow(QObject, Generic[Stage]):
    """Opens a stage, and closes it with the program.

    Parameters
    ----------
    window
        The main window, above which the stage stays: also when a dialog of either has been closed.
    """

    def __init__(self, window: QWidget | None = None) -> None:
        super().__init__(window)
        self._window = window
        self.stage: Stage | None = None

    def open(self) -> None:
        """Show the stage, or raise it if it is open already.

        Raises
        ------
        InputError
            When something that the stage needs cannot be read.
        """
        if self.stage is None:
            self.stage = self.make_stage()
            self.stage.closed.connect(self._forget)  # type: ignore[attr-defined]
            self.connect_stage(self.stage)
            if self._window is not None:
                stay_above(self.stage, self._window)
        self.stage.show()
        self.stage.raise_()
        self.stage.activateWindow()

    def close(self) -> None:
        """Close the stage, if it is open."""
        if self.stage is not None:
            self.stage.close()

    def make_stage(self) -> Stage:
        """Construct the stage, which must have a signal `closed`."""
        raise NotImplementedError

    def connect_stage(self, stage: Stage) -> None:
        """Connect the signals of a newly constructed stage."""

    def _forget(self) -> None:
        if self.stage is not None:
            self.stage.deleteLater()
        self.stage = None


def stay_above(stage: QWidget, window: QWidget) -> None:
    """Keep a window above another, without making it part of the other."""
    stage.winId()  # creates what the window manager knows of it
    window.winId()
    stage.windowHandle().setTransientParent(window.windowHandle())
