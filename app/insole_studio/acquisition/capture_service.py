"""The capture service: a separate process that hosts the driver, so that nothing can stall it."""

from __future__ import annotations

import signal
import time
from collections import deque
from collections.abc import Callable
from multiprocessing.connection import Connection

from insole_core.errors import InsoleError
from insole_core.messages import Message, joined
from insole_core.progress import Cancelled
from insole_studio.acquisition.capture_plan import CaptureStep
from insole_studio.acquisition.capture_runner import CaptureCallbacks, CaptureRunner
from insole_studio.acquisition.capture_setup import CaptureSetup
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.messages import (
    ALIVE_PERIOD_S,
    Alive,
    Cancel,
    Capability,
    CapturePhase,
    CaptureStatus,
    Command,
    Event,
    Find,
    Identify,
    Infrared,
    Placed,
    Quit,
    Sensors,
    Start,
    Tilt,
    Tune,
)
from insole_studio.acquisition.sensor_port import require
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.shared_frame_buffer import SharedFrameBuffer
from insole_studio.log_file import log_to
from insole_studio.user_paths import UserPaths

_IDLE_S = 0.004
_STATE_PERIOD_S = 0.25
_FIND_PERIOD_S = 2.0
_WARM_UP_PERIOD_S = 30.0
_ROLL_DEG = 1.0
"""Smaller roll angles are noise of the accelerometer."""


