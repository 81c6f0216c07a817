"""Tilt, LED and accelerometer: by the motor of model 1414, by the audio function of the others."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from kinect_v1.errors import ProtocolError, UnsupportedError
from kinect_v1.models import Model
from kinect_v1.usb_bus import UsbFunction

TILT_LIMIT_DEG = 31
COUNTS_PER_G = 819

_TIMEOUT_MS = 250
_COMMAND_MAGIC = 0x06022009
_REPLY_MAGIC = 0x0A6FE000
_AUDIO_OUT, _AUDIO_IN = 0x01, 0x81
_AUDIO_STATE_BYTES = 104


class Led(Enum):
    """LED states that every model can show."""

    OFF = "off"
    GREEN = "green"
    RED = "red"
    BLINK_GREEN = "blink green"


_MOTOR_LED = {Led.OFF: 0, Led.GREEN: 1, Led.RED: 2, Led.BLINK_GREEN: 4}
_AUDIO_LED = {Led.OFF: 1, Led.BLINK_GREEN: 2, Led.GREEN: 3, Led.RED: 4}


@dataclass(frozen=True)
class Posture:
    """The orientation of the sensor.

    Parameters
    ----------
    acceleration_g
        x, y, z of the accelerometer, g.
    tilt_deg
        Of the motor, relative to gravity; None while it moves.
    moving
        None where the model does not say.
    """

    acceleration_g: tuple[float, float, float]
    tilt_deg: float | None
    moving: bool | None


class Motor(Protocol):
    """The function that tilts a sensor and sets its LED."""

    def set_led(self, led: Led) -> None:
        """Set the LED."""
        ...

    def set_tilt(self, tilt_deg: float) -> None:
        """Start to tilt, within the limits of the housing."""
        ...

    def posture(self) -> Posture:
        """Read accelerometer and tilt."""
        ...

    def close(self) -> None:
        """Release the function."""
        ...


def open_motor(model: Model, companion: UsbFunction | None) -> Motor:
    """Open the function that tilts a sensor and sets its LED.

    Parameters
    ----------
    companion
        Motor or audio function in the camera's housing, if there is one.

    Raises
    ------
    UnsupportedError
        When the sensor has none on this bus.
    """
    if companion is None:
        raise UnsupportedError(
            "This sensor's motor and LED do not answer; unplug the sensor and plug it in again."
        )
    return MotorFunction(companion) if model.has_motor_function else AudioFunction(companion)


def _clamp(tilt_deg: float) -> float:
    return max(-TILT_LIMIT_DEG, min(TILT_LIMIT_DEG, tilt_deg))


class MotorFunction:
    """The motor of model 1414: control requests only."""

    def __init__(self, function: UsbFunction) -> None:
        self._function = function
        self._function.claim()

    def set_led(self, led: Led) -> None:
        """Set the LED."""
        self._function.control_out(0x06, _MOTOR_LED[led])

    def set_tilt(self, tilt_deg: float) -> None:
        """Start to tilt; clamped to ±31°."""
        self._function.control_out(0x31, round(2 * _clamp(tilt_deg)) & 0xFFFF)

    def posture(self) -> Posture:
        """Read accelerometer and tilt."""
        state = self._function.control_in(0x32, 10)
        if len(state) < 10:
            raise ProtocolError("The motor's answer is too short; plug the sensor in again.")
        x, y, z, half_degrees, status = struct.unpack_from(">hhhbB", state, 2)
        acceleration = (x / COUNTS_PER_G, y / COUNTS_PER_G, z / COUNTS_PER_G)
        tilt = None if half_degrees == -128 else half_degrees / 2
        return Posture(acceleration, tilt, status == 4)

    def close(self) -> None:
        """Release the function."""
        self._function.close()


class AudioFunction:
    """The audio function of model 1473 and Kinect for Windows.

    Only its firmware can move the motor; it is Microsoft's and not ours to upload. If it is not
    running, only the LED can be set.
    """

    def __init__(self, function: UsbFunction) -> None:
        self._function = function
        self._has_firmware = function.interface_count >= 2
        self._tag = 0
        self._function.claim()

    def set_led(self, led: Led) -> None:
        """Set the LED."""
        self._send(0, 0x10, struct.pack("<I", _AUDIO_LED[led]))
        self._check_reply()

    def set_tilt(self, tilt_deg: float) -> None:
        """Start to tilt; clamped to ±31°."""
        self._require_firmware()
        self._send(0, 0x803B, struct.pack("<i", round(_clamp(tilt_deg))))
        self._check_reply()

    def posture(self) -> Posture:
        """Read accelerometer and tilt."""
        self._require_firmware()
        self._send(0x68, 0x8032)
        state = self._function.bulk_in(_AUDIO_IN, 256, _TIMEOUT_MS)
        self._check_reply()
        if len(state) != _AUDIO_STATE_BYTES:
            raise ProtocolError("The audio part's answer is damaged; plug the sensor in again.")
        x, y, z, tilt = struct.unpack_from("<4i", state, 16)
        return Posture((x / COUNTS_PER_G, y / COUNTS_PER_G, z / COUNTS_PER_G), float(tilt), None)

    def close(self) -> None:
        """Release the function."""
        self._function.close()

    def _require_firmware(self) -> None:
        if not self._has_firmware:
            raise UnsupportedError(
                "The motor of this sensor does not run because its audio firmware is not loaded; "
                "tilt the sensor by hand."
            )

    def _send(self, argument: int, command: int, data: bytes = b"") -> None:
        head = struct.pack("<4I", _COMMAND_MAGIC, self._tag, argument, command)
        self._function.bulk_out(_AUDIO_OUT, head + data, _TIMEOUT_MS)

    def _check_reply(self) -> None:
        reply = self._function.bulk_in(_AUDIO_IN, 512, _TIMEOUT_MS)
        expected = struct.pack("<3I", _REPLY_MAGIC, self._tag, 0)
        self._tag += 1
        if reply != expected:
            raise ProtocolError("The audio part refused a command; plug the sensor in again.")
