"""An emulated Kinect: its USB functions with their state (PROTOCOL.md), in the standard library."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence

from kinect_v1 import calibration as factory
from kinect_v1 import commands
from kinect_v1.calibration import Calibration
from kinect_v1.commands import Algorithm, Opcode
from kinect_v1.emulation.descriptors import (
    AUDIO_ENDPOINTS,
    CAMERA_ENDPOINTS,
    MANUFACTURER,
    Interface,
    configuration_descriptor,
    device_descriptor,
    string_descriptor,
)
from kinect_v1.emulation.packet_source import Fault, FaultPlan, PacketSource
from kinect_v1.errors import ProtocolError
from kinect_v1.models import Model
from kinect_v1.modes import DEPTH, MODES, VIDEO, StreamMode, mode_from_registers
from kinect_v1.packets import PacketBlock

Footage = Mapping[str, Sequence[bytes]]
"""Packed frames by name of the mode; a mode without frames streams nothing."""

_GET_DESCRIPTOR, _STRING = 0x06, 0x03
_POLLS_BEFORE_REPLY = 2
_PENDING_POLLS = 3


class StallError(Exception):
    """The device refuses the request."""


class SilentError(Exception):
    """The device does not answer, and the host's request times out."""


class EmulatedFunction:
    """One USB function.

    Parameters
    ----------
    product, release
        idProduct and bcdDevice.
    strings
        Product, manufacturer, and the serial number where it has one.
    """

    kernel_driver: str | None = None

    def __init__(
        self,
        ids: tuple[int, int],
        strings: tuple[str, ...],
        interfaces: tuple[Interface, ...],
        power_ma: int,
    ) -> None:
        self.device_descriptor = device_descriptor(*ids, has_serial=len(strings) > 2)
        self.configuration_descriptor = configuration_descriptor(interfaces, power_ma)
        self.alternate = 0
        self._strings = strings

    def control_in(self, kind: int, request: int, value: int, length: int) -> bytes:
        """Answer a control request for data."""
        if kind == 0x80 and request == _GET_DESCRIPTOR and value >> 8 == _STRING:
            text = string_descriptor(self._strings, value & 0xFF)
            if text is not None:
                return text[:length]
        raise StallError

    def control_out(self, kind: int, request: int, value: int, data: bytes) -> None:
        """Handle a control request."""
        raise StallError

    def bulk_out(self, data: bytes) -> None:
        """Handle a bulk transfer."""
        raise StallError

    def bulk_in(self) -> bytes:
        """Answer a bulk transfer."""
        raise StallError

    def select_alternate(self, alternate: int) -> None:
        """Handle SET_INTERFACE."""
        self.alternate = alternate

    def microframes(self, endpoint: int, count: int) -> list[bytes]:
        """Return what the next microframes of an isochronous endpoint carry."""
        raise StallError

    def block(self, endpoint: int, count: int, packet_bytes: int) -> PacketBlock:
        """Return the same as a transfer; see `PacketSource.block`."""
        raise StallError


