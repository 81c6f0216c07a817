"""The sensors of this computer, of all families, or emulated ones."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from insole_core.messages import joined
from insole_studio.acquisition.messages import DetectedSensor
from insole_studio.acquisition.sensor_port import (
    NoSensorFoundError,
    OpenSensor,
    Place,
    SensorError,
    SensorPort,
)


@dataclass(frozen=True)
class FoundSensors:
    """The sensors that are plugged in, and why others may be missing.

    Parameters
    ----------
    sensors
    problems
        Why a family could not be looked for, a sentence each.
    """

    sensors: tuple[DetectedSensor, ...]
    problems: tuple[str, ...] = ()


class Rig:
    """Finds and opens sensors.

    Parameters
    ----------
    ports
        One for each family of sensors, live or emulated; at least one.
    """

    def __init__(self, *ports: SensorPort) -> None:
        self._ports = ports

    def find(self) -> FoundSensors:
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
            raise _all_of(failures)
        return FoundSensors(tuple(found), tuple(str(error) for error in failures))

    def places(self) -> frozenset[Place]:
        """Return where sensors are plugged in, without querying them; a replug changes it.

        A family that cannot be looked for has none; `find` says why.
        """
        places: set[Place] = set()
        for port in self._ports:
            with suppress(SensorError):
                places |= port.places()
        return frozenset(places)

    def require(self) -> FoundSensors:
        """List the sensors that are plugged in, and raise if there are none.

        Raises
        ------
        NoSensorFoundError, SensorError
        """
        found = self.find()
        if not found.sensors:
            raise NoSensorFoundError(
                "No sensor is plugged in; plug in its USB cable, and its power supply if it has "
                "one."
            )
        return found

    def open(self, serial: str) -> OpenSensor:
        """Open a sensor.

        Raises
        ------
        SensorError
            When it is not plugged in, has no power or no permission, or another program uses it.
        """
        failures: list[SensorError] = []
        for port in self._ports:
            try:
                return port.open(serial)
            except SensorError as error:
                failures.append(error)
        others = [error for error in failures if not isinstance(error, NoSensorFoundError)]
        raise _all_of(others or failures)


def _all_of(failures: Sequence[SensorError]) -> SensorError:
    """Return the only failure, or one that tells all of them."""
    if len(failures) == 1:
        return failures[0]
    kinds = {type(error) for error in failures}
    kind = NoSensorFoundError if kinds == {NoSensorFoundError} else SensorError
    return kind(joined((str(error) for error in failures), " "))
