"""Kinects built from a scenario, with planted errors that a correct client has to notice.

The standard library only: the emulator of usbfs runs under the distribution's Python.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.emulation.descriptors import (
    BULK,
    CAMERA_ENDPOINTS,
    Endpoint,
    configuration_descriptor,
)
from kinect_v1.emulation.device import EmulatedCamera, EmulatedKinect
from kinect_v1.emulation.packet_source import Fault
from kinect_v1.models import Model
from kinect_v1.modes import MODES, StreamMode

ALWAYS = 1 << 40


class ShiftedCamera(EmulatedCamera):
    """Sends its zero plane two bytes too late."""

    def fixed_parameters(self) -> bytes:
        """Give the reply, shifted."""
        return (b"\0\0" + super().fixed_parameters())[:-2]


class OddCamera(EmulatedCamera):
    """Without a flaw, but unlike the usual one in all that the protocol leaves open."""

    def __init__(self, model: Model, *rest: Any) -> None:
        super().__init__(model, *rest)
        endpoints = CAMERA_ENDPOINTS[::-1]
        alternates = ((), endpoints, ()) if model.streaming_alternate else (endpoints, ())
        further = ((Endpoint(0x83, BULK, 512),), ())
        self.configuration_descriptor = configuration_descriptor((alternates, further), 500)
        self._waiting: dict[int, list[bytes]] = {}

    def control_in(self, kind: int, request: int, value: int, length: int) -> bytes:
        """Speak German."""
        if (kind, request, value) == (0x80, 0x06, 0x0300):
            return bytes((4, 3, 0x07, 0x04))
        return super().control_in(kind, request, value, length)

    def control_out(self, kind: int, request: int, value: int, data: bytes) -> None:
        """Take long to reply, with garbage before."""
        super().control_out(kind, request, value, data)
        self._replies[-1:-1] = [b""] * 3 + [b"\x5a" * 512] * 2 + [b""] * 2

    def microframes(self, endpoint: int, count: int) -> list[bytes]:
        """Pause in the midst of frames, count from elsewhere, and fill the unknown bytes."""
        waiting = self._waiting.setdefault(endpoint, [])
        while len(waiting) < count:
            for number, packet in enumerate(super().microframes(endpoint, 7)):
                waiting.append(_odd_packet(packet))
                waiting += [b""] * (number % 3 == 1)
        given, self._waiting[endpoint] = waiting[:count], waiting[count:]
        return given


def _odd_packet(packet: bytes) -> bytes:
    if not packet:
        return packet
    sequence, time = (packet[5] + 200) & 0xFF, int.from_bytes(packet[8:12], "little")
    later = ((time + 0xFFFF_F000) & 0xFFFF_FFFF).to_bytes(4, "little")
    return packet[:4] + bytes((0xEE, sequence, 0x01, 0xFF)) + later + packet[12:]


def _smaller_payload(mode: StreamMode) -> StreamMode:
    return replace(mode, kind=replace(mode.kind, payload_bytes=mode.kind.payload_bytes - 8))


def build_kinect(settings: dict[str, Any]) -> EmulatedKinect:
    """Build a sensor from its part of a scenario; footage is given as files."""
    values = settings["calibration"]
    calibration = Calibration(
        ZeroPlane(**values["zero_plane"]),
        RegistrationInfo(**values["registration"]),
        Padding(**values["padding"]),
        values["constant_shift"],
    )
    footage = {
        mode: [Path(file).read_bytes() for file in files]
        for mode, files in settings["footage"].items()
    }
    model, serial = Model(settings["model"]), settings["serial"]
    kinect = EmulatedKinect(model, serial, calibration, footage, **settings.get("options", {}))
    flaw = settings.get("flaw")
    modes = {name: _smaller_payload(mode) for name, mode in MODES.items()}
    if flaw == "odd":
        kinect.camera = OddCamera(model, serial, calibration, footage)
    elif flaw == "payload":
        kinect.camera = EmulatedCamera(model, serial, calibration, footage, modes)
    elif flaw == "calibration offset":
        kinect.camera = ShiftedCamera(model, serial, calibration, footage)
    elif flaw in ("flag", "sequence"):
        for stream in ("depth", "video"):
            kinect.camera.inject(Fault(flaw, stream, count=ALWAYS))
    elif flaw == "reply tag":
        kinect.camera.inject(Fault("reply tag", count=ALWAYS))
    for fault in settings.get("faults", ()):
        kinect.camera.inject(Fault(**fault))
    return kinect