class EmulatedCamera(EmulatedFunction):
    """The camera: command channel, registers, colour sensor, two streams.

    Attributes
    ----------
    registers, cmos
        Their current values.
    """

    kernel_driver = "gspca_kinect"

    def __init__(
        self,
        model: Model,
        serial: str,
        calibration: Calibration,
        footage: Footage,
        modes: Mapping[str, StreamMode] = MODES,
    ) -> None:
        product = 0x02BF if model is Model.WINDOWS else 0x02AE
        release = 0x010B if model is Model.XBOX_1414 else 0x0114
        own = serial if model is Model.XBOX_1414 else "0" * 16
        alternates: Interface = (
            ((), CAMERA_ENDPOINTS) if model.streaming_alternate else (CAMERA_ENDPOINTS,)
        )
        strings = ("Xbox NUI Camera", MANUFACTURER, own)
        super().__init__((product, release), strings, (alternates,), power_ma=16)
        self.registers: dict[int, int] = {}
        self.cmos: dict[int, int] = {commands.CMOS_FLAGS: 0x4082, commands.CMOS_SHUTTER: 600}
        self.footage = footage
        self._model = model
        self._calibration = calibration
        self._modes = modes
        self._faults = {name: FaultPlan() for name in ("command", "depth", "video")}
        self._refusals = {name: FaultPlan() for name in ("depth", "video")}
        self._replies: list[bytes] = []
        self._sources: dict[int, PacketSource | None] = {0x81: None, 0x82: None}

    def reset(self) -> None:
        """Lose all state, as at a power failure."""
        self.registers.clear()
        self.alternate = 0
        self._replies.clear()
        self._sources = dict.fromkeys(self._sources)

    def inject(self, fault: Fault) -> None:
        """Let a fault happen from now on."""
        refusal = fault.kind == "no bandwidth"  # applies to starts, not to packets
        (self._refusals if refusal else self._faults)[fault.where].inject(fault)

    def refuses_stream(self, endpoint: int) -> bool:
        """Return whether a fault makes the controller refuse the stream as full."""
        return bool(self._refusals["depth" if endpoint == DEPTH.endpoint else "video"].step())

    @property
    def emitter_on(self) -> bool:
        """Whether the infrared projector is on."""
        return bool(self.registers.get(DEPTH.switch)) or self.registers.get(VIDEO.switch) == 3

    def control_out(self, kind: int, request: int, value: int, data: bytes) -> None:
        """Handle a command."""
        if (kind, request) != (0x40, 0):
            raise StallError
        struck = self._faults["command"].step()
        if "stall" in struck:
            raise StallError
        try:
            opcode, tag, payload = commands.decode_request(data)
        except ProtocolError as error:
            raise StallError from error
        error_word, answer = self._obey(opcode, payload)
        if "no reply" in struck:
            return
        if "error word" in struck:
            error_word, answer = 5, b""
        if "reply tag" in struck:
            tag ^= 0x55
        self._replies += [b""] * _POLLS_BEFORE_REPLY
        if "full reply" in struck:
            self._replies += [b"\xa5" * commands.REPLY_BYTES] * _PENDING_POLLS
        self._replies.append(commands.encode_reply(opcode, tag, error_word, answer))

    def control_in(self, kind: int, request: int, value: int, length: int) -> bytes:
        """Return the reply to the last command, or nothing while it is not ready."""
        if (kind, request) != (0xC0, 0):
            return super().control_in(kind, request, value, length)
        return self._replies.pop(0)[:length] if self._replies else b""

    def microframes(self, endpoint: int, count: int) -> list[bytes]:
        """Return what the next microframes of an isochronous endpoint carry."""
        source = self._sources[endpoint]
        return source.microframes(count) if source else [b""] * count

    def block(self, endpoint: int, count: int, packet_bytes: int) -> PacketBlock:
        """Return the same as a transfer; see `PacketSource.block`."""
        source = self._sources[endpoint]
        return (
            source.block(count, packet_bytes) if source else PacketBlock.idle(count, packet_bytes)
        )

    def _obey(self, opcode: int, payload: bytes) -> tuple[int, bytes]:
        """Carry out a command; return the error word and the data of the reply."""
        values = struct.unpack(f"<{len(payload) // 2}H", payload)
        if opcode == Opcode.READ_REGISTER and len(values) == 1:
            return 0, commands.words(self.registers.get(values[0], 0))
        if opcode == Opcode.WRITE_REGISTER and len(values) == 2:
            self._set_register(*values)
            return 0, b""
        if opcode == Opcode.CMOS and len(values) == 3:
            return 0, self._cmos(values[1], values[2])
        if opcode == Opcode.FIXED_PARAMETERS and len(values) == 5:
            return 0, self.fixed_parameters()
        if opcode == Opcode.ALGORITHM_PARAMETERS and len(values) == 5:
            return self._algorithm_parameters(values[0])
        return 2, b""

    def fixed_parameters(self) -> bytes:
        """Return the data of the reply that holds the zero plane."""
        total = self._model.fixed_parameter_bytes
        return factory.encode_zero_plane(self._calibration.zero_plane, total)

    def _algorithm_parameters(self, what: int) -> tuple[int, bytes]:
        if what == Algorithm.REGISTRATION:
            return 0, factory.encode_registration(self._calibration.registration)
        if what == Algorithm.PADDING:
            return 0, factory.encode_padding(self._calibration.padding)
        if what == Algorithm.CONSTANT_SHIFT:
            return 0, factory.encode_constant_shift(self._calibration.constant_shift)
        return 5, b""

    def _cmos(self, register: int, value: int) -> bytes:
        number = register & ~commands.CMOS_WRITE
        if register & commands.CMOS_WRITE:
            self.cmos[number] = value
        return commands.words(register, self.cmos.get(number, 0))

    def _set_register(self, register: int, value: int) -> None:
        self.registers[register] = value
        for kind in (DEPTH, VIDEO):
            if register == kind.switch:
                mode = mode_from_registers(kind, self.registers)
                frames = self.footage.get(mode.name) if mode else None
                self._sources[kind.endpoint] = (
                    PacketSource(self._modes[mode.name], frames, self._faults[kind.name])
                    if mode and frames
                    else None
                )


