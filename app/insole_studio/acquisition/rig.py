"""The sensors of this computer, of all families, or emulated ones."""

from __future__ import annotations

from itertools import chain

from insole_studio.acquisition.messages import DetectedSensor
from insole_studio.acquisition.sensor_port import (
    NoSensorFoundError,
    OpenSensor,
    Place,
    SensorError,
    SensorPort,
)


class Rig:
    """Finds and opens sensors.

    Parameters
    ----------
    ports
        One for each family of sensors, live or emulated; at least one.
    """

    def __init__(self, *ports: SensorPort) -> None:
        self._ports = ports

    def find(self) -> tuple[DetectedSensor, ...]:
        """List the sensors that are plugged in, without disturbing any.

        Raises
        ------
        SensorError
            When a family cannot be looked for, and no other one has a sensor.
        """
        found: list[DetectedSensor] = []
        failures: list[SensorError] = []
        for port in self._ports:
            try:
                found += port.find()
            except SensorError as error:
                failures.append(error)
        if failures and not found:
            raise failures[0]
        return tuple(found)

    def places(self) -> frozenset[Place]:
        """Return where sensors are plugged in, without querying them; a replug changes it.

        Raises
        ------
        SensorError
        """
        return frozenset(chain.from_iterable(port.places() for port in self._ports))

    def require(self) -> tuple[DetectedSensor, ...]:
        """List the sensors that are plugged in, and raise if there are none.

        Raises
        ------
        NoSensorFoundError, SensorError
        """
        found = self.find()
        if not found:
            raise NoSensorFoundError(
                "No Kinect is plugged in; plug in its USB cable and its 12 V supply."
            )
        return found

    def open(self, serial: str) -> OpenSensor:
        """Open a sensor.

        Raises
        ------
        SensorError
            When it is not plugged in, has no power or no permission, or another program uses it.
        """
        *others, last = self._ports
        for port in others:
            try:
                return port.open(serial)
            except NoSensorFoundError:
                continue
        return last.open(serial)
