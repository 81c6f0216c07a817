"""Kinects built from a scenario, with planted errors that a correct client has to notice.

The standard library only: the emulator of usbfs runs under the distribution's Python.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.emulation.device import EmulatedCamera, EmulatedKinect
from kinect_v1.emulation.faults import Fault
from kinect_v1.models import Model
from kinect_v1.modes import MODES, StreamMode

ALWAYS = 1 << 40


class ShiftedCamera(EmulatedCamera):
    """Sends its zero plane two bytes too late."""

    def fixed_parameters(self) -> bytes:
        """Give the reply, shifted."""
        return (b"\0\0" + super().fixed_parameters())[:-2]


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
    if flaw == "payload":
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