class EmulatedMotor(EmulatedFunction):
    """The motor of model 1414, with LED and accelerometer."""

    def __init__(self, tilted: Callable[[float], None]) -> None:
        super().__init__((0x02B0, 0x0105), ("Xbox NUI Motor", MANUFACTURER), (((),),), power_ma=100)
        self._tilted = tilted
        self.led = 0
        self.tilt_deg = 0.0
        self.acceleration_counts = (0, 819, 0)

    def control_out(self, kind: int, request: int, value: int, data: bytes) -> None:
        """Tilt, or set the LED."""
        if kind != 0x40 or request not in (0x06, 0x31):
            raise StallError
        if request == 0x06:
            self.led = value
        else:
            self.tilt_deg = (value - 0x10000 if value & 0x8000 else value) / 2
            self._tilted(self.tilt_deg)

    def control_in(self, kind: int, request: int, value: int, length: int) -> bytes:
        """Return the state."""
        if kind == 0xC0 and request == 0x10:
            return b"\x22"
        if kind != 0xC0 or request != 0x32:
            return super().control_in(kind, request, value, length)
        tilt = round(2 * self.tilt_deg)
        return struct.pack(">HhhhbB", 0, *self.acceleration_counts, tilt, 0)[:length]


class EmulatedAudio(EmulatedFunction):
    """The audio function, through which model 1473 and Kinect for Windows tilt and set the LED."""

    def __init__(
        self, model: Model, serial: str, tilted: Callable[[float], None], *, firmware: bool
    ) -> None:
        product = (0x02C3 if firmware else 0x02BE) if model is Model.WINDOWS else 0x02AD
        interfaces: tuple[Interface, ...] = ((AUDIO_ENDPOINTS,),)
        if firmware:
            interfaces += (((),),)
        strings = ("Xbox NUI Audio", MANUFACTURER, serial)
        super().__init__((product, 0x0100), strings, interfaces, power_ma=500)
        self.led = 0
        self.tilt_deg = 0
        self.acceleration_counts = (0, 819, 0)
        self._firmware = firmware
        self._tilted = tilted
        self._replies: list[bytes] = []

    def bulk_out(self, data: bytes) -> None:
        """Handle a command."""
        magic, tag, _argument, command = struct.unpack_from("<4I", data)
        status = 0
        if command == 0x10 and len(data) == 20:
            (self.led,) = struct.unpack_from("<I", data, 16)
        elif self._firmware and command == 0x803B and len(data) == 20:
            (self.tilt_deg,) = struct.unpack_from("<i", data, 16)
            self._tilted(self.tilt_deg)
        elif self._firmware and command == 0x8032:
            state = struct.pack("<4i", *self.acceleration_counts, self.tilt_deg)
            self._replies.append(bytes(16) + state + bytes(72))
        else:
            status = 1
        if magic != 0x06022009:
            raise StallError
        self._replies.append(struct.pack("<3I", 0x0A6FE000, tag, status))

    def bulk_in(self) -> bytes:
        """Return the oldest reply."""
        if not self._replies:
            raise SilentError
        return self._replies.pop(0)


class EmulatedKinect:
    """A whole sensor: a hub with a camera, an audio function, and in model 1414 a motor.

    Parameters
    ----------
    footage
        The frames that it plays.
    firmware
        Whether the audio function's firmware is running; ignored for model 1414.
    powered
        Whether the 12 V supply is connected.
    """

    def __init__(
        self,
        model: Model,
        serial: str,
        calibration: Calibration,
        footage: Footage,
        *,
        firmware: bool = True,
        powered: bool = True,
    ) -> None:
        self.model = model
        self.serial = serial
        self.powered = powered
        self.camera = EmulatedCamera(model, serial, calibration, footage)
        self.motor = EmulatedMotor(self._look) if model.has_motor_function else None
        self.audio = EmulatedAudio(model, serial, self._look, firmware=firmware)
        self._scenes: Mapping[float, Footage] = {0.0: footage}

    def face(self, scenes: Mapping[float, Footage]) -> None:
        """Move the sensor; it plays other frames from the next start of a stream on.

        Parameters
        ----------
        scenes
            Frames by tilt in degrees; the nearest tilt is used.
        """
        self._scenes = scenes
        self._look(self.motor.tilt_deg if self.motor else self.audio.tilt_deg)

    def _look(self, tilt_deg: float) -> None:
        nearest = min(self._scenes, key=lambda scene_deg: abs(scene_deg - tilt_deg))
        self.camera.footage = self._scenes[nearest]

    def functions(self) -> list[EmulatedFunction]:
        """Return the functions that respond, in the order of the hub's ports."""
        powered: list[EmulatedFunction] = [self.camera, self.audio] if self.powered else []
        return [*powered, *([self.motor] if self.motor else [])]
