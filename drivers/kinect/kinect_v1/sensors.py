"""The plugged-in sensors: cameras, each with the motor or audio function in its housing."""

from __future__ import annotations

from dataclasses import dataclass

from kinect_v1.errors import KinectError, NoPowerError, NoSensorError
from kinect_v1.models import (
    AUDIO_PRODUCTS,
    CAMERA_PRODUCTS,
    MOTOR_PRODUCT,
    Model,
    camera_model,
)
from kinect_v1.usb_bus import UsbBus, UsbFunction


@dataclass(frozen=True)
class SensorInfo:
    """A sensor as found on the bus.

    Parameters
    ----------
    serial
        None if it could not be read.
    model
        None if only the motor answers.
    bus, place
        Number of the USB controller, and port path as the kernel writes it.
    problem
        Why it cannot be used, in one sentence; None if it can.
    """

    serial: str | None
    model: Model | None
    bus: int
    place: str
    problem: str | None = None


@dataclass(frozen=True, eq=False)
class FoundSensor:
    """A camera function with its companion."""

    camera: UsbFunction
    model: Model
    companion: UsbFunction | None

    def serial(self) -> str | None:
        """Return what distinguishes this sensor from all others.

        The cameras of 1473 and Kinect for Windows report zeros; for them it is the serial number of
        the audio function or, if that cannot be read, the port.
        """
        try:
            own = self.camera.serial()
            if own is None or own.strip("0"):
                return own
            theirs = self.companion.serial() if self.companion else None
            return theirs or f"at-{self.camera.place}"
        finally:
            self.close()

    def check_free(self) -> None:
        """Check that no other program uses the camera.

        Raises
        ------
        InUseError
        """
        try:
            self.camera.check_free()
        finally:
            self.close()

    def close(self) -> None:
        """Release both functions."""
        self.camera.close()
        if self.companion is not None:
            self.companion.close()


def find_sensors(bus: UsbBus) -> tuple[list[FoundSensor], list[UsbFunction]]:
    """Return the sensors, sorted by port, and the motors whose camera does not answer."""
    functions = sorted(bus.functions(), key=lambda f: (f.bus, f.ports, f.address))
    cameras = [f for f in functions if f.product in CAMERA_PRODUCTS]
    sensors = []
    for camera in cameras:
        model = camera_model(camera.product, camera.release)
        wanted = (MOTOR_PRODUCT,) if model.has_motor_function else AUDIO_PRODUCTS
        companion = _companion(camera, cameras, [f for f in functions if f.product in wanted])
        sensors.append(FoundSensor(camera, model, companion))
    taken = {id(sensor.companion) for sensor in sensors}
    motors = [f for f in functions if f.product == MOTOR_PRODUCT and id(f) not in taken]
    return sensors, motors


def _companion(
    camera: UsbFunction, cameras: list[UsbFunction], candidates: list[UsbFunction]
) -> UsbFunction | None:
    """Find the function in the same housing.

    It is on the same hub; else the only one on the same bus, or in the computer, if this camera is
    the only one there too.
    """
    for scope in (_same_hub, _same_bus, _anywhere):
        near = [f for f in candidates if scope(f, camera)]
        rivals = [f for f in cameras if scope(f, camera)]
        if len(near) == 1 and (len(rivals) == 1 or scope is _same_hub):
            return near[0]
    return None


def _same_hub(one: UsbFunction, other: UsbFunction) -> bool:
    return bool(one.ports) and (one.bus, one.ports[:-1]) == (other.bus, other.ports[:-1])


def _same_bus(one: UsbFunction, other: UsbFunction) -> bool:
    return one.bus == other.bus


def _anywhere(_one: UsbFunction, _other: UsbFunction) -> bool:
    return True


def list_sensors(bus: UsbBus) -> list[SensorInfo]:
    """Describe every sensor that is plugged in, without disturbing those in use."""
    sensors, motors = find_sensors(bus)
    found = [info for sensor in sensors if (info := _describe(sensor)) is not None]
    return found + [
        SensorInfo(None, None, motor.bus, motor.place, no_power_text(motor)) for motor in motors
    ]


def _describe(sensor: FoundSensor) -> SensorInfo | None:
    """Describe a sensor; return None for a camera that has no serial number at all."""
    camera = sensor.camera
    serial, problem = None, None
    try:
        serial = sensor.serial()
        if serial is None:
            return None
        sensor.check_free()
    except KinectError as error:
        problem = str(error)
    return SensorInfo(serial, sensor.model, camera.bus, camera.place, problem)


def find_sensor(bus: UsbBus, serial: str | None) -> tuple[FoundSensor, str]:
    """Find the sensor with a serial number; None selects the only one.

    Returns
    -------
    tuple of FoundSensor and str
        The sensor and its serial number.

    Raises
    ------
    NoSensorError
        None of that number, or none at all, or several to choose from.
    NoPowerError
        Only a motor answers.
    """
    sensors, motors = find_sensors(bus)
    if not sensors:
        if motors:
            raise NoPowerError(no_power_text(motors[0]))
        raise NoSensorError("No Kinect is plugged in; plug in its USB cable and its 12 V supply.")
    named, unreadable = _named(sensors)
    matching = [pair for pair in named if serial in (None, pair[1])]
    if len(matching) == 1:
        return matching[0]
    numbers = ", ".join(sorted(number for _, number in named)) or "none"
    if matching:
        raise NoSensorError(f"Several sensors are plugged in; choose one of: {numbers}.")
    if unreadable:
        raise unreadable[0]
    raise NoSensorError(f"No sensor has the number {serial}; plugged in now: {numbers}.")


def _named(
    sensors: list[FoundSensor],
) -> tuple[list[tuple[FoundSensor, str]], list[KinectError]]:
    """Return the sensors whose serial number could be read, and the errors of the others."""
    named, unreadable = [], []
    for sensor in sensors:
        try:
            number = sensor.serial()
        except KinectError as error:
            unreadable.append(error)
            continue
        if number is not None:
            named.append((sensor, number))
    return named, unreadable


def no_power_text(motor: UsbFunction) -> str:
    """Return the explanation for a motor without a camera."""
    return (
        f"Of the Kinect at {motor.place} only the motor answers; connect its 12 V supply, without "
        "which the camera stays off."
    )
