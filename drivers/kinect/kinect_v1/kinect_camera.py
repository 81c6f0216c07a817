"""The camera: open it by serial number, read its calibration, start and stop its streams."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from kinect_v1 import calibration, commands
from kinect_v1.calibration import Calibration
from kinect_v1.command_channel import COMMAND_LIMIT_S, CommandChannel
from kinect_v1.commands import Algorithm, Opcode, words
from kinect_v1.errors import (
    KinectError,
    StoppedError,
    TransferError,
    UnpluggedError,
    UnsupportedError,
)
from kinect_v1.models import Model
from kinect_v1.modes import (
    BAYER_640,
    DEPTH,
    DEPTH_11,
    IR_1280,
    STREAM_OFF,
    VIDEO,
    Register,
    StreamKind,
    StreamMode,
)
from kinect_v1.motor import Led, Motor, open_motor
from kinect_v1.sensors import FoundSensor, find_sensor
from kinect_v1.streams import WATCHDOG_S, Deliver, Stream
from kinect_v1.usb_bus import RunningStream, UsbBus, system_bus

_NEAR_GAIN, _NORMAL_GAIN = 0x07, 0x1E
_NEAR_RANGE, _NORMAL_RANGE = 0x000, 0x190
_GAIN_SETTLE_S = 0.1


@dataclass(frozen=True)
class ColorSettings:
    """Exposure and white balance of the colour sensor.

    Parameters
    ----------
    exposure_us
        Exposure time in µs; None = automatic.
    auto_white_balance
        Also off if the exposure is fixed, as the sensor requires.
    """

    exposure_us: float | None = None
    auto_white_balance: bool = True


@dataclass(frozen=True)
class CameraSettings:
    """The settings that a camera is opened with.

    Parameters
    ----------
    color
        None leaves the colour sensor as it is.
    near_mode
        Kinect for Windows only.
    watchdog_s
        The longest silence of a stream that is not an error.
    command_limit_s
        The longest wait for a reply to a command.
    """

    color: ColorSettings | None = None
    near_mode: bool = False
    watchdog_s: float = WATCHDOG_S
    command_limit_s: float = COMMAND_LIMIT_S


def open_camera(
    serial: str | None = None,
    settings: CameraSettings = CameraSettings(),
    bus: UsbBus | None = None,
) -> KinectCamera:
    """Open the sensor with a serial number; None opens the only one.

    Parameters
    ----------
    bus
        An emulated one in tests and demonstrations; None selects the computer's own.

    Raises
    ------
    NoSensorError, NoPowerError, NoPermissionError, InUseError, KinectError
    """
    found, number = find_sensor(bus or system_bus(), serial)
    return KinectCamera(found, number, settings)


class KinectCamera:
    """An open sensor. Use it as a context manager, or close it.

    Attributes
    ----------
    bus
        Number of its USB controller.
    address
        On the bus; it changes when the sensor loses its power.
    calibration
        The factory calibration of this device.
    """

    def __init__(self, found: FoundSensor, serial: str, settings: CameraSettings) -> None:
        self.serial = serial
        self.model: Model = found.model
        self.bus = found.camera.bus
        self.address = found.camera.address
        self._found = found
        self._function = found.camera
        self._settings = settings
        self._channel = CommandChannel(found.camera, settings.command_limit_s)
        self._running: dict[StreamKind, tuple[RunningStream, Stream]] = {}
        self._motor: Motor | None = None
        try:
            self._take_over()
            self.calibration = self._read_calibration()
            self._apply(settings)
        except KinectError:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def start_depth(self, mode: StreamMode = DEPTH_11, deliver: Deliver | None = None) -> Stream:
        """Switch the projector on and stream depth; for `deliver` see `Stream`."""
        if VIDEO in self._running and self._running[VIDEO][1].mode is IR_1280:
            raise UnsupportedError(
                "Depth cannot run beside the large infrared picture; stop the infrared picture "
                "first."
            )
        return self._start(DEPTH, mode, deliver)

    def start_video(self, mode: StreamMode = BAYER_640, deliver: Deliver | None = None) -> Stream:
        """Stream colour or infrared pictures; for `deliver` see `Stream`."""
        if mode is IR_1280 and DEPTH in self._running:
            raise UnsupportedError(
                "The large infrared picture cannot run beside depth; stop depth first."
            )
        return self._start(VIDEO, mode, deliver)

    @contextmanager
    def reserving(self) -> Iterator[None]:
        """Reserve the bandwidth for both streams within a context; switch nothing on.

        Raises
        ------
        BandwidthError
            When the controller cannot carry them.
        """
        with ExitStack() as held:
            held.callback(self._release_if_idle)
            self._prepare_interface()
            for mode in (DEPTH_11, BAYER_640):
                if mode.kind not in self._running:
                    held.callback(self._transfer(Stream(mode)).stop)
            yield

    def stop_depth(self) -> None:
        """Stop depth, which switches the projector off."""
        self._stop(DEPTH)

    def stop_video(self) -> None:
        """Stop colour or infrared pictures."""
        self._stop(VIDEO)

    @property
    def motor(self) -> Motor:
        """The motor, LED and accelerometer; opened on first access.

        Raises
        ------
        UnsupportedError
            When the sensor has none on this bus.
        """
        if self._motor is None:
            self._motor = open_motor(self.model, self._found.companion)
        return self._motor

    def set_color(self, color: ColorSettings) -> None:
        """Set exposure and white balance, also of a running stream."""
        flags = self._channel.read_cmos(commands.CMOS_FLAGS)
        automatic = commands.AUTO_EXPOSURE | commands.AUTO_FLICKER
        fixed = color.exposure_us is not None
        flags = flags & ~automatic if fixed else flags | automatic
        balance = color.auto_white_balance and not fixed
        flags = (flags & ~commands.AUTO_WHITE_BALANCE) | balance * commands.AUTO_WHITE_BALANCE
        self._channel.write_cmos(commands.CMOS_FLAGS, flags)
        if color.exposure_us is not None:
            lines = round(color.exposure_us / commands.SHUTTER_STEP_US)
            self._channel.write_cmos(commands.CMOS_SHUTTER, max(1, min(0xFFFF, lines)))

    def set_near_mode(self, near: bool) -> None:
        """Measure from 0.4 m on instead of 0.8 m; Kinect for Windows only."""
        if self.model is not Model.WINDOWS:
            raise UnsupportedError(
                "Only the Kinect for Windows has a near mode; move this sensor further away."
            )
        self._write(Register.SENSOR_GAIN, _NEAR_GAIN if near else _NORMAL_GAIN)
        time.sleep(_GAIN_SETTLE_S)
        self._write(Register.NEAR_RANGE, _NEAR_RANGE if near else _NORMAL_RANGE)

    def set_sensor_gain(self, gain: int) -> None:
        """Set the gain of the depth and infrared sensor, 1 to 50."""
        self._write(Register.SENSOR_GAIN, max(1, min(50, gain)))

    def close(self) -> None:
        """Stop all streams and release the sensor, also when it has been unplugged."""
        with ExitStack() as steps:  # each of them, whatever fails
            steps.callback(self._function.close)
            if self._motor is not None:
                steps.callback(self._motor.close)
            for kind in list(self._running):
                steps.callback(self._stop, kind)

    def _take_over(self) -> None:
        """Claim the camera and switch off what a crashed program has left on."""
        self._function.claim()
        if self.model.streaming_alternate:
            self._function.select_alternate(self.model.streaming_alternate)
        self._channel.drain()
        self._write(DEPTH.switch, STREAM_OFF)
        self._write(VIDEO.switch, STREAM_OFF)
        self._light_up()

    def _light_up(self) -> None:
        """Switch on the LED of the newer models, some of which otherwise leave the bus."""
        if not self.model.has_motor_function:
            with suppress(KinectError):  # depth works without audio
                self.motor.set_led(Led.GREEN)

    def _read_calibration(self) -> Calibration:
        fixed = self._channel.send(Opcode.FIXED_PARAMETERS, words(0, 0, 0, 0, 0))
        return Calibration(
            zero_plane=calibration.decode_zero_plane(fixed),
            registration=calibration.decode_registration(self._ask(Algorithm.REGISTRATION)),
            padding=calibration.decode_padding(self._ask(Algorithm.PADDING)),
            constant_shift=calibration.decode_constant_shift(self._ask(Algorithm.CONSTANT_SHIFT)),
        )

    def _ask(self, what: Algorithm) -> bytes:
        return self._channel.send(Opcode.ALGORITHM_PARAMETERS, words(what, 0, 1, 30, 0))

    def _apply(self, settings: CameraSettings) -> None:
        if settings.color is not None:
            self.set_color(settings.color)
        if settings.near_mode:
            self.set_near_mode(True)

    def _write(self, register: Register, value: int) -> None:
        self._channel.write_register(register, value)

    def _start(self, kind: StreamKind, mode: StreamMode, deliver: Deliver | None) -> Stream:
        """Queue the transfers first, then switch the mode on, as the device requires."""
        if mode.kind is not kind:
            raise UnsupportedError(f"{mode.name} is no mode of the {kind.name} stream.")
        self._stop(kind)
        stream = Stream(mode, deliver, self._settings.watchdog_s)
        try:
            self._prepare_interface()
            self._running[kind] = (self._transfer(stream), stream)
            for register, value in mode.start:
                self._write(register, value)
        except KinectError:
            self._stop(kind)
            self._release_if_idle()
            raise
        return stream

    def _prepare_interface(self) -> None:
        """Select the alternate setting that has the endpoints."""
        if not self._running and self.model.streaming_alternate:
            self._function.select_alternate(self.model.streaming_alternate)

    def _transfer(self, stream: Stream) -> RunningStream:
        endpoint = stream.mode.kind.endpoint
        return self._function.start_stream(endpoint, self.model.streaming_alternate, stream)

    def _stop(self, kind: StreamKind) -> None:
        """Switch the stream off, then end its transfers, even if the device is gone."""
        if kind not in self._running:
            return
        running, stream = self._running.pop(kind)
        try:
            with suppress(UnpluggedError):  # nothing is left to switch off
                self._write(kind.switch, STREAM_OFF)
        finally:
            running.stop()
            stream.end(StoppedError(f"The {kind.name} stream was stopped; start it again."))
        self._release_if_idle()

    def _release_if_idle(self) -> None:
        """Make the controller release the reservation, which EHCI keeps even after a close."""
        if self._running:
            return
        with suppress(UnpluggedError, TransferError):  # unplugged, or a firmware that refuses
            self._function.select_alternate(0)
