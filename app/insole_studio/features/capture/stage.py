"""The capture stage as a window of its own, with its service, view and presenter."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QTimer, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QWidget

from insole_studio.acquisition.capture_plan import PlanRequest
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.service_client import CaptureService
from insole_studio.features.capture.presenter import TILT_STEP_DEG, CapturePresenter
from insole_studio.features.capture.rows import CaptureOptions
from insole_studio.features.capture.view import CaptureView
from insole_studio.features.capture.view_assignment import options_of
from insole_studio.jobs import Jobs
from insole_studio.texts import tr
from insole_studio.widgets.tab_order import StageFrame

_TICK_MS = 50
_SIZE = (1200, 720)


class CaptureStage(StageFrame):
    """Window of the capture stage; sensors and their emitters are on from construction to closing.

    Parameters
    ----------
    source
        Source of the sensors.
    assignment
        Last assignment: pairs of view and serial number.
    folder
        For drafts and finished sessions.
    remember
        Called with each new assignment.
    ask
        Asks, on this window, whether to use a scan that lacks some of its views.

    Raises
    ------
    InputError
        If the reference system or the emulated session cannot be read.
    """

    kept = Signal(object)
    """The path of a finished session, to be opened once this window is closed."""
    closed = Signal()

    def __init__(
        self,
        *,
        source: SensorSource,
        assignment: Sequence[tuple[str, str]],
        folder: Path,
        remember: Callable[[Sequence[tuple[str, str]]], None],
        ask: Callable[[QWidget, str], bool],
    ) -> None:
        super().__init__()
        setup = source.setup()
        self.setWindowTitle(tr("Capture") + " – Insole Studio")
        self.resize(*_SIZE)
        self.view = CaptureView(TILT_STEP_DEG)
        self.hold(self.view)
        self._jobs = Jobs(self)
        self._service = CaptureService(source)
        self.presenter = CapturePresenter(
            panel=self.view,
            service=self._service,
            setup=setup,
            jobs=self._jobs,
            assignment=assignment or source.usual_views(),
            folder=folder,
            options=first_options(source),
            remember=remember,
            kept=self.kept.emit,
            finished=self.close,
            ask=lambda sentence: ask(self, sentence),
        )
        self._timer = QTimer(self)
        self._timer.setInterval(_TICK_MS)
        self._timer.timeout.connect(self.presenter.tick)
        self._timer.start()

    def end(self) -> None:
        """Switch the sensors off; a running capture keeps its finished views."""
        self._timer.stop()
        self._jobs.close()
        self._service.close()
        self.presenter.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Switch the sensors off."""
        self.end()
        event.accept()
        self.closed.emit()


def first_options(source: SensorSource) -> CaptureOptions:
    """Return the initial options; emulated sensors are captured as they were recorded."""
    if source.session is None:
        return CaptureOptions()
    request = PlanRequest(source.usual_views(), bursts=source.usual_bursts())
    return options_of(request, CaptureOptions(source.session.manifest.side))
