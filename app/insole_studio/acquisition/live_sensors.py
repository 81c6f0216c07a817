"""The sensors of a rig, all open and streaming, with the state of each."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import replace

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.messages import joined
from insole_studio.acquisition.capture_plan import MOST_SENSORS
from insole_studio.acquisition.messages import Capability, Sensors, SensorState
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import (
    OpenSensor,
    Place,
    SensorError,
    require,
    small_color,
)

_RATE_FRAMES = 16


class LiveSensors:
    """Opens the sensors that are found, streams them, and drops those that are lost.

    Parameters
    ----------
    show
        Called with the slot and every depth image, colour preview or infrared picture.
    """

    def __init__(self, rig: Rig, show: Callable[[int, RawArray | ByteArray], None]) -> None:
        self._rig = rig
        self._show = show
        self._states: dict[str, SensorState] = {}
        self._times: dict[str, deque[float]] = {}
        self._problem: str | None = None
        self._places: frozenset[Place] = frozenset()
        self._infrared: set[str] = set()
        self.opened: dict[str, OpenSensor] = {}

    @property
    def summary(self) -> Sensors:
        """Return the present state of the sensors."""
        return Sensors(tuple(self._state(serial) for serial in self._states), self._problem)

    @property
    def is_time_to_find(self) -> bool:
        """Whether no sensor is open, or one was plugged in or out since the last search."""
        return not self.opened or self._rig.places() != self._places

    def find(self) -> None:
        """Open every sensor that is plugged in and not open yet."""
        self._places = self._rig.places()
        try:
            found = self._rig.require()
        except SensorError as error:
            self._problem = str(error)
            return
        others = [sensor for sensor in found.sensors if sensor.serial not in self.opened]
        problems = [*found.problems, *(sensor.problem for sensor in others if sensor.problem)]
        self._problem = joined(dict.fromkeys(problems), " ") or None
        for sensor in others:
            if sensor.problem is None and sensor.serial:
                self._open(sensor.serial, sensor.model or "", sensor.bus)

    def start(self) -> None:
        """Stream every open sensor; one whose controller is full waits with its emitter off."""
        for serial, sensor in self.opened.items():
            self._note(serial, None)
            try:
                if serial in self._infrared and Capability.INFRARED in sensor.capabilities:
                    sensor.start_infrared()
                else:
                    sensor.start()
            except SensorError as error:
                self._note(serial, str(error))

    def watch_infrared(self, serial: str, on: bool) -> None:
        """Stream infrared pictures of a sensor instead of colour, or colour again.

        Raises
        ------
        SensorError
            When it has no infrared pictures; it goes on with what it streams.
        """
        if on:
            if serial in self.opened:
                require(self.opened[serial], Capability.INFRARED)
            self._infrared.add(serial)
        else:
            self._infrared.discard(serial)
        self.start()

    def pump(self) -> bool:
        """Show the frames that have arrived; return whether there were any."""
        came = [self._advance(sensor) for sensor in tuple(self.opened.values())]
        return any(came)

    def show(self, serial: str, image: RawArray | ByteArray) -> None:
        """Count a picture of a sensor and show it; colour is reduced in size.

        Parameters
        ----------
        image
            Raw depth or infrared (height, width), or colour (height, width, 3) uint8, RGB.
        """
        if image.ndim == 2:
            self._times[serial].append(time.monotonic())
        self._show(self._states[serial].slot, image if image.ndim == 2 else small_color(image))

    def keep_warm_ups(self) -> None:
        """Note how long each sensor has been on."""
        for sensor in self.opened.values():
            sensor.keep_warm_up()

    def drop_lost(self) -> None:
        """Close the sensors that no longer respond."""
        for serial, state in tuple(self._states.items()):
            if state.problem is not None and serial in self.opened:
                self._close(serial)

    def close(self) -> None:
        """Close every sensor."""
        for serial in tuple(self.opened):
            self._close(serial)

    def _open(self, serial: str, model: str, bus: int) -> None:
        slot = _free_slot(state.slot for key, state in self._states.items() if key != serial)
        if slot is None:
            return
        self._states[serial] = SensorState(serial, model, bus, slot)
        self._times[serial] = deque(maxlen=_RATE_FRAMES)
        try:
            opened = self.opened[serial] = self._rig.open(serial)
        except SensorError as error:
            self._note(serial, str(error))
            return
        factory = opened.factory_sensor(())
        self._states[serial] = replace(self._states[serial], factory=factory)

    def _advance(self, sensor: OpenSensor) -> bool:
        serial = sensor.serial
        try:
            depth, video = sensor.poll_depth(), sensor.poll_video()
        except SensorError as error:
            self._note(serial, str(error))
            self._close(serial)
            return False
        if depth is not None:
            self.show(serial, depth.raw)
            state = self._states[serial]
            self._states[serial] = replace(state, discarded=depth.discarded)
        if video is not None:
            self._show(self._states[serial].slot, video.preview())
        return depth is not None or video is not None

    def _state(self, serial: str) -> SensorState:
        opened = self.opened.get(serial)
        warm_s = time.monotonic() - opened.on_since_s if opened is not None else 0.0
        state = replace(self._states[serial], fps=self._fps(serial), warm_s=warm_s)
        if opened is None:
            return state
        return replace(
            state,
            capabilities=opened.capabilities,
            tuning=opened.tuning,
            laser_range=opened.laser_range,
        )

    def _fps(self, serial: str) -> float:
        times = self._times[serial]
        now = time.monotonic()
        recent = [moment for moment in times if now - moment < 1.0]
        return (len(recent) - 1) / (recent[-1] - recent[0]) if len(recent) > 1 else 0.0

    def _note(self, serial: str, problem: str | None) -> None:
        self._states[serial] = replace(self._states[serial], problem=problem)

    def _close(self, serial: str) -> None:
        sensor = self.opened.pop(serial)
        try:
            sensor.close()
        except SensorError as error:
            self._note(serial, str(error))


def _free_slot(taken: Iterable[int]) -> int | None:
    used = set(taken)
    return next((slot for slot in range(MOST_SENSORS) if slot not in used), None)
