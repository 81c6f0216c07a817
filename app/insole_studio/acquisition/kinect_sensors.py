"""Kinects behind the port: their driver's sensors, live or emulated, and its frames."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.driver_values import factory_sensor, translating
from insole_studio.acquisition.messages import UNTUNED, Capability, DetectedSensor, Tuning
from insole_studio.acquisition.sensor_port import (
    ColorSize,
    DepthFrame,
    Place,
    SensorError,
)
from insole_studio.acquisition.warm_up import WarmUps
from kinect_v1.errors import KinectError
from kinect_v1.kinect_camera import CameraSettings, KinectCamera, open_camera
from kinect_v1.modes import BAYER_640, BAYER_1280, IR_640, StreamMode
from kinect_v1.motor import Led, Posture
from kinect_v1.pixels import demosaic
from kinect_v1.sensors import SensorInfo, list_sensors
from kinect_v1.streams import Frame, Stream
from kinect_v1.usb_bus import UsbBus

FULL_COLOR: ColorSize = (1280, 1024)
_MODES: dict[ColorSize, StreamMode] = {
    (1280, 1024): BAYER_1280,
    (1280, 960): BAYER_1280,
    (640, 480): BAYER_640,
}
_SETTINGS = CameraSettings(watchdog_s=3.0)
_INFRARED_ROWS = 480
_TILT_LIMIT_S = 5.0
_TILT_POLL_S = 0.1


_FAMILY = "kinect-v1"
_CAN = frozenset({Capability.TILT, Capability.BLINK, Capability.INFRARED})


class KinectPort:
    """Finds and opens Kinects.

    Parameters
    ----------
    bus
        The computer's own bus, or an emulated one; the only difference between the two.
    warm_ups
        Of the sensors; by default they begin when a sensor is opened.
    """

    def __init__(self, bus: UsbBus, warm_ups: WarmUps | None = None) -> None:
        self._bus = bus
        self._warm_ups = warm_ups or WarmUps()

    def find(self) -> tuple[DetectedSensor, ...]:
        """List the Kinects that are plugged in (see `SensorPort`)."""
        with translating():
            return tuple(detected(info) for info in list_sensors(self._bus))

    def places(self) -> frozenset[Place]:
        """Return where Kinects are plugged in (see `SensorPort`)."""
        with translating():
            return frozenset((_FAMILY, *place) for place in self._bus.places())

    def open(self, serial: str) -> OpenKinect:
        """Open a Kinect (see `SensorPort`)."""
        with translating():
            return OpenKinect(open_camera(serial, _SETTINGS, self._bus), self._warm_ups)


@dataclass(frozen=True, eq=False)
class KinectVideoFrame:
    """A colour or infrared frame of a Kinect.

    Parameters
    ----------
    frame
        As the driver delivers it.
    height
        Rows of the colour picture that are used, in its middle.
    """

    frame: Frame
    height: int

    @property
    def time_s(self) -> float:
        """When it arrived, `time.monotonic()`."""
        return self.frame.host_time_s

    def picture(self) -> ByteArray:
        """Return the colour picture (height, width, 3) uint8, RGB."""
        return demosaic(_cropped(self.frame.image, self.height))

    def preview(self) -> ByteArray:
        """Return colour of half the size, or the infrared picture (480, 640) uint8."""
        if self.frame.mode is IR_640:
            return _infrared(self.frame.image)
        return _half(self.frame.image)

    def dots(self) -> RawArray:
        """Return the infrared picture (480, 640) uint16, 10 bits: the upper rows (`_infrared`)."""
        return np.array(self.frame.image[:_INFRARED_ROWS], np.uint16)


class OpenKinect:
    """An open Kinect (see `OpenSensor`)."""

    capabilities = _CAN

    def __init__(self, camera: KinectCamera, warm_ups: WarmUps) -> None:
        self.serial = camera.serial
        self.model = camera.model.value
        self.bus = camera.bus
        self._place = (camera.bus, camera.address)
        self._warm_ups = warm_ups
        self.on_since_s = warm_ups.since_s(self.serial, self._place)
        self._camera = camera
        self._depth: Stream | None = None
        self._color: Stream | None = None
        self._color_size = FULL_COLOR
        self._discarded = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def factory_sensor(self, faces: tuple[str, ...]) -> Sensor:
        """Return the calibration stored in the device.

        Parameters
        ----------
        faces
            Marker groups that the sensor sees.
        """
        return factory_sensor(self._camera.calibration, self.serial, faces)

    @property
    def emits(self) -> bool:
        """Whether its emitter is on."""
        return self._depth is not None

    def start(self, color_size: ColorSize | None = None) -> None:
        """Stream depth, which switches the emitter on, and colour; running streams continue.

        Raises
        ------
        BusFullError
            When its USB controller carries too much already.
        SensorError
        """
        with translating():
            self._color_size = color_size or FULL_COLOR
            self._start_video(_MODES[self._color_size])
            self._start_depth()

    def start_infrared(self) -> None:
        """Stream infrared pictures instead of colour, and depth; `start` brings colour back.

        Raises
        ------
        BusFullError
            When its USB controller carries too much already.
        SensorError
        """
        with translating():
            self._start_video(IR_640)
            self._start_depth()

    def _start_video(self, mode: StreamMode) -> None:
        if self._color is None or self._color.mode is not mode:
            self._color = self._camera.start_video(mode)

    def _start_depth(self) -> None:
        if self._depth is None:
            self._depth = self._camera.start_depth()

    @property
    def streams(self) -> bool:
        """Whether depth and colour are streaming."""
        return self._depth is not None and self._color is not None

    @contextmanager
    def reserving(self) -> Iterator[None]:
        """Reserve the bandwidth of depth and colour within a context; switch nothing on.

        Raises
        ------
        BusFullError
            When its USB controller cannot carry them.
        """
        with translating(), self._camera.reserving():
            yield

    def stop_depth(self) -> None:
        """Switch the emitter off.

        Raises
        ------
        SensorError
        """
        self._discarded = self.discarded
        self._depth = None
        with translating():
            self._camera.stop_depth()

    temperature_c = None
    tuning = UNTUNED
    laser_range = None

    def poll_pair(self) -> None:
        """Return nothing: it has one infrared camera."""

    def hold_exposure(self) -> None:
        """Do nothing: its infrared camera has one exposure, and its colour is only looked at."""

    def free_exposure(self) -> None:
        """Do nothing (see `hold_exposure`)."""

    def stop(self) -> None:
        """Stop everything, which frees the controller's bandwidth.

        Raises
        ------
        SensorError
        """
        self.stop_depth()
        self._color = None
        with translating():
            self._camera.stop_video()

    def poll_depth(self) -> DepthFrame | None:
        """Return the next depth frame if one is waiting: raw numbers (480, 640)."""
        frame = _poll(self._depth)
        if frame is None:
            return None
        image = np.asarray(frame.image, np.uint16)
        return DepthFrame(image, frame.host_time_s, frame.discarded)

    def poll_video(self) -> KinectVideoFrame | None:
        """Return the next colour or infrared frame if one is waiting (see `OpenSensor`)."""
        frame = _poll(self._color)
        return None if frame is None else KinectVideoFrame(frame, self._color_size[1])

    @property
    def discarded(self) -> int:
        """Return the number of depth frames that arrived damaged since it was opened."""
        return self._discarded + (self._depth.counts.discarded if self._depth is not None else 0)

    def tune(self, tuning: Tuning) -> None:
        """Fail: nothing of it can be set."""
        raise NotImplementedError

    def tilt_deg(self) -> float:
        """Return the tilt relative to gravity.

        Raises
        ------
        SensorError
        """
        return self._wait_until_still(lambda posture: not posture.moving).tilt_deg or 0.0

    def tilt_to(self, tilt_deg: float) -> None:
        """Tilt the sensor and wait until it stands still.

        Raises
        ------
        SensorError
        """
        with translating():
            self._camera.motor.set_tilt(tilt_deg)
        self._wait_until_still(lambda posture: _arrived(posture, tilt_deg))

    def roll_deg(self) -> float:
        """Return the roll angle by the accelerometer, which the motor cannot correct.

        Raises
        ------
        SensorError
        """
        with translating():
            x, y, _z = self._camera.motor.posture().acceleration_g
        return math.degrees(math.atan2(x, abs(y))) if x or y else 0.0

    def _wait_until_still(self, is_still: Callable[[Posture], bool]) -> Posture:
        limit_s = time.monotonic() + _TILT_LIMIT_S
        with translating():
            while True:
                posture = self._camera.motor.posture()
                if is_still(posture) or time.monotonic() > limit_s:
                    return posture
                time.sleep(_TILT_POLL_S)

    def blink(self, on: bool) -> None:
        """Make its LED blink, so that the user can identify the sensor, or light steadily.

        Raises
        ------
        SensorError
        """
        with translating():
            self._camera.motor.set_led(Led.BLINK_GREEN if on else Led.GREEN)

    def keep_warm_up(self) -> None:
        """Note how long it has been on, in case this process is killed."""
        self._warm_ups.keep(self.serial, self._place, self.on_since_s)

    def close(self) -> None:
        """Stop everything and release the sensor, also when it has been unplugged.

        Raises
        ------
        SensorError
        """
        self.keep_warm_up()
        with translating():
            self._camera.close()


def _arrived(posture: Posture, tilt_deg: float) -> bool:
    """Return whether a motor has stopped; if unknown, whether it is at its target."""
    if posture.moving is not None:
        return not posture.moving
    return posture.tilt_deg is not None and abs(posture.tilt_deg - tilt_deg) < 1.0


def _poll(stream: Stream | None) -> Frame | None:
    if stream is None:
        return None
    frame = stream.poll()
    if frame is None:
        try:
            stream.check()
        except KinectError as error:
            raise SensorError(str(error)) from error
    return frame


def _cropped(mosaic: ByteArray, height: int) -> ByteArray:
    """Keep the middle rows; an even number is cut, so that the Bayer pattern stays the same."""
    cut = (len(mosaic) - height) // 4 * 2
    return np.ascontiguousarray(mosaic[cut : cut + height])


def detected(info: SensorInfo) -> DetectedSensor:
    """Return a Kinect as the application lists it."""
    model = info.model.value if info.model else None
    return DetectedSensor(info.serial, model, info.bus, info.place, info.problem)


def _half(mosaic: NDArray[np.uint8]) -> ByteArray:
    """Return a colour picture of half the size: each square of a Bayer mosaic is one pixel."""
    return np.stack([mosaic[0::2, 1::2], mosaic[0::2, 0::2], mosaic[1::2, 0::2]], axis=-1)


def _infrared(image: NDArray[np.uint16]) -> ByteArray:
    """Return an infrared picture (480, 640) uint8.

    Of the 488 rows the upper 480 are kept, for which the known shift to the depth image holds. The
    contrast is stretched from the darkest to the brightest pixel, because with the emitter covered
    a board uses only a few of the ten bits.
    """
    levels = image[:_INFRARED_ROWS].astype(float)
    darkest = levels.min()
    return ((levels - darkest) * (255 / max(levels.max() - darkest, 1.0))).astype(np.uint8)
