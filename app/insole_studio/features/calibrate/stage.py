"""The calibrate stage as a window of its own, with its view and presenters."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QMessageBox

from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.service_client import CaptureService
from insole_studio.features.calibrate.live_pictures import LivePictures
from insole_studio.features.calibrate.live_presenter import LivePresenter
from insole_studio.features.calibrate.presenter import CalibratePresenter
from insole_studio.features.calibrate.print_dialog import PrintDialog
from insole_studio.features.calibrate.view import CalibrateView
from insole_studio.jobs import Jobs
from insole_studio.services.files import Kept
from insole_studio.services.questions import Questions
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.tab_order import StageFrame

_SIZE = (1180, 680)
_TICK_MS = 50


class CalibrateStage(StageFrame):
    """Window that guides through the calibration of a sensor, with live or stored images.

    Parameters
    ----------
    store
        Storage of calibrated sensors.
    source
        Source of the live sensors.
    folder
        Folder for captured images.
    ask_folder
        Lets the user choose a folder; by default in a dialog.
    ask
        Asks whether to save an implausible result; by default in a dialog.
    questions
        Ask for paths, and what to do with a result; by default with folders of their own.
    """

    closed = Signal()

    def __init__(
        self,
        store: SensorStore,
        source: SensorSource,
        folder: Path,
        ask_folder: Callable[[], Path | None] | None = None,
        ask: Callable[[str], bool] | None = None,
        *,
        questions: Questions | None = None,
    ) -> None:
        super().__init__()
        self.setWindowTitle(tr("Calibrate sensors") + " – Insole Studio")
        self.resize(*_SIZE)
        self.view = CalibrateView()
        self.hold(self.view)
        self.jobs = Jobs(self)
        self._questions = questions.on(self) if questions else Questions(self)
        self.presenter = CalibratePresenter(
            self.view,
            store,
            self.jobs,
            ask_folder or self._ask_folder,
            ask or self._ask,
            ask_result=self._questions.about_result,
        )
        self._system = source.setup().system
        live = LivePictures(lambda: CaptureService(source), self._system)
        self.live = LivePresenter(self.view, self.presenter, live, self.jobs, folder)
        self.view.print_requested.connect(self.print_boards)
        self._timer = QTimer(self)
        self._timer.setInterval(_TICK_MS)
        self._timer.timeout.connect(self.live.tick)
        self._timer.start()

    def print_boards(self) -> None:
        """Open the dialog that prints boards and marker templates."""
        dialog = PrintDialog(self.view.board(), self._system, self, questions=self._questions)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop sensors and jobs, once a result was saved or dropped."""
        if self.presenter.has_result:
            event.ignore()
            self.presenter.after_result(lambda: QTimer.singleShot(0, self, self.close))
            return
        self._timer.stop()
        self.live.close()
        self.jobs.close()
        event.accept()
        self.closed.emit()

    def _ask_folder(self) -> Path | None:
        return self._questions.folder_to_open(tr("Folder with the images"), Kept.PICTURES)

    def _ask(self, sentence: str) -> bool:
        box = QMessageBox(self)
        box.setWindowTitle(tr("Insole Studio"))
        box.setText(translate_core_message(sentence))
        anyway = box.addButton(tr("Save anyway"), QMessageBox.ButtonRole.AcceptRole)
        stop = box.addButton(tr("Do not save"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(stop)
        box.exec()
        return box.clickedButton() is anyway
