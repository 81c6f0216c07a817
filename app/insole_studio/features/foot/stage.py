"""The foot stage as a window of its own, with its view and presenter."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, Signal
from PySide6.QtGui import QCloseEvent

from insole_core.geometry.side import Side
from insole_core.reconstruct import RegistrationLimits
from insole_studio.features.foot.presenter import FootStagePresenter
from insole_studio.features.foot.view import FootStageView
from insole_studio.features.foot.volume_box import BoxDragger
from insole_studio.jobs import Jobs
from insole_studio.services.questions import OtherFoot
from insole_studio.texts import tr
from insole_studio.widgets.tab_order import StageFrame

_SIZE = (1280, 720)


class FootStage(StageFrame):
    """Window that shows how a foot is made from a session, and lets the user correct it.

    Parameters
    ----------
    jobs
        The window's jobs, whose progress is shown there as well.
    limits
        Limits beyond which the pose of a view is rejected.
    remember
        Called with changed limits.
    ask
        Asks whether to continue despite a warning.
    ask_alone
        Asks whether to make one foot, since the other one is missing.
    ask_side
        Asks which foot it is whose shape is that of the other side.
    dark, touch
        Whether to use the dark theme and controls for touch.
    """

    foot_made = Signal(object)
    """Emitted with a `ScannedFoot` for the design stage."""
    unreadable = Signal(object)
    """Emitted with the error if the session cannot be read; the stage closes."""
    closed = Signal()

    def __init__(
        self,
        *,
        jobs: Jobs,
        limits: RegistrationLimits,
        remember: Callable[[RegistrationLimits], None],
        ask: Callable[[str], bool],
        ask_alone: Callable[[str, Side], bool],
        ask_side: Callable[[str, Side], OtherFoot],
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
        self.hold(self.view)
        self.presenter = FootStagePresenter(
            panel=self.view,
            jobs=jobs,
            limits=limits,
            remember=remember,
            hand_over=self.foot_made.emit,
            ask=ask,
            ask_alone=ask_alone,
            ask_side=ask_side,
            finished=self._leave,
            needed_again=self._come_back,
            unreadable=self._give_up,
        )
        box = BoxDragger(lambda: self.presenter.box, self.view.show_box, self.presenter.edit_box)
        self.view.foot.scene.sink = box
        jobs.progressed.connect(self.presenter.progressed)
        self._is_open = True

    def open_session(self, path: Path, hand_over: bool) -> None:
        """Reconstruct a session.

        Parameters
        ----------
        path
            Folder of the session.
        hand_over
            Whether to hand the foot over when it is made, or wait for the user.
        """
        self.path = path
        self.presenter.open(path, hand_over)

    def changeEvent(self, event: QEvent) -> None:
        """Redraw the icons in the theme's colours."""
        if event.type() == QEvent.Type.PaletteChange and self._is_open:
            self.view.renew_icons()
        super().changeEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Cancel the running jobs and let go of the session, which is large."""
        event.accept()
        if self._is_open:
            self._is_open = False
            self._jobs.progressed.disconnect(self.presenter.progressed)
            self.presenter.close()
            self.view.close_scene()
            self.closed.emit()

    def _leave(self, all_done: bool) -> None:
        """Close, or hide until the running jobs are done."""
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
