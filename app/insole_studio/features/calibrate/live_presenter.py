"""Presenter of the live images of the open step; independent of widgets."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InsoleError
from insole_core.workflows.calibration.picture_folders import LiveKind, folder_of_today
from insole_studio.features.calibrate.live_pictures import LiveInspection, LivePictures
from insole_studio.features.calibrate.presenter import CalibratePresenter
from insole_studio.features.calibrate.rows import LiveRow
from insole_studio.jobs import Jobs
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.calibrate.view import CalibrateView

_GLANCE, _KEEP = "calibrate glance", "calibrate keep"


class LivePresenter:
    """Shows and captures live images of the sensor chosen in the calibrate presenter.

    Parameters
    ----------
    panel
        The calibrate panel.
    presenter
        Provides sensor, step and board; inspects the folder after an image was added.
    live
        The image stream.
    jobs
        Runs the inspections.
    root
        Folder of all images; they are saved by sensor, day and step.
    """

    def __init__(
        self,
        panel: CalibrateView,
        presenter: CalibratePresenter,
        live: LivePictures,
        jobs: Jobs,
        root: Path,
    ) -> None:
        self._panel, self._presenter = panel, presenter
        self._live, self._jobs, self._root = live, jobs, root
        self._automatic = True
        self._sentence = ""
        self._begun = ""
        """Serial number of the sensor that the open step was begun with."""
        self._is_missing = False
        """Whether it was told that this sensor is not there."""
        self._goes_to: tuple[Path, LiveKind] | None = None
        """Destination of the running capture, kept even if another step is opened meanwhile."""
        panel.live_toggled.connect(self.toggle)
        panel.automatic_toggled.connect(self.set_automatic)
        panel.take_requested.connect(self.take)
        presenter.step_begun = self._begin_step
        self._show()

    def toggle(self, on: bool) -> None:
        """Start or stop the sensors."""
        if on:
            self._live.start()
            self._presenter.set_live(True)
            self._begin_step()
        else:
            self.close()
        self._show()

    def set_automatic(self, on: bool) -> None:
        """Switch automatic capture, when the board or wall is steady in a new pose, on or off."""
        self._automatic = on

    def take(self) -> None:
        """Capture an image, which takes the place of a result that is shown."""
        self._presenter.after_result(self._take, also_saved=False)

    def _take(self) -> None:
        folder, kind = self._folder(), self._presenter.live_kind
        if folder is None or self._why_not_take or self._jobs.is_running(_KEEP):
            return
        if kind == "infrared":
            work = self._live.take_infrared(folder)
            if work is not None:
                self._jobs.start(_KEEP, work, self._kept, self._fail)
        else:
            self._goes_to = folder, kind
            self._live.take(self._presenter.serial, kind)
        self._show()

    def tick(self) -> None:
        """Process what has arrived; called many times a second."""
        if not self._live.running:
            return
        states = self._live.states
        self._presenter.show_connected([state.serial for state in states])
        if states and not self._presenter.serial:
            self._panel.show_serial(states[0].serial)
            self._presenter.choose_serial(states[0].serial)
        if self._presenter.serial != self._begun:  # what is under way shows another sensor
            self._begin_step()
        for state in states:
            if state.factory is not None and state.serial == self._presenter.serial:
                self._presenter.meet(state.factory)
        taken = self._live.poll(self._presenter.serial, self._presenter.live_kind)
        if taken is not None:
            self._keep(taken)
        self._tell_missing()
        self._glance()
        self._show()

    def _tell_missing(self) -> None:
        """Take the picture away, once, when the chosen sensor is not there."""
        is_missing = bool(self._live.states) and not self._live.is_connected(self._begun)
        if is_missing and not self._is_missing:
            self._jobs.cancel(_GLANCE)
            self._panel.show_no_picture(self._live.problem)
        self._is_missing = is_missing

    def close(self) -> None:
        """Stop the sensors."""
        self._jobs.cancel(_GLANCE)
        self._live.stop()
        self._presenter.set_live(False)
        self._sentence = ""

    def _begin_step(self) -> None:
        self._jobs.cancel(_GLANCE)
        self._live.forget_places()
        self._sentence, self._begun, self._is_missing = "", self._presenter.serial, False
        folder = self._folder()
        if self._live.running and folder is not None and folder.is_dir():
            self._look_at(folder)

    def _folder(self) -> Path | None:
        presenter = self._presenter
        if not presenter.serial:
            return None
        return folder_of_today(self._root, presenter.serial, presenter.step_key)

    def _glance(self) -> None:
        kind, sensor = self._presenter.live_kind, self._presenter.sensor
        if sensor is None or self._jobs.is_running(_GLANCE):
            return
        board, known = self._presenter.board, self._presenter.readiness
        task = self._live.glance_task(kind, sensor, board, known)
        if task is not None:
            self._jobs.start(_GLANCE, task, self._show_glance, self._fail)

    def _show_glance(self, glance: LiveInspection) -> None:
        if not self._live.running:
            return
        self._panel.show_picture(glance.picture)
        self._sentence = glance.sentence
        is_wanted = self._automatic and not self._presenter.has_result
        if self._live.is_worth_taking(glance) and is_wanted:
            self._take()
        self._show()

    def _keep(self, taken: Path) -> None:
        assert self._goes_to is not None
        work = self._live.keep_task(taken, *self._goes_to)
        self._jobs.start(_KEEP, work, self._kept, self._fail)

    def _kept(self, folder: Path) -> None:
        self._live.end_taking()
        if folder == self._folder():  # otherwise another step was opened meanwhile
            self._look_at(folder)

    def _look_at(self, folder: Path) -> None:
        if not self._presenter.has_result:  # what is looked at would take its place
            self._presenter.look_at(folder)

    def _fail(self, error: Exception) -> None:
        self._live.end_taking()
        unexpected = tr("Something unexpected happened; nothing was changed. Please report it.")
        self._live.problem = str(error) if isinstance(error, InsoleError) else unexpected

    def _show(self) -> None:
        running = self._live.running
        self._panel.show_live(
            LiveRow(
                running=running,
                sentence=self._status_sentence() if running else "",
                why_not_take=self._why_not_take,
            )
        )

    @property
    def _why_not_take(self) -> str:
        """Why no picture can be taken; empty where the chosen sensor is there, and was seen."""
        if not (self._live.running and self._live.is_connected(self._presenter.serial)):
            return tr("The sensor is not plugged in.")
        if self._live.taking:
            return tr("Taking the picture: hold still.")
        return "" if self._sentence else tr("Waiting for the first picture.")

    def _status_sentence(self) -> str:
        if self._live.problem:
            return self._live.problem
        if self._live.taking:
            return tr("Taking the picture: hold still.")
        return self._sentence or tr("Waiting for the first picture.")
