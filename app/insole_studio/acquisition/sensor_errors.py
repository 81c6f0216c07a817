"""Errors of sensors, with the driver's messages."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from insole_core.errors import InsoleError
from kinect_v1.errors import BandwidthError, KinectError, NoSensorError

log = logging.getLogger(__name__)


class SensorError(InsoleError):
    """A sensor is missing, cannot be used, or stopped working."""


class NoSensorFoundError(SensorError):
    """No sensor is plugged in, or not the requested one."""


class BusFullError(SensorError):
    """The USB controller cannot carry another stream."""


_KINDS: tuple[tuple[type[KinectError], type[SensorError]], ...] = (
    (BandwidthError, BusFullError),
    (NoSensorError, NoSensorFoundError),
)


@contextmanager
def translating() -> Iterator[None]:
    """Convert the driver's errors, whose messages are sentences already, to the application's."""
    try:
        yield
    except KinectError as error:
        log.warning("%s", error)
        kind = next((ours for theirs, ours in _KINDS if isinstance(error, theirs)), SensorError)
        raise kind(str(error)) from error
