"""The state machine of a capture: one sensor after the other, the emitters of the others off."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace

from insole_core.errors import InsoleError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.messages import Message, joined
from insole_core.progress import Cancelled
from insole_studio.acquisition.capture_plan import CapturePlan, CaptureStep, Shot
from insole_studio.acquisition.capture_setup import Calibrated, CaptureSetup
from insole_studio.acquisition.draft import Draft, ViewFacts
from insole_studio.acquisition.infrared_series import PICTURES, InfraredSeries
from insole_studio.acquisition.light import judge_light
from insole_studio.acquisition.messages import Capability, CapturePhase, CaptureStatus, ViewStatus
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import (
    BusFullError,
    ColorSize,
    OpenSensor,
    SensorError,
    require,
)
from insole_studio.acquisition.view_frames import Beginning, Series

_POLL_S = 0.002
_IN_FLIGHT_S = 2 / 30
"""A frame is exposed during one thirtieth of a second and sent during the next."""


def _nothing_shown(_serial: str, _image: RawArray | ByteArray) -> None:
    """Discard the picture."""


def _never() -> bool:
    return False


@dataclass(frozen=True)
class CaptureCallbacks:
    """The callbacks through which a capture reports and is controlled.

    Parameters
    ----------
    report
        Called with every new status.
    is_cancelled
        Polled throughout the capture; true ends it.
    wait_for_hand
        Called before a step that moves a sensor; returns once the sensor is in position.
    show
        Called with the serial number and every depth image and colour picture that arrives.
    """

    report: Callable[[CaptureStatus], None]
    is_cancelled: Callable[[], bool] = _never
    wait_for_hand: Callable[[CaptureStep], None] = lambda _step: None
    show: Callable[[str, RawArray | ByteArray], None] = _nothing_shown


def hand_sentence(step: CaptureStep) -> str:
    """Return the instruction to the user that precedes a step."""
    return Message("Put the sensor in its place for view {views}", views=step.names)


def open_sensors(rig: Rig, serials: Iterable[str]) -> dict[str, OpenSensor]:
    """Open sensors, all or none.

    Returns
    -------
    dict
        The open sensors by serial number.

    Raises
    ------
    NoSensorFoundError, SensorError
    """
    opened: dict[str, OpenSensor] = {}
    try:
        for serial in serials:
            opened[serial] = rig.open(serial)
    except InsoleError:
        close_sensors(opened.values())
        raise
    return opened


def close_sensors(sensors: Iterable[OpenSensor]) -> None:
    """Close all sensors, even if one of them does not respond."""
    failures = []
    for sensor in sensors:
        try:
            sensor.close()
        except SensorError as error:
            failures.append(error)
    if failures:
        raise failures[0]


class CaptureRunner:
    """Carries out a plan; a finished view stays in the draft, whatever happens later.

    Parameters
    ----------
    sensors
        Open sensors by serial number; the emitters of those not in the plan stay off.
    """

    def __init__(
        self,
        sensors: Mapping[str, OpenSensor],
        plan: CapturePlan,
        setup: CaptureSetup,
        draft: Draft,
        callbacks: CaptureCallbacks,
    ) -> None:
        together = [key for key, one in sensors.items() if Capability.TOGETHER in one.capabilities]
        self._sensors = sensors
        self._plan = plan = plan.gathered(together)
        self._draft = draft
        self._callbacks = callbacks
        self._reported: CaptureStatus | None = None
        self._under_way: tuple[str, ...] = ()
        self._calibrated = {
            shot.view: setup.calibrated(sensors[shot.serial], shot.view, learning=plan.infrared)
            for shot in plan.shots
        }
        self._views = {
            shot.view: ViewStatus(shot.view, shot.serial, 0, plan.frames, place=shot.place)
            for shot in plan.shots
        }

    def run(self) -> tuple[str, ...]:
        """Capture every view and return the warnings.

        Raises
        ------
        SensorError
            When a sensor is lost or silent, or its controller is full; says what is kept.
        OutputError
            When the disk is full.
        Cancelled
        """
        plan = self._plan
        sensors = [calibrated.sensor for calibrated in self._calibrated.values()]
        for shot in plan.shots if plan.infrared else ():
            require(self._sensors[shot.serial], Capability.INFRARED)
        known = sum(calibrated.dots is not None for calibrated in self._calibrated.values())
        self._draft.check_room(plan.frames, plan.color_frames, sensors, known * PICTURES)
        tilts: dict[str, float] = {}
        try:
            self._check_controllers()
            tilts.update(self._tilts_before())
            for step in plan.steps:
                self._take(step, tilts)
        except SensorError as error:
            raise type(error)(self._with_kept_views(error)) from error
        finally:
            for serial, tilt_deg in tilts.items():
                with suppress(SensorError):  # this sensor may be the one that was lost
                    self._sensors[serial].tilt_to(tilt_deg)
        warnings = (warning for view in self._views.values() for warning in view.warnings)
        return tuple(dict.fromkeys(warnings))

    def _check_controllers(self) -> None:
        """Check that the streams of every step fit their controllers, before the first frame."""
        steps = {frozenset(shot.serial for shot in step.shots) for step in self._plan.steps}
        for serials in sorted(steps, key=sorted):
            wanted = [self._sensors[serial] for serial in sorted(serials)]
            if all(sensor.streams for sensor in wanted):
                continue
            buses = {sensor.bus for sensor in wanted}
            for serial, other in self._sensors.items():
                if serial not in serials and other.bus in buses:
                    other.stop()
            with ExitStack() as held:
                for sensor in wanted:
                    held.enter_context(sensor.reserving())

    def _tilts_before(self) -> dict[str, float]:
        tilted = {shot.serial for shot in self._plan.shots if shot.tilt_deg}
        for serial in sorted(tilted):
            require(self._sensors[serial], Capability.TILT)
        return {serial: self._sensors[serial].tilt_deg() for serial in sorted(tilted)}

    def _take(self, step: CaptureStep, tilts: dict[str, float]) -> None:
        names = step.names
        self._under_way = tuple(shot.view for shot in step.shots)
        if step.by_hand:
            self._tell(CapturePhase.MOVING, hand_sentence(step))
            self._callbacks.wait_for_hand(step)
        for shot in step.shots:
            self._move(shot, step.by_hand, tilts.get(shot.serial))
        self._tell(CapturePhase.SETTLING, _settling(names))
        taken = [
            Series(shot, self._sensors[shot.serial], self._plan, beginning)
            for shot, beginning in zip(step.shots, self._light_only(step), strict=True)
        ]
        infrared: list[InfraredSeries] = []
        try:
            self._collect(taken, names)
            infrared += self._collect_infrared(taken, names)
        finally:
            for series in taken:
                with suppress(SensorError):  # this sensor may be the one that was lost
                    series.sensor.free_exposure()
        self._tell(CapturePhase.VERIFYING, Message("Checking view {views}", views=names))
        for series in taken:
            own = (one for one in infrared if one.before is series)
            self._finish(series, next(own, None))
        self._tell(CapturePhase.VERIFYING, Message("View {views} is on the disk", views=names))

    def _move(self, shot: Shot, by_hand: bool, level_deg: float | None) -> None:
        """Tilt a sensor as planned; restart the streams of a sensor that was moved."""
        sensor = self._sensors[shot.serial]
        if level_deg is not None:
            self._tell(
                CapturePhase.TILTING, Message("Tilting the sensor for view {view}", view=shot.view)
            )
            sensor.tilt_to(level_deg + shot.tilt_deg)
        if by_hand or level_deg is not None:
            sensor.stop()  # frames in transit were taken at the previous position

    def _light_only(self, step: CaptureStep) -> list[Beginning]:
        """Switch on the emitters of one step and off those of all other sensors."""
        own = [self._sensors[shot.serial] for shot in step.shots]
        others = [sensor for sensor in self._sensors.values() if sensor not in own]
        shining = [sensor for sensor in others if sensor.emits]
        for sensor in shining:
            sensor.stop_depth()
        dark_s = time.monotonic()
        clear_s = dark_s + _IN_FLIGHT_S if shining else dark_s
        beginnings = [
            Beginning(dark_s, clear_s if sensor.emits else dark_s, sensor.discarded)
            for sensor in own
        ]
        self._start_beside(others, lambda: self._start(step.shots))
        return beginnings

    def _start_beside(self, others: list[OpenSensor], start: Callable[[], None]) -> None:
        """Start streams, if need be in place of those of other sensors."""
        try:
            start()
        except BusFullError:
            for sensor in others:  # colour alone takes part of the controller's bandwidth
                sensor.stop()
            start()

    def _start(self, shots: tuple[Shot, ...]) -> None:
        for shot in shots:
            self._sensors[shot.serial].start(_color_size(self._calibrated[shot.view]))

    def _collect(self, taken: list[Series], names: str) -> None:
        for series in taken:
            dots = self._calibrated[series.shot.view].dots
            self._draft.begin_view(series.shot.view, dots.reference if dots is not None else None)
        while not all(series.complete for series in taken):
            if self._callbacks.is_cancelled():
                raise Cancelled(names)
            for series in taken:
                series.sensor.hold_exposure()
            came = [self._advance(series) for series in taken]
            if any(came):
                if all(series.settled for series in taken):
                    self._tell(
                        CapturePhase.CAPTURING, Message("Capturing view {views}", views=names)
                    )
                else:
                    self._tell(CapturePhase.SETTLING, _settling(names))
            else:
                time.sleep(_POLL_S)

    def _collect_infrared(self, taken: list[Series], names: str) -> list[InfraredSeries]:
        """Take infrared pictures of the same pose with the sensors whose dots are known."""
        known = [one for one in taken if self._calibrated[one.shot.view].dots is not None]
        if not known:
            return []
        self._tell(
            CapturePhase.CAPTURING, Message("Taking infrared pictures of view {views}", views=names)
        )
        own = [one.sensor for one in taken]
        others = [sensor for sensor in self._sensors.values() if sensor not in own]
        for one in known:
            self._start_beside(others, one.sensor.start_infrared)
        switched_s = time.monotonic()
        infrared = [InfraredSeries(one, switched_s) for one in known]
        while not all(one.complete for one in infrared):
            if self._callbacks.is_cancelled():
                raise Cancelled(names)
            came = [self._advance_infrared(one) for one in infrared]
            if not any(came):
                time.sleep(_POLL_S)
        return infrared

    def _advance_infrared(self, infrared: InfraredSeries) -> bool:
        """Process what one sensor has delivered; return whether it delivered anything."""
        shot, sensor = infrared.before.shot, infrared.before.sensor
        depth, video = sensor.poll_depth(), sensor.poll_video()
        if depth is not None:
            self._callbacks.show(shot.serial, depth.raw)
            infrared.take_depth(depth)
        if video is not None:
            infrared.take_picture(video)
        return depth is not None or video is not None

    def _advance(self, series: Series) -> bool:
        """Process what one sensor has delivered; return whether it delivered anything."""
        view, serial = series.shot.view, series.shot.serial
        depth = series.sensor.poll_depth()
        if depth is not None:
            self._callbacks.show(serial, depth.raw)
            for index, used in series.take_depth(depth):
                self._draft.add_depth(view, index, used)
            self._views[view] = series.status()
        video = series.sensor.poll_video()
        if video is not None and series.wants_color(video.time_s):
            picture = video.picture()
            self._callbacks.show(serial, picture)
            series.light = judge_light(picture)
            self._draft.add_color(view, series.take_color(video.time_s), picture)
        self._keep_pair(series)
        return depth is not None

    def _keep_pair(self, series: Series) -> None:
        if Capability.PAIR not in series.sensor.capabilities:
            return
        pair = series.sensor.poll_pair()
        if pair is not None and series.wants_pair:
            self._draft.add_pair(series.shot.view, series.pair_count, pair)
            series.pair_count += 1

    def _finish(self, series: Series, infrared: InfraredSeries | None) -> None:
        view = series.shot.view
        calibrated = self._calibrated[view]
        faults = () if infrared is None else infrared.check()
        warnings = (*calibrated.warnings, *series.check(), *faults)
        dots = None
        if infrared is not None and calibrated.dots is not None and not faults:
            dots = replace(calibrated.dots, moved_raw=infrared.moved_raw)
            for index, picture in enumerate(infrared.pictures):
                self._draft.add_infrared(view, index, picture)
        calibrated = replace(calibrated, dots=dots)
        settled_after_s = series.stabilisation.settled_after_s or 0.0
        warm_s = time.monotonic() - series.sensor.on_since_s
        facts = ViewFacts(
            settled_after_s,
            series.discarded,
            warm_s,
            warnings,
            series.sensor.temperature_c,
            series.times,
            series.sensor.tuning,
        )
        self._draft.finish_view(view, calibrated, facts)
        self._views[view] = series.status(True, warnings)

    def _tell(self, phase: CapturePhase, sentence: str) -> None:
        status = CaptureStatus(phase, tuple(self._views.values()), sentence, self._under_way)
        if status != self._reported:
            self._reported = status
            self._callbacks.report(status)

    def _with_kept_views(self, error: SensorError) -> Message:
        kept = joined(self._draft.views)
        if not kept:
            return error.message
        return Message("{problem} Kept so far: {views}.", problem=error.message, views=kept)


def _settling(names: str) -> Message:
    return Message("Waiting for steady depth of view {views}", views=names)


def _color_size(calibrated: Calibrated) -> ColorSize:
    camera = calibrated.sensor.color_camera
    return camera.width, camera.height
