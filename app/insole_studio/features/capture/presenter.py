"""Presenter of the capture stage: connects its panel with the capture service."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

from insole_core.errors import InsoleError, UsageError
from insole_core.files.atomic import make_output_folder
from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.side import BOTH, Side, Sides
from insole_core.history import History
from insole_core.messages import Message, joined
from insole_core.progress import Progress
from insole_core.recording.session import CaptureCondition, Manifest
from insole_studio.acquisition.capture_plan import CapturePlan, PlanRequest
from insole_studio.acquisition.capture_setup import CaptureSetup
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.messages import (
    Cancel,
    Capability,
    CapturePhase,
    CaptureStatus,
    Command,
    Event,
    Find,
    Identify,
    Placed,
    Sensors,
    SensorState,
    Start,
    Tilt,
    Tune,
    Tuning,
    ViewStatus,
)
from insole_studio.acquisition.sensor_port import lacking
from insole_studio.acquisition.unfinished_captures import (
    KEPT_DAYS,
    Drafts,
    UnfinishedCapture,
    hold_draft,
    hold_unfinished,
)
from insole_studio.features.capture.rows import CaptureOptions, CaptureRow, SensorRow
from insole_studio.features.capture.scan import Scan
from insole_studio.features.capture.sensor_watch import Pictures, SensorWatch
from insole_studio.features.capture.view_assignment import ViewAssignment, options_of
from insole_studio.jobs import Jobs
from insole_studio.texts import tr
from insole_studio.view_names import views_text

TILT_STEP_DEG = 2.0
_PUBLISHING = "publish"


class CapturePanel(Protocol):
    """The capture panel as its presenter sees it, with the signals it emits."""

    capture_requested: Any
    cancel_requested: Any
    placed_requested: Any
    retake_requested: Any
    use_requested: Any
    other_foot_requested: Any
    find_requested: Any
    view_chosen: Any
    views_swapped: Any
    tilt_requested: Any
    level_requested: Any
    identify_requested: Any
    tuning_edited: Any
    undo_requested: Any
    redo_requested: Any
    options_edited: Any
    resume_requested: Any
    discard_requested: Any

    def show_sensors(self, rows: Sequence[SensorRow]) -> None: ...  # noqa: D102
    def show_pictures(  # noqa: D102
        self, serial: str, depth: ByteArray | None, color: ByteArray | None
    ) -> None: ...
    def show_capture(self, row: CaptureRow) -> None: ...  # noqa: D102
    def show_options(self, options: CaptureOptions) -> None: ...  # noqa: D102
    def show_empty(self, sentence: str) -> None: ...  # noqa: D102
    def show_sentence(self, sentence: str) -> None: ...  # noqa: D102


class Service(Pictures, Protocol):
    """The part of the capture service that the presenter uses."""

    def send(self, command: Command) -> None: ...  # noqa: D102
    def news(self) -> list[Event]: ...  # noqa: D102


class CapturePresenter:
    """Shows the sensors live, captures, and passes the session on.

    Parameters
    ----------
    panel
        The capture panel.
    service
        The capture service.
    setup
        Reference system and sensors.
    jobs
        For guidance and writing; separate from the window's jobs, whose progress is shown.
    assignment
        Last assignment: pairs of view and serial number.
    folder
        For drafts and finished sessions.
    options
        Initial options.
    remember
        Called with each new assignment.
    kept
        Called with the path of each finished session.
    finished
        Called when no further capture follows.
    ask
        Asks whether to use a scan that lacks some of its views.
    """

    def __init__(
        self,
        *,
        panel: CapturePanel,
        service: Service,
        setup: CaptureSetup,
        jobs: Jobs,
        assignment: Sequence[tuple[str, str]],
        folder: Path,
        options: CaptureOptions,
        remember: Callable[[Sequence[tuple[str, str]]], None],
        kept: Callable[[Path], None],
        finished: Callable[[], object],
        ask: Callable[[str], bool],
    ) -> None:
        self._panel = panel
        self._service = service
        self._setup = setup
        self._jobs = jobs
        self._assignment = ViewAssignment(assignment)
        self._folder = folder
        self._remember = remember
        self._kept = kept
        self._finish = finished
        self._ask = ask
        self._sensors = Sensors(())
        self._tuned: History[tuple[str, Tuning]] = History()
        """What was set of the sensors, by their serial numbers."""
        self._watches: dict[str, SensorWatch] = {}
        self._status: CaptureStatus | None = None
        self._drafts = Drafts(folder / "captures")
        self._scan: Scan | None = None
        self._earlier: Scan | None = None
        """What comes back if the capture that is to replace it does not succeed."""
        self._is_earlier_back = False
        ended = self._drafts.sweep()
        self._left = self._drafts.left()
        self.options = options
        self._connect(panel)
        panel.show_options(self.options)
        self._show()
        if ended:
            panel.show_sentence(_ended(ended))

    def _connect(self, panel: CapturePanel) -> None:
        panel.capture_requested.connect(self.capture)
        panel.cancel_requested.connect(lambda: self._service.send(Cancel()))
        panel.placed_requested.connect(lambda: self._service.send(Placed()))
        panel.retake_requested.connect(self.retake)
        panel.use_requested.connect(self.use)
        panel.other_foot_requested.connect(self.turn_to_other_foot)
        panel.find_requested.connect(self.find)
        panel.view_chosen.connect(self.name_view)
        panel.views_swapped.connect(self.swap_views)
        panel.tilt_requested.connect(lambda s, by: self._service.send(Tilt(s, by)))
        panel.level_requested.connect(lambda s: self._service.send(Tilt(s, None)))
        panel.identify_requested.connect(lambda s, on: self._service.send(Identify(s, on)))
        panel.tuning_edited.connect(self.tune)
        panel.undo_requested.connect(lambda: self._restore(self._tuned.undo))
        panel.redo_requested.connect(lambda: self._restore(self._tuned.redo))
        panel.options_edited.connect(self.edit_options)
        panel.resume_requested.connect(self.resume)
        panel.discard_requested.connect(self.discard)

    @property
    def is_capturing(self) -> bool:
        """Whether a capture is running."""
        return self._status is not None and not self._status.phase.is_end

    def tick(self) -> None:
        """Fetch events and the newest images; called many times a second."""
        news = self._service.news()
        for event in news:
            self._take(event)
        self._welcome()
        for state in self._sensors.states:
            watch = self._watches[state.serial]
            depth, color = watch.look(state, self._service)
            if depth is not None or color is not None:
                self._panel.show_pictures(state.serial, depth, color)
        if not self.is_capturing or self._waits_for_hand:
            self._guide()
        if news:
            self._show()

    def find(self) -> None:
        """Look for sensors again."""
        self._sensors = Sensors(())
        self._service.send(Find())
        self._show()

    def capture(self) -> None:
        """Capture all views, or those that a failed capture is missing."""
        plan = self._plan(self._panel.show_sentence)
        if plan is None or self._is_busy:
            return
        scan = self._scan
        missing = [v for v in plan.views if v not in scan.finished] if scan is not None else []
        if scan is None or not missing or scan.order != plan.views:
            try:
                scan = self._begin_scan(plan)
            except InsoleError as error:
                self._show_error(error)
                return
            missing = list(plan.views)
        self._start(scan, plan.only(missing))

    def retake(self, view: str) -> None:
        """Capture one view again, with its bursts."""
        plan = self._plan(self._panel.show_sentence)
        if plan is not None and self._scan is not None and not self._is_busy:
            views = [shot.view for shot in plan.shots if shot.place == view]
            self._start(self._scan, plan.only(views))

    def resume(self) -> None:
        """Continue the unfinished capture that is offered; what is there now is offered in turn."""
        if not self._left or self._is_busy:
            return
        try:
            self._use_setup(self._left[0].manifest.side)
            held, left = hold_unfinished(self._left[0].folder)
        except InsoleError as error:
            self._offer_left()
            self._show_error(error)
            return
        self._leave_scan()
        self._scan = Scan(held, left.order, left.views)
        self._offer_left()
        self._assignment.take(left.request.assignment)
        condition = left.manifest.capture_condition or CaptureCondition()
        self._choose(
            replace(
                options_of(left.request, self.options),
                side=left.manifest.side,
                weight_bearing=condition.weight_bearing,
                held=condition.held,
                notes=condition.notes,
            )
        )

    def discard(self) -> None:
        """Delete the unfinished capture that is offered."""
        try:
            if self._left:
                hold_draft(self._left[0].folder).discard()
        except InsoleError as error:
            self._show_error(error)
        self._offer_left()

    def close(self) -> None:
        """Leave the drafts to others."""
        for scan in (self._scan, self._earlier):
            if scan is not None:
                scan.release()

    def use(self) -> None:
        """Keep the session and finish."""
        self._publish(self._finish)

    def turn_to_other_foot(self) -> None:
        """Keep the session of this foot and begin with the other."""
        other = Side.RIGHT if self.options.side is Side.LEFT else Side.LEFT
        self._publish(lambda: self._turn_to(other))

    def name_view(self, serial: str, view: str) -> None:
        """Assign a view to a sensor; the sensor that had it gets this one's view."""
        self._assignment.name(serial, view)
        self._assigned()

    def swap_views(self, one: str, other: str) -> None:
        """Swap the views of two sensors."""
        if one != other and not self.is_capturing:
            self._assignment.swap(one, other)
            self._assigned()

    def tune(self, serial: str, change: Tuning) -> None:
        """Set something of a sensor; what is None in the change stays."""
        state = next((one for one in self._sensors.states if one.serial == serial), None)
        if state is None or self.is_capturing:
            return
        before = state.tuning.of_what_sets(change)
        if before != change:
            run = "" if change.laser_mw is None else serial
            self._tuned.push((serial, before), (serial, change), serial, run)
        self._service.send(Tune(serial, change))

    def end_merging(self) -> None:
        """Do not undo the next power of a projector together with the last one."""
        self._tuned.end_merging()

    def _restore(self, step: Callable[[], tuple[str, Tuning] | None]) -> None:
        """Set what was set before the last change, or after it."""
        restored = None if self.is_capturing else step()
        if restored is not None:
            self._service.send(Tune(*restored))

    def edit_options(self, options: CaptureOptions) -> None:
        """Apply the options; another side begins a new capture."""
        if options.side != self.options.side:
            try:
                self._use_setup(options.side)
            except InsoleError as error:
                self._panel.show_options(self.options)
                self._show_error(error)
                return
            self._leave_scan()
            self._offer_left()
        self.options = options
        self._show()

    def _use_setup(self, side: Sides) -> None:
        """Take the reference system that has a place for each foot.

        Raises
        ------
        InputError
            When there is none.
        """
        setup = self._setup.of_side(side)
        if setup is not self._setup:
            self._setup = setup
            self._watches.clear()
            self._welcome()

    def _take(self, event: Event) -> None:
        if isinstance(event, Sensors):
            self._sensors = event
        elif isinstance(event, CaptureStatus):
            self._status = event
            if self._scan is not None:
                self._scan.take(event)
            if event.phase.is_end:
                self._end(event)
        elif isinstance(event, Message):
            self._panel.show_sentence(event)

    def _end(self, status: CaptureStatus) -> None:
        """Keep what a capture has; one that was to replace a scan does so only if it succeeds."""
        if status.phase is CapturePhase.FAILED:
            self._panel.show_sentence(status.sentence)
        if status.phase is not CapturePhase.DONE and self._scan is not None:
            self._scan.look_on_disk()
        earlier, self._earlier = self._earlier, None
        if earlier is None:
            return
        if status.phase is CapturePhase.DONE:
            earlier.release()
        else:
            self._leave_scan()
            self._scan, self._is_earlier_back = earlier, True
            self._status = replace(status, views=())
        self._offer_left()

    def _welcome(self) -> None:
        """Assign views to new sensors, and start following each sensor."""
        serials = [state.serial for state in self._sensors.states]
        for serial, factory in ((one.serial, one.factory) for one in self._sensors.states):
            self._assignment.welcome(serial, serials, self.options.side)
            view, watch = self._view_of(serial), self._watches.get(serial)
            if watch is None or watch.view != view:
                self._watches[serial] = SensorWatch(self._setup, serial, view, factory)

    def _view_of(self, serial: str) -> str:
        """Return the view a sensor captures next; a sensor moved by hand captures several."""
        running = self._status.views if self._status is not None and self.is_capturing else ()
        coming = (view for view in running if view.serial == serial and not view.finished)
        return next((view.place for view in coming), self._assignment.view(serial))

    def _guide(self) -> None:
        """Judge the images of the sensors in turn, in the background."""
        if self._jobs.is_running("guide"):
            return
        waiting = [self._watches[s.serial] for s in self._sensors.states if s.problem is None]
        watch = min(waiting, key=lambda w: w.guided_at_s, default=None)
        task = watch.guidance_task() if watch is not None else None
        if watch is not None and task is not None:
            self._jobs.start("guide", task, watch.take_guidance, self._show_error)

    @property
    def _request(self) -> PlanRequest:
        ready = [state for state in self._sensors.states if state.problem is None]
        serials = [state.serial for state in ready]
        return self._assignment.request(serials, self.options, lacking(ready, Capability.TILT))

    def _plan(self, tell: Callable[[str], None] = lambda _sentence: None) -> CapturePlan | None:
        try:
            return self._request.plan()
        except UsageError as error:
            tell(str(error))
            return None

    @property
    def _is_busy(self) -> bool:
        return self.is_capturing or self._jobs.is_running(_PUBLISHING)

    def _begin_scan(self, plan: CapturePlan) -> Scan:
        stamp = datetime.now().strftime("%Y-%m-%d-%H%M%S")
        held = self._drafts.begin(f"{stamp}-{self.options.side}")
        if self._scan is not None and self._scan.finished:
            self._earlier = self._scan
        else:
            self._leave_scan()
        self._scan = Scan(held, plan.views)
        return self._scan

    def _start(self, scan: Scan, plan: CapturePlan) -> None:
        self._status = CaptureStatus(CapturePhase.SETTLING, (), tr("Starting"))
        self._is_earlier_back = False
        self._service.send(Start(plan, scan.folder, self._manifest(), scan.order))
        self._show()

    def _manifest(self) -> Manifest:
        options, place = self.options, self._setup
        return Manifest(
            recorded_at=datetime.now(UTC).isoformat(timespec="seconds"),
            side=options.side,
            reference_system=place.system,
            views=(),
            volume_of_interest=place.volume_of_interest,
            capture_condition=self._condition,
            extra=self._request.as_extra(),
        )

    @property
    def _condition(self) -> CaptureCondition:
        options = self.options
        return CaptureCondition(options.weight_bearing, options.held, options.notes)

    def _publish(self, then: Callable[[], object]) -> None:
        scan = self._scan
        if scan is None or not scan.finished or self._is_busy:
            return
        if not scan.is_whole and not self._ask(_counted(scan)):
            return
        draft, order, condition = scan.folder, scan.order, self._condition
        path = self._folder / "sessions" / draft.name

        def write(progress: Progress) -> Path:
            progress.step(0.0, tr("Checking the session"))
            make_output_folder(path.parent)
            reopened = Draft.reopen(draft, order)
            reopened.describe(condition)  # what was entered since the capture began
            reopened.publish(path)
            return path

        def written(done: Path) -> None:
            self._leave_scan()
            self._offer_left()
            self._kept(done)
            then()

        self._jobs.start(_PUBLISHING, write, written, self._show_error)

    def _leave_scan(self) -> None:
        """Leave the scan, if there is one, on the disk, where it can be offered."""
        if self._scan is not None:
            self._scan.release()
        self._scan = self._status = None
        self._is_earlier_back = False

    def _offer_left(self) -> None:
        self._left = self._drafts.left()
        self._show()

    def _turn_to(self, side: Side) -> None:
        self._choose(replace(self.options, side=side))

    def _choose(self, options: CaptureOptions) -> None:
        self.options = options
        self._panel.show_options(options)
        self._show()

    def _assigned(self) -> None:
        self._remember(self._assignment.pairs)
        self._show()

    def _show_error(self, error: Exception) -> None:
        if not isinstance(error, InsoleError):
            raise error
        self._panel.show_sentence(str(error))

    def _show(self) -> None:
        self._welcome()
        states = sorted(self._sensors.states, key=lambda state: self._assignment.view(state.serial))
        if states:
            self._panel.show_sensors([self._row(state) for state in states])
        else:
            self._panel.show_empty(self._sensors.problem or tr("Looking for sensors"))
        self._panel.show_capture(self._capture_row())

    def _row(self, state: SensorState) -> SensorRow:
        watch = self._watches[state.serial]
        return SensorRow(
            serial=state.serial,
            view=self._assignment.view(state.serial),
            title=watch.title(),
            facts=watch.facts(state),
            hints=watch.hints,
            problem=state.problem,
            progress=self._progress_of(state.serial),
            retakes=() if self.is_capturing else self._retakes(state.serial),
            capabilities=state.capabilities,
            tuning=state.tuning,
            laser_range=state.laser_range,
            can_tune=not self.is_capturing,
        )

    def _retakes(self, serial: str) -> tuple[str, ...]:
        """Return the positions of a sensor at which all its views are complete."""
        finished = self._finished
        plan = self._plan() if finished else None
        shots = [shot for shot in plan.shots if shot.serial == serial] if plan is not None else []
        missing = {shot.place for shot in shots if shot.view not in finished}
        return tuple(dict.fromkeys(s.place for s in shots if s.place not in missing))

    @property
    def _finished(self) -> tuple[str, ...]:
        return self._scan.finished if self._scan is not None else ()

    @property
    def _views(self) -> tuple[ViewStatus, ...]:
        return self._scan.views(self._status) if self._scan is not None else ()

    def _progress_of(self, serial: str) -> str:
        own = [view for view in self._views if view.serial == serial]
        if not own:
            return ""
        taken, wanted = sum(view.frames for view in own), sum(view.wanted for view in own)
        return tr("{taken} of {wanted}").format(taken=taken, wanted=wanted)

    def _capture_row(self) -> CaptureRow:
        status, running = self._status, self.is_capturing
        states = self._sensors.states
        return CaptureRow(
            running=running,
            fraction=status.fraction if status is not None else 0.0,
            sentence=self._status_sentence(),
            button=self._button(),
            can_capture=not running and any(s.problem is None for s in states),
            can_use=not running and bool(self._finished),
            is_whole=not running and self._is_whole,
            waits_for_hand=self._waits_for_hand,
            offer=_offer(self._left) if self._left and not running else "",
            can_tilt=not states or len(lacking(states, Capability.TILT)) < len(states),
        )

    def _status_sentence(self) -> str:
        parts = [] if self._status is None else [_describe(self._status, self._views)]
        if self._scan is not None and self._finished and not (self.is_capturing or self._is_whole):
            parts.append(_counted(self._scan))
        if parts and self._is_earlier_back:
            parts.append(tr("The earlier scan is kept."))
        if self._sensors.states and self._sensors.problem and not self.is_capturing:
            parts.append(self._sensors.problem)
        return joined(parts, " ")

    @property
    def _waits_for_hand(self) -> bool:
        return self._status is not None and self._status.phase is CapturePhase.MOVING

    def _button(self) -> str:
        if not self._finished:
            return tr("Capture")
        return tr("Capture anew") if self._is_whole else tr("Capture missing views")

    @property
    def _is_whole(self) -> bool:
        return self._scan is not None and self._scan.is_whole


