"""The foot stage as a window of its own: view and presenter while it is open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QVBoxLayout

from insole_core.reconstruct import RegistrationLimits
from insole_studio.features.foot.box_dragger import BoxDragger
from insole_studio.features.foot.presenter import FootStagePresenter
from insole_studio.features.foot.view import FootStageView
from insole_studio.jobs import Jobs
from insole_studio.texts import tr
from insole_studio.widgets.tab_order import StageFrame

_SIZE = (1280, 720)


class FootStage(StageFrame):
    """Shows how a foot comes about, and lets the hand correct it.

    Parameters
    ----------
    jobs
        Those of the window: the work is shown there as well.
    limits
        When the pose of a view is refused.
    remember
        Is told other limits.
    ask
        Whether to go on although a sentence speaks against it.
    dark, touch
    """

    foot_made = Signal(object)
    """A `ScannedFoot` that is to be designed on."""
    unreadable = Signal(object)
    """The error, when the session cannot be read at all; the stage closes."""
    closed = Signal()

    def __init__(
        self,
        *,
        jobs: Jobs,
        limits: RegistrationLimits,
        remember: Callable[[RegistrationLimits], None],
        ask: Callable[[str], bool],
        dark: bool,
        touch: bool = False,
    ) -> None:
        super().__init__()
        self._is_open = False
        self.setWindowTitle(tr("Foot") + " – Insole Studio")
        self.resize(*_SIZE)
        self._jobs = jobs
        self.path: Path | None = None
        self.view = FootStageView(dark)
        self.view.set_touch(touch)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.view)
        self.presenter = FootStagePresenter(
            panel=self.view,
            jobs=jobs,
            limits=limits,
            remember=remember,
            hand_over=self.foot_made.emit,
            ask=ask,
            finished=self._leave,
            needed_again=self._come_back,
            unreadable=self._give_up,
        )
        box = BoxDragger(lambda: self.presenter.box, self.view.show_box, self.presenter.edit_box)
        self.view.foot.scene.sink = box
        jobs.progressed.connect(self.presenter.progressed)
        self._is_open = True

    def open_session(self, path: Path, hand_over: bool) -> None:
        """Reconstruct a session; hand its foot over then, or when the user says so."""
        self.path = path
        self.presenter.open(path, hand_over)

    def changeEvent(self, event: QEvent) -> None:
        """Let the icons follow the theme."""
        if event.type() == QEvent.Type.PaletteChange and self._is_open:
            self.view.renew_icons()
        super().changeEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop what runs."""
        event.accept()
        if self._is_open:
            self._is_open = False
            self._jobs.progressed.disconnect(self.presenter.progressed)
            self.presenter.cancel()
            self.view.close_scene()
            self.closed.emit()

    def _leave(self, all_done: bool) -> None:
        """Close, or wait out of sight for what is still computed."""
        if all_done:
            self.close()
        else:
            self.hide()

    def _come_back(self) -> None:
        self.show()
        self.raise_()
        self.activateWindow()

    def _give_up(self, error: Exception) -> None:
        self.unreadable.emit(error)
        self.close()
