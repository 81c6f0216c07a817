"""A bench of emulated sensors whose every frame is different, and known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.geometry.side import Side
from insole_core.recording.session import CaptureCondition, Manifest
from insole_core.resources import resource_path
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import CapturePlan
from insole_studio.acquisition.capture_runner import (
    CaptureCallbacks,
    CaptureRunner,
    close_sensors,
    open_sensors,
)
from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM, CaptureSetup, SensorFiles
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.messages import CaptureStatus
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import OpenSensor, SensorError
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.models import Model
from kinect_v1.pixels import NO_READING
from kinect_v1.usb_bus import UsbBus

SERIALS = ("A1", "B2", "C3")
VIEWS = ("left", "right", "top")
ASSIGNMENT = tuple(zip(VIEWS, SERIALS, strict=True))
SPEED = 8.0
FRAMES = 4

RawFrames = list[NDArray[np.uint16]]


class NothingStored:
    """No sensor was ever calibrated here."""

    def load(self, _serial: str) -> Sensor | None:
        return None

    def reference(self, _serial: str) -> InfraredReference | None:
        return None


@cache
def footage(seed: int, warm_up: int) -> Mapping[str, list[bytes]]:
    return make_footage(depth_frames(seed, warm_up), [color_mosaic(seed)])


def depth_frames(seed: int, warm_up: int = 0) -> RawFrames:
    """Frames of one still scene, each with a mark of its own; the first ones are still dark."""
    rows, columns = np.mgrid[:480, :640]
    scene = (600 + 50 * seed + rows // 8 + columns // 16).astype(np.uint16)
    scene[:, :200] = NO_READING
    frames = []
    for index in range(warm_up + 8):
        frame = scene.copy()
        frame[0, 0] = 400 + index
        if index < warm_up:
            frame[index * 480 // warm_up :] = NO_READING
        frames.append(frame)
    return frames


def color_mosaic(seed: int) -> NDArray[np.uint8]:
    rows, columns = np.mgrid[:480, :640]
    return (40 + 20 * seed + rows // 4 + columns // 32).astype(np.uint8)


@dataclass
class Bench:
    """All that a capture needs."""

    kinects: dict[str, EmulatedKinect]
    depth: dict[str, RawFrames]
    emulated: EmulatedBus
    rig: Rig
    setup: CaptureSetup
    draft: Draft
    told: list[CaptureStatus] = field(default_factory=list)
    sensors: dict[str, OpenSensor] = field(default_factory=dict)

    def capture(self, plan: CapturePlan, **watching: Any) -> tuple[str, ...]:
        """Open the sensors of a plan and carry it out."""
        if not self.sensors:
            self.sensors = open_sensors(self.rig, plan.serials)
        callbacks = CaptureCallbacks(**{"report": self.told.append, **watching})
        return CaptureRunner(self.sensors, plan, self.setup, self.draft, callbacks).run()

    def close(self) -> None:
        try:
            close_sensors(self.sensors.values())
        except SensorError:
            assert any(not kinect.camera.registers for kinect in self.kinects.values())
        self.draft.close()


def make_bench(
    folder: Path,
    stored: SensorFiles,
    *,
    controllers: Sequence[int] | None = None,
    serials: Sequence[str] = SERIALS,
    warm_up: int = 0,
    powered: bool = True,
) -> Bench:
    depth = {serial: depth_frames(i, warm_up) for i, serial in enumerate(serials)}
    kinects = {
        serial: EmulatedKinect(
            Model.XBOX_1414,
            serial,
            TYPICAL_CALIBRATION,
            footage(i, warm_up),
            powered=powered,
        )
        for i, serial in enumerate(serials)
    }
    emulated = EmulatedBus(list(kinects.values()), controllers, SPEED)
    system = load_reference_system(resource_path(DEFAULT_SYSTEM))
    setup = CaptureSetup(system, stored)
    manifest = Manifest(
        "2026-11-20T10:00:00+00:00",
        Side.LEFT,
        system,
        (),
        capture_condition=CaptureCondition("semi", True, "cold feet"),
    )
    draft = Draft(folder, manifest, VIEWS)
    return Bench(kinects, depth, emulated, Rig(KinectPort(UsbBus(emulated))), setup, draft)
