"""Presenter of the calibration of one sensor; independent of widgets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.calibration.boards.board import Board, Chequerboard
from insole_core.errors import InsoleError
from insole_core.memo import Memo
from insole_core.progress import Progress
from insole_core.sensing.sensor import Sensor, nominal_kinect
from insole_core.workflows.calibration.picture_folders import LiveKind
from insole_core.workflows.calibration.picture_readiness import Readiness
from insole_core.workflows.calibration.report_files import keep_step, step_date
from insole_core.workflows.calibration.sensor_store import (
    SensorStore,
    delivering_raw_numbers,
    measuring_disparity,
)
from insole_core.workflows.calibration.steps import StepResult
from insole_studio.features.calibrate.calibration_steps import STEPS, CalibrationStep
from insole_studio.features.calibrate.rows import BoardSize, CalibrateButtons, LookRow, StepRow
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.services.questions import Answer
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.calibrate.view import CalibrateView

CHANNEL = "calibrate"
_KEPT_PICTURES = 128


class CalibratePresenter:
    """Guides through one sensor, one step and one folder of images at a time.

    Parameters
    ----------
    panel
        The calibrate panel.
    store
        Storage of calibrated sensors.
    jobs
        Runs long computations.
    ask_folder
        Lets the user choose a folder; None if cancelled.
    ask
        Asks whether to save an implausible result; the sentence gives the reason.
    ask_result
        Asks what to do with a result that is not saved; the text is the title of its step.
    """

    def __init__(
        self,
        panel: CalibrateView,
        store: SensorStore,
        jobs: Jobs,
        ask_folder: Callable[[], Path | None],
        ask: Callable[[str], bool],
        *,
        ask_result: Callable[[str], Answer],
    ) -> None:
        self._panel, self._store, self._jobs = panel, store, jobs
        self._ask_folder, self._ask, self._ask_result = ask_folder, ask, ask_result
        self._is_asking = False
        self._then: Callable[[], None] | None = None
        """What waits until the result is saved."""
        self.step_begun: Callable[[], None] = lambda: None
        """Called when the user has opened a step."""
        self._serial = ""
        self._connected: tuple[str, ...] = ()
        self._is_live = False
        self._sensor: Sensor | None = None
        self._step = STEPS[0]
        self._board = BoardSize()
        self._folder: Path | None = None
        self._readiness: Readiness | None = None
        self._seen = Memo(_KEPT_PICTURES)
        self._result: StepResult | None = None
        self._saves = False
        """Whether the result is being written."""
        panel.serial_edited.connect(self.choose_serial)
        panel.step_chosen.connect(self.choose_step)
        panel.board_edited.connect(self.edit_board)
        panel.folder_requested.connect(self.ask_folder)
        panel.look_chosen.connect(self.show_look)
        panel.calibrate_requested.connect(self.calibrate)
        panel.check_requested.connect(self.check)
        panel.save_requested.connect(self.save)
        panel.undo_requested.connect(self.undo)
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._show_buttons)
        self._show_serials()
        panel.show_board(self._board)
        self._open(self._step)

    @property
    def serial(self) -> str:
        """Serial number of the chosen sensor; empty while none is chosen."""
        return self._serial if self._sensor is not None else ""

    @property
    def sensor(self) -> Sensor | None:
        """The sensor as calibrated so far."""
        return self._sensor

    @property
    def step_key(self) -> str:
        """Key of the open step."""
        return self._step.key

    @property
    def live_kind(self) -> LiveKind:
        """Kind of live inspection of the open step."""
        return self._step.live

    @property
    def board(self) -> Board:
        """The board in use."""
        return Chequerboard(self._board.columns, self._board.rows, self._board.square_mm)

    @property
    def readiness(self) -> Readiness | None:
        """Coverage and usability of the images in the folder of the step."""
        return self._readiness

    def set_live(self, on: bool) -> None:
        """Say what to do next with or without a live picture, while nothing else is told."""
        self._is_live = on
        if self._readiness is None and self._result is None:
            self._show_hint()

    def show_connected(self, serials: Sequence[str]) -> None:
        """Offer the sensors that are plugged in, besides those that are stored."""
        if tuple(serials) != self._connected:
            self._connected = tuple(serials)
            self._show_serials()

    def _show_serials(self) -> None:
        self._panel.show_serials(list(dict.fromkeys((*self._connected, *self._store.serials()))))

    @property
    def has_result(self) -> bool:
        """Whether a result is shown that is not saved."""
        return self._result is not None

    def drop_result(self) -> None:
        """Let a result that is not saved be left without a question."""
        self._result = None

    def after_result(self, then: Callable[[], None], *, also_saved: bool = True) -> None:
        """Do something that leaves the result: at once, or when the user has saved or dropped it.

        Parameters
        ----------
        then
            Not called if the user stays, or if the result cannot be saved.
        also_saved
            Whether it is still to be done when saving has opened the next step.
        """
        if self._is_asking:
            return  # a field tells again what was typed when the question takes its focus
        if self._result is not None and not self._is_saving:
            self._is_asking = True
            answer = self._ask_result(self._step.title())
            self._is_asking = False
            if answer is Answer.DISCARD:
                self._drop()
            elif answer is Answer.SAVE:
                self.save()
        if self._result is None:
            then()
            return
        if self._is_saving and also_saved:
            self._then = then
        self._show_chosen()

    def _drop(self) -> None:
        """Take a result away with all that is said of it, also where nothing takes its place."""
        self._result = None
        self._panel.show_error("")
        self._show_hint()
        self._show_buttons()

    @property
    def _is_saving(self) -> bool:
        return self._saves and self._jobs.is_running(CHANNEL)

    def _show_chosen(self) -> None:
        """Show again what stays chosen."""
        self._panel.show_serial(self._serial)
        self._panel.show_board(self._board)
        self._panel.show_steps([self._row(one) for one in STEPS])

    def choose_serial(self, serial: str) -> None:
        """Choose a sensor; one without a calibration starts from nominal values."""
        if serial.strip() == self._serial:
            return  # leaving the field also emits this signal
        self.after_result(lambda: self._choose_serial(serial))

    def _choose_serial(self, serial: str) -> None:
        self._panel.show_serial(serial.strip())
        self._serial, self._sensor = serial.strip(), None
        try:
            if self._serial:
                self._sensor = self._store.load(self._serial) or nominal_kinect(self._serial)
        except InsoleError as error:
            self._open(self._step)
            self._panel.show_error(str(error))
            return
        self._open(self._first_undone())

    def meet(self, factory: Sensor) -> None:
        """Start from what the factory of the chosen sensor calibrated, if nothing is stored.

        Parameters
        ----------
        factory
            The calibration that the sensor itself tells.
        """
        known = self._sensor
        if known is None or known.serial != factory.serial or factory.depth_unit_mm is None:
            return
        if self.has_result:
            return
        if known.depth_unit_mm is None and self._store.load(factory.serial) is None:
            self._sensor = factory
            self._open(self._first_undone())

    def choose_step(self, key: str) -> None:
        """Open a step."""

        def choose() -> None:
            self._open(next(step for step in STEPS if step.key == key))
            self.step_begun()

        self.after_result(choose)

    def edit_board(self, board: BoardSize) -> None:
        """Set the board and inspect the images again."""

        def edit() -> None:
            self._board = board
            self._panel.show_board(board)
            if self._folder is not None and self._step.uses_board:
                self.look_at(self._folder)

        self.after_result(edit)

    def ask_folder(self) -> None:
        """Let the user choose the folder of images, and inspect it."""
        folder = self._ask_folder()
        if folder is not None:
            self.after_result(lambda: self.look_at(folder), also_saved=False)

    def look_at(self, folder: Path) -> None:
        """Inspect every image of a folder in the background."""
        self._forget()
        self._folder = folder
        step, sensor = self._step, self._sensor
        if self._lack(step):
            return

        def inspect(progress: Progress) -> Readiness:
            assert sensor is not None
            return step.inspect(folder, self.board, sensor, self._seen, progress)

        self._start(inspect, self._show_readiness)

    def show_look(self, index: int) -> None:
        """Show one of the inspected images."""
        if self._readiness is not None and 0 <= index < len(self._readiness.looks):
            self._panel.show_picture(self._readiness.looks[index].picture)

    def calibrate(self) -> None:
        """Run the step in the background."""
        folder, sensor, step = self._folder, self._sensor, self._step
        if folder is None or sensor is None:
            return

        def work(progress: Progress) -> StepResult:
            return step.calibrate(folder, self.board, sensor, progress)

        self._start(work, self._show_result)

    def check(self) -> None:
        """Say by the newest wall, in the background, whether the kept pattern still holds."""
        folder, sensor, check = self._folder, self._sensor, self._step.check
        if folder is None or sensor is None or check is None:
            return

        def work(progress: Progress) -> tuple[str, ...]:
            progress.step(0.1, tr("Comparing the wall with the pattern"))
            return check(folder, sensor, self._store.reference(sensor.serial))

        self._start(work, self._show_check)

    def save(self) -> None:
        """Save the result and its reports for this sensor; ask first if implausible."""
        result = self._result
        if result is None or (result.doubt and not self._ask(result.doubt)):
            return

        def keep(progress: Progress) -> Sensor | None:
            progress.step(0.1, tr("Writing the calibration and its reports"))
            keep_step(result, self._store)
            return self._store.load(result.sensor.serial)  # with the date of the step

        self._start(keep, self._saved)
        self._saves = True

    def undo(self) -> None:
        """Take the sensor back to before its last step, or redo it after that."""
        self.after_result(self._undo, also_saved=False)

    def _undo(self) -> None:
        serial = self._serial

        def exchange(_progress: Progress) -> Sensor:
            self._store.undo(serial)
            return self._store.load(serial) or nominal_kinect(serial)

        self._start(exchange, self._undone)

    def _undone(self, sensor: Sensor) -> None:
        self._sensor = sensor
        self._show_serials()
        self._open(self._first_undone())
        said = tr("Sensor {serial} is as it was before the last change.")
        self._panel.show_next([said.format(serial=self._serial)])

    def _can_undo(self) -> bool:
        try:
            return bool(self._serial) and self._store.can_undo(self._serial)
        except InsoleError:
            return False  # no serial number, which was told when it was given

    def _knows_pattern(self) -> bool:
        known = self._sensor is not None and self._step.check is not None
        return known and self._store.has_reference(self._serial)

    def _start(self, work: Callable[[Progress], Any], done: Callable[[Any], None]) -> None:
        self._panel.show_error("")
        self._saves, self._then = False, None
        self._jobs.start(CHANNEL, work, done, self._show_failure)
        self._show_buttons()

    def _open(self, step: CalibrationStep) -> None:
        self._jobs.cancel(CHANNEL)
        self._step, self._folder = step, None
        self._forget()
        self._panel.show_step(
            step.title(), step.instruction(), step.uses_board, step.check is not None
        )
        self._panel.show_error(self._lack(step))
        self._panel.show_steps([self._row(one) for one in STEPS])
        self._show_hint()

    def _show_hint(self) -> None:
        """Say how the pictures of the step come."""
        if self._sensor is None:
            hint = tr("Give the serial number of the sensor, as it stands on its label.")
        elif self._is_live:
            hint = tr("Take pictures, or choose the folder with these images.")
        else:
            hint = tr("Start the live picture, or choose the folder with these images.")
        self._panel.show_next([hint])

    def _lack(self, step: CalibrationStep) -> str:
        """Return why a step is not for the chosen sensor, a sentence; empty where it is."""
        if self._sensor is None:
            return ""
        try:
            (measuring_disparity if step.live == "walls" else delivering_raw_numbers)(self._sensor)
        except InsoleError as error:
            return str(error)
        return ""

    def _row(self, step: CalibrationStep) -> StepRow:
        done = step_date(self._store, self._serial, step.key) if self._sensor is not None else ""
        title = step.title() + (" – " + tr("optional") if step.optional else "")
        return StepRow(step.key, title, done, step is self._step)

    def _first_undone(self) -> CalibrationStep:
        if self._sensor is None:
            return STEPS[0]
        undone = [
            step
            for step in STEPS
            if not step.optional
            and not self._lack(step)
            and not step_date(self._store, self._serial, step.key)
        ]
        return undone[0] if undone else self._step

    def _forget(self) -> None:
        self._readiness = self._result = None
        self._panel.show_looks([])
        self._panel.show_no_picture(
            tr("Waiting for the first picture.")
            if self._is_live
            else tr("No picture yet: start the live picture, or choose a folder.")
        )
        self._show_buttons()

    def _show_readiness(self, readiness: Readiness) -> None:
        self._readiness = readiness
        rows = [LookRow(look.name, look.usable, look.sentence) for look in readiness.looks]
        self._panel.show_looks(rows)
        self.show_look(0)
        usable = tr("{usable} of {count} can be used.").format(
            usable=readiness.usable, count=len(rows)
        )
        enough = () if readiness.missing else (tr("Nothing is missing: calibrate."),)
        self._panel.show_next([usable, *readiness.missing, *enough])
        self._show_buttons()

    def _show_result(self, result: StepResult) -> None:
        self._result = result
        self._panel.show_error(result.doubt)
        question = tr("Save it, if this is what you expect.")
        self._panel.show_next([*result.warnings, *result.sentences, *result.advice, question])
        self._show_buttons()

    def _show_check(self, sentences: tuple[str, ...]) -> None:
        self._panel.show_next(sentences)
        self._show_buttons()

    def _saved(self, sensor: Sensor | None) -> None:
        self._saves = False
        then, self._then = self._then, None
        self._sensor = sensor
        self._show_serials()
        done, following = self._step.title(), self._first_undone()
        self._open(following)
        saved = tr("{step} is saved for sensor {serial}.").format(step=done, serial=self._serial)
        if following.title() == done:
            self._panel.show_next([saved, tr("The sensor is calibrated.")])
        else:
            after = tr("Next: {step}.").format(step=following.title())
            self._panel.show_next([saved, after])
        if then is not None:
            then()

    def _show_failure(self, error: Exception) -> None:
        sentence = tr("Something unexpected happened; nothing was changed. Please report it.")
        self._saves, self._then = False, None
        self._panel.show_error(str(error) if isinstance(error, InsoleError) else sentence)
        self._show_buttons()

    def _show_progress(self, news: JobProgress) -> None:
        self._panel.show_progress(news.fraction, news.text)

    def _show_buttons(self, _channel: str = CHANNEL) -> None:
        idle = not self._jobs.is_running(CHANNEL)
        if idle:
            self._panel.show_progress(0.0, "")
        busy = "" if idle else tr("It is still working; wait a moment.")
        nothing_to_save = "" if self._result is not None else tr("There is no result to save yet.")
        nothing_to_undo = "" if self._can_undo() else tr("Nothing was saved that can be undone.")
        unusable = self._why_unusable
        unknown = "" if self._knows_pattern() else tr("No pattern is kept to compare it with.")
        self._panel.show_buttons(
            CalibrateButtons(
                choose=busy or self._why_not_choose,
                calibrate=busy or unusable,
                check=busy or unusable or unknown,
                save=busy or nothing_to_save,
                undo=busy or nothing_to_undo,
            )
        )

    @property
    def _why_not_choose(self) -> str:
        if self._sensor is None:
            return tr("Give the serial number of the sensor, as it stands on its label.")
        return self._lack(self._step)

    @property
    def _why_unusable(self) -> str:
        if self._readiness is None:
            return tr("Take pictures, or choose the folder with these images.")
        return "" if self._readiness.usable else tr("None of the pictures can be used yet.")