def _counted(scan: Scan) -> str:
    """Return the text that tells how many of its views a scan has."""
    there = len(set(scan.order) & set(scan.finished))
    text = tr("{there} of {wanted} views are there.")
    return text.format(there=there, wanted=len(scan.order))


def _ended(count: int) -> str:
    """Return the text that tells of captures that were removed."""
    if count == 1:
        text = tr("A capture that was not used for {days} days was removed.")
    else:
        text = tr("{count} captures that were not used for {days} days were removed.")
    return text.format(count=count, days=KEPT_DAYS)


def _offer(all_left: Sequence[UnfinishedCapture]) -> str:
    """Return the text that offers to continue the latest of the unfinished captures."""
    left, *others = all_left
    begun = datetime.fromisoformat(left.manifest.recorded_at).astimezone()
    if left.manifest.side == BOTH:
        text = tr(
            "The capture of {time} (both feet) was not used; {there} of {wanted} views are there."
        )
    else:
        text = tr(
            "The capture of {time} ({side} foot) was not used; {there} of {wanted} views are there."
        )
    if others:
        text += " " + tr("Before it: {count} more, offered after it.")
    text += " " + tr("It is kept until {day}.")
    return text.format(
        count=len(others),
        day=left.kept_until.isoformat(),
        time=begun.strftime("%Y-%m-%d %H:%M"),
        side=tr("left") if left.manifest.side is Side.LEFT else tr("right"),
        there=len(left.manifest.views),
        wanted=len(left.order),
    )


def _describe(status: CaptureStatus, views: Sequence[ViewStatus]) -> str:
    if status.phase is CapturePhase.DONE:
        warned = [text for view in views for text in view.warnings]
        return joined(dict.fromkeys(warned), " ") or tr("All views are captured.")
    sentences = {
        CapturePhase.MOVING: tr(
            "Put the sensor in its place for view {view}, then say that it stands."
        ),
        CapturePhase.TILTING: tr("Tilting the sensor for view {view}"),
        CapturePhase.SETTLING: tr("Waiting for steady depth of view {view}"),
        CapturePhase.CAPTURING: tr("Capturing view {view}"),
        CapturePhase.VERIFYING: tr("Checking view {view}"),
        CapturePhase.CANCELLED: tr("The capture was stopped."),
    }
    return sentences.get(status.phase, status.sentence).format(view=views_text(status.names))