def serve(connection: Connection, board: SharedFrameBuffer, source: SensorSource) -> None:
    """Run the service until the client ends it or disappears.

    Parameters
    ----------
    connection
        To the client: commands arrive on it, events are sent.
    board
        Shared memory for the newest pictures.
    source
        Provides the sensors and the capture setup.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the window to handle
    with log_to(UserPaths.of_user().sensors_log_file):
        _serve(connection, board, source)


def _serve(connection: Connection, board: SharedFrameBuffer, source: SensorSource) -> None:
    try:
        rig, setup = source.rig(), source.setup()
    except InsoleError as error:
        connection.send(Sensors((), str(error)))
        return
    service = _Service(connection, LiveSensors(rig, board.write), setup, source.put)
    try:
        service.run()
    finally:
        service.close()


class _Service:
    """One loop that handles commands, frames and, at intervals, the state of the sensors."""

    def __init__(
        self,
        connection: Connection,
        live: LiveSensors,
        setup: CaptureSetup,
        put: Callable[[CaptureStep], None],
    ) -> None:
        self._connection = connection
        self._live = live
        self._setup = setup
        self._put = put
        self._waiting: deque[Command] = deque()
        self._quitting = False
        self._last: CaptureStatus | None = None
        self._sent_s = 0.0

    def run(self) -> None:
        """Stream and carry out commands until told to quit."""
        self._find()
        next_state_s = next_find_s = next_warm_up_s = 0.0
        while not self._quitting:
            self._receive()
            while self._waiting and not self._quitting:
                self._obey(self._waiting.popleft())
            if not self._live.pump():
                time.sleep(_IDLE_S)
            now = time.monotonic()
            if now >= next_state_s:
                next_state_s = now + _STATE_PERIOD_S
                self._send(self._live.summary)
            if now >= next_warm_up_s:
                next_warm_up_s = now + _WARM_UP_PERIOD_S
                self._live.keep_warm_ups()
            if now >= next_find_s:
                next_find_s = now + _FIND_PERIOD_S
                if self._live.is_time_to_find:
                    self._find()

    def close(self) -> None:
        """Switch all emitters off."""
        self._live.close()
        self._connection.close()

    def _receive(self) -> None:
        """Read the waiting commands; a closed connection counts as `Quit`.

        Every loop comes by here, also while a capture runs or waits for the user, so this is where
        the service shows that it does not hang.
        """
        if time.monotonic() - self._sent_s >= ALIVE_PERIOD_S:
            self._send(Alive())
        try:
            while self._connection.poll():
                self._waiting.append(self._connection.recv())
        except (EOFError, OSError):
            self._quitting = True

    def _send(self, event: Event | Alive) -> None:
        self._sent_s = time.monotonic()
        try:
            self._connection.send(event)
        except OSError:  # the window has gone
            self._quitting = True

    def _find(self) -> None:
        self._live.drop_lost()
        self._live.find()
        self._live.start()

    def _obey(self, command: Command) -> None:
        try:
            if isinstance(command, Start):
                self._capture(command)
            elif isinstance(command, Find):
                self._find()
            elif isinstance(command, Tilt):
                self._tilt(command)
            elif isinstance(command, Identify):
                sensor = self._live.opened[command.serial]
                require(sensor, Capability.BLINK)
                sensor.blink(command.on)
            elif isinstance(command, Tune):
                self._tune(command)
            elif isinstance(command, Infrared):
                self._live.watch_infrared(command.serial, command.on)
            elif isinstance(command, Quit):
                self._quitting = True
        except KeyError as error:
            self._send(
                Message(
                    "Sensor {serial} is not in use; look for sensors again.", serial=error.args[0]
                )
            )
        except InsoleError as error:
            self._send(error.message)

    def _tilt(self, command: Tilt) -> None:
        sensor = self._live.opened[command.serial]
        require(sensor, Capability.TILT)
        if command.by_deg is not None:
            sensor.tilt_to(sensor.tilt_deg() + command.by_deg)
            return
        sensor.tilt_to(0.0)
        self._tell_roll(command.serial, abs(sensor.roll_deg()))

    def _tune(self, command: Tune) -> None:
        sensor = self._live.opened[command.serial]
        tuning = command.tuning
        for capability, value in (
            (Capability.PRESET, tuning.preset),
            (Capability.LASER, tuning.laser_mw),
            (Capability.HAS_PAIR, tuning.pair),
        ):
            if value is not None:
                require(sensor, capability)
        try:
            sensor.tune(tuning)
            self._live.start()  # a controller may have room for others now
        finally:
            self._send(self._live.summary)

    def _tell_roll(self, serial: str, roll_deg: float) -> None:
        """Warn about a roll, which the motor cannot correct."""
        if roll_deg >= _ROLL_DEG:
            self._send(
                Message(
                    "Sensor {serial} leans to one side by {roll_deg:.0f}°, which its motor cannot "
                    "mend; straighten it by hand and level it again.",
                    serial=serial,
                    roll_deg=roll_deg,
                )
            )

    def _capture(self, order: Start) -> None:
        """Carry out a plan; the last status always says how the capture ended."""
        self._last = None
        try:
            warnings = self._carry_out(order)
        except Cancelled:
            self._end(CapturePhase.CANCELLED, "The capture was stopped.")
        except KeyError as error:
            unused = Message("Sensor {serial} is not in use; plug it in.", serial=error.args[0])
            self._end(CapturePhase.FAILED, unused)
        except InsoleError as error:
            self._end(CapturePhase.FAILED, str(error))
        else:
            self._end(CapturePhase.DONE, joined(warnings, " "))
        if not self._quitting:
            self._live.start()

    def _carry_out(self, order: Start) -> tuple[str, ...]:
        exists = (order.folder / "manifest.json").exists()
        draft = (
            Draft.reopen(order.folder, order.order)
            if exists
            else Draft(order.folder, order.manifest, order.order)
        )
        callbacks = CaptureCallbacks(
            self._report, self._is_cancelled, self._wait_for_hand, self._live.show
        )
        try:
            sensors = self._live.opened
            return CaptureRunner(sensors, order.plan, self._setup, draft, callbacks).run()
        finally:
            draft.close()

    def _report(self, status: CaptureStatus) -> None:
        self._last = status
        self._send(status)

    def _is_cancelled(self) -> bool:
        self._receive()
        if any(isinstance(command, Cancel | Quit) for command in self._waiting):
            self._quitting |= any(isinstance(command, Quit) for command in self._waiting)
            self._waiting.clear()
            return True
        return self._quitting

    def _wait_for_hand(self, step: CaptureStep) -> None:
        """Keep streaming until the user confirms that the sensor is in position."""
        self._live.start()
        while not any(isinstance(command, Placed) for command in self._waiting):
            if self._is_cancelled():
                raise Cancelled("moving a sensor")
            if not self._live.pump():
                time.sleep(_IDLE_S)
        self._waiting.clear()
        self._put(step)

    def _end(self, phase: CapturePhase, sentence: str) -> None:
        views = self._last.views if self._last is not None else ()
        self._send(CaptureStatus(phase, views, sentence))
