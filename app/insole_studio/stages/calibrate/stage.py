"""The calibrate stage as a window of its own: view and presenter while it is open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QFileDialog, QVBoxLayout, QWidget

from insole_studio.jobs import Jobs
from insole_studio.stages.calibrate.presenter import CalibratePresenter
from insole_studio.stages.calibrate.view import CalibrateView
from insole_studio.texts import tr
from insole_studio.workbench.sensor_store import SensorStore

_SIZE = (1180, 680)


class CalibrateStage(QWidget):
    """Leads through the calibration of a sensor with pictures from folders.

    Parameters
    ----------
    store
        Keeps the sensors.
    ask_folder
        Lets the user choose a folder; by default in a dialog.
    """

    closed = Signal()

    def __init__(
        self, store: SensorStore, ask_folder: Callable[[], Path | None] | None = None
    ) -> None:
        super().__init__()
        self.setWindowTitle(tr("Calibrate sensors") + " – Insole Studio")
        self.resize(*_SIZE)
        self.view = CalibrateView()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.view)
        self.jobs = Jobs(self)
        self.presenter = CalibratePresenter(
            self.view, store, self.jobs, ask_folder or self._ask_folder
        )

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop what runs; nothing that was not saved is kept."""
        self.jobs.close()
        event.accept()
        self.closed.emit()

    def _ask_folder(self) -> Path | None:
        name = QFileDialog.getExistingDirectory(self, tr("Folder with the images"))
        return Path(name) if name else None
