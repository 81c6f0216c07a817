"""The port to sensors: what a capture asks of a family of them, whatever driver is behind it.

An adapter for each family implements `SensorPort` and `OpenSensor`; `Rig` joins the adapters. What
only some families can do is a `Capability`.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Protocol, Self, TypeVar, cast

from numpy.typing import NDArray

from insole_core.errors import InsoleError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.messages import Message
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.messages import (
    Capability,
    DetectedSensor,
    LaserRange,
    SensorState,
    Tuning,
)

ColorSize = tuple[int, int]
InfraredPair = tuple[ByteArray, ByteArray]
"""Pictures (height, width) uint8 of one instant."""
Place = tuple[str, int, int]
"""Family, bus and address."""


class SensorError(InsoleError):
    """A sensor is missing, cannot be used, or stopped working."""


class NoSensorFoundError(SensorError):
    """No sensor is plugged in, or not the requested one."""


class BusFullError(SensorError):
    """The USB controller cannot carry another stream."""


@dataclass(frozen=True, eq=False)
class DepthFrame:
    """A depth frame as a session stores it.

    Parameters
    ----------
    image : (height, width) uint16
        In the unit that the sensor's calibration states.
    time_s
        When it arrived, or was taken, `time.monotonic()`.
    discarded
        Number of frames that arrived damaged before.
    glance : (rows, columns) uint16, optional
        The same in raw units, 2047 = no reading, with about as many readings as a Kinect's; None
        where it is already (see `Readings.glance`).
    """

    image: RawArray
    time_s: float
    discarded: int
    glance: RawArray | None = None

    @property
    def raw(self) -> RawArray:
        """Return what is looked at and judged, (rows, columns) uint16, raw, 2047 = no reading."""
        return self.image if self.glance is None else self.glance


class VideoFrame(Protocol):
    """A colour or infrared frame; it is decoded when somebody asks for it."""

    @property
    def time_s(self) -> float:
        """When it arrived, `time.monotonic()`."""
        ...

    def picture(self) -> ByteArray:
        """Return the whole picture (height, width, 3) uint8, RGB."""
        ...

    def preview(self) -> ByteArray:
        """Return a picture to look at.

        Returns
        -------
        (height, width, 3) uint8
            RGB, at most 640 × 512; of an infrared frame the whole picture (height, width).
        """
        ...

    def dots(self) -> RawArray:
        """Return an infrared picture as sensed, (480, 640) uint16; `Capability.INFRARED`."""
        ...


class OpenSensor(Protocol):
    """An open sensor. Close it, or use it as a context manager.

    Every method raises `SensorError` when the sensor is lost or does not answer.
    """

    @property
    def serial(self) -> str:
        """Its serial number."""
        ...

    @property
    def model(self) -> str:
        """The name of its model."""
        ...

    @property
    def bus(self) -> int:
        """Number of its USB controller."""
        ...

    @property
    def on_since_s(self) -> float:
        """Since when it has been on, `time.monotonic()`; pauses are left out."""
        ...

    @property
    def capabilities(self) -> frozenset[Capability]:
        """What it can do beyond depth and colour."""
        ...

    @property
    def tuning(self) -> Tuning:
        """What is set of it."""
        ...

    @property
    def laser_range(self) -> LaserRange | None:
        """The power that its projector can be set to; with `Capability.LASER`."""
        ...

    def tune(self, tuning: Tuning) -> None:
        """Set what is not None; with `PRESET`, `LASER` and `HAS_PAIR`. It is kept for next time.

        Raises
        ------
        BusFullError
            When the USB controller cannot carry the pair as well; nothing has changed then.
        """
        ...

    @property
    def emits(self) -> bool:
        """Whether its emitter is on."""
        ...

    @property
    def streams(self) -> bool:
        """Whether depth and colour are streaming."""
        ...

    @property
    def discarded(self) -> int:
        """Number of depth frames that arrived damaged since it was opened."""
        ...

    def factory_sensor(self, faces: tuple[str, ...]) -> Sensor:
        """Return the calibration of the factory, for a sensor that sees some marker groups."""
        ...

    def start(self, color_size: ColorSize | None = None) -> None:
        """Stream depth, which switches the emitter on, and colour; running streams continue.

        Parameters
        ----------
        color_size
            Width and height, px; None for the largest.

        Raises
        ------
        BusFullError
            When its USB controller carries too much already.
        """
        ...

    def start_infrared(self) -> None:
        """Stream infrared pictures instead of colour, and depth; `start` brings colour back.

        With `Capability.INFRARED`.

        Raises
        ------
        BusFullError
            When its USB controller carries too much already.
        """
        ...

    def reserving(self) -> AbstractContextManager[None]:
        """Reserve the bandwidth of depth and colour within a context; switch nothing on.

        Raises
        ------
        BusFullError
            When its USB controller cannot carry them.
        """
        ...

    def stop_depth(self) -> None:
        """Switch the emitter off."""
        ...

    def hold_exposure(self) -> None:
        """Keep exposure and gain as they are, once there was a frame."""
        ...

    def free_exposure(self) -> None:
        """Let the sensor choose exposure and gain again."""
        ...

    @property
    def temperature_c(self) -> float | None:
        """How warm it is inside; None if it measures no temperature."""
        ...

    def stop(self) -> None:
        """Stop everything, which frees the controller's bandwidth."""
        ...

    def poll_depth(self) -> DepthFrame | None:
        """Return the next depth frame if one is waiting."""
        ...

    def poll_video(self) -> VideoFrame | None:
        """Return the next colour frame, or infrared after `start_infrared`, if one is waiting."""
        ...

    def poll_pair(self) -> InfraredPair | None:
        """Return the next left and right infrared picture if waiting; with `Capability.PAIR`."""
        ...

    def tilt_deg(self) -> float:
        """Return the tilt relative to gravity; with `Capability.TILT`, as `tilt_to`, `roll_deg`."""
        ...

    def tilt_to(self, tilt_deg: float) -> None:
        """Tilt the sensor and wait until it stands still."""
        ...

    def roll_deg(self) -> float:
        """Return the roll angle, which no motor can correct."""
        ...

    def blink(self, on: bool) -> None:
        """Make its light blink, by which it is found, or light steadily; `Capability.BLINK`."""
        ...

    def keep_warm_up(self) -> None:
        """Note how long it has been on, in case this process is killed."""
        ...

    def close(self) -> None:
        """Stop everything and release the sensor, also when it has been unplugged."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None: ...


class SensorPort(Protocol):
    """Finds and opens the sensors of one family."""

    def find(self) -> tuple[DetectedSensor, ...]:
        """List the sensors that are plugged in, without disturbing any.

        Raises
        ------
        SensorError
        """
        ...

    def places(self) -> frozenset[Place]:
        """Return where sensors are plugged in, without querying them; a replug changes it.

        Raises
        ------
        SensorError
        """
        ...

    def open(self, serial: str) -> OpenSensor:
        """Open a sensor.

        Raises
        ------
        NoSensorFoundError
            When it is not plugged in, or of another family.
        SensorError
            When it has no power or no permission, or another program uses it.
        """
        ...


_PREVIEW_PX = 640
ImageArray = TypeVar("ImageArray", bound=NDArray[Any])


def small_color(picture: ImageArray) -> ImageArray:
    """Return a picture to look at: every second or third pixel, up to 640 in a row."""
    step = -(-picture.shape[1] // _PREVIEW_PX)
    return cast("ImageArray", picture[::step, ::step])


_LACKS = {
    Capability.TILT: Message("has no motor; turn it by hand"),
    Capability.BLINK: Message("has no light that blinks; cover it to see which one it is"),
    Capability.PAIR: Message("sends no pair of infrared pictures; start it with them"),
    Capability.TIMED: Message("does not tell when its pictures were taken; use another one"),
    Capability.TOGETHER: Message("disturbs others with its light; take its view alone"),
    Capability.INFRARED: Message("sends no infrared pictures; choose one that does"),
    Capability.PRESET: Message("judges its depth in one way only; leave out the preset"),
    Capability.LASER: Message("has a projector of one power only; leave the power as it is"),
    Capability.HAS_PAIR: Message("has no pair of infrared pictures; leave them out"),
}


def lack_of(sensor: OpenSensor | SensorState, capability: Capability) -> Message | None:
    """Return the sentence that a sensor cannot do something and what to do; None if it can."""
    if capability in sensor.capabilities:
        return None
    return Message("Sensor {serial} {lacks}.", serial=sensor.serial, lacks=_LACKS[capability])


def lacking(sensors: Iterable[OpenSensor | SensorState], capability: Capability) -> tuple[str, ...]:
    """Return the serial numbers of the sensors that cannot do something."""
    return tuple(one.serial for one in sensors if capability not in one.capabilities)


def require(sensor: OpenSensor, capability: Capability) -> None:
    """Check that a sensor can do what somebody asks of it.

    Raises
    ------
    SensorError
    """
    lack = lack_of(sensor, capability)
    if lack is not None:
        raise SensorError(lack)
