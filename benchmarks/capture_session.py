"""How long a capture of three views × 10 frames takes, beside the thesis's 5 s by hand.

Emulated sensors run at the real frame rate; their projectors need 200 ms after they are switched
on. Measured is the time from the command to the last frame, during which the foot has to be still,
and until the last view is complete on the disk. "Live" sensors stream already, as in the window;
for "dark" ones the start of all streams counts too, as on the command line. The emulated sensors
compute in this process too.

Limits until the last view is on the disk: one emitter after the other 2.5 s; simultaneous, sensors
live, 0.5 s.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks._measure import print_table
from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.geometry.side import Side
from insole_core.recording.session import Manifest
from insole_core.resources import resource_path
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import make_plan
from insole_studio.acquisition.capture_runner import (
    CaptureCallbacks,
    CaptureRunner,
    close_sensors,
    open_sensors,
)
from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM, CaptureSetup
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.messages import CapturePhase, CaptureStatus
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import OpenSensor
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.models import Model
from kinect_v1.usb_bus import UsbBus

VIEWS = (("left", "A1"), ("right", "B2"), ("top", "C3"))
SETTLE_FRAMES = 6  # 200 ms
FRAMES = 10
PLAYED = 120
LIVE_S = 1.0
REPEATS = 3
TURNS_LIMIT_S, TOGETHER_LIMIT_S = 2.5, 0.5
THESIS_S = 5.0


class NothingStored:
    def load(self, _serial: str) -> Sensor | None:
        return None

    def reference(self, _serial: str) -> InfraredReference | None:
        return None


def scene() -> np.ndarray[Any, np.dtype[np.uint16]]:
    """Return depth of the size of a foot in front of an empty background."""
    rows, columns = np.mgrid[:480, :640]
    inside = ((rows - 240) / 150) ** 2 + ((columns - 320) / 60) ** 2 < 1
    return np.where(inside, 600 + rows // 8, 2047).astype(np.uint16)


def footage() -> Mapping[str, list[bytes]]:
    steady = scene()
    warming = []
    for index in range(SETTLE_FRAMES):
        frame = steady.copy()
        frame[100 + 280 * index // SETTLE_FRAMES :] = 2047
        warming.append(frame)
    rows, columns = np.mgrid[:1024, :1280]
    noise = np.random.default_rng(1).normal(0, 1.5, (1024, 1280))
    color = (80 + rows / 20 + columns / 30 + noise).astype(np.uint8)
    return make_footage([*warming, *[steady] * PLAYED], [color])


def wait_until_live(sensors: dict[str, OpenSensor]) -> None:
    for sensor in sensors.values():
        sensor.start()
    end = time.monotonic() + LIVE_S
    while time.monotonic() < end:
        for sensor in sensors.values():
            sensor.poll_depth()
            sensor.poll_video()
        time.sleep(0.005)


def capture_s(
    played: Mapping[str, list[bytes]], simultaneous: bool, live: bool
) -> tuple[float, float]:
    """Return the seconds until the last frame was taken, and until the last view was stored."""
    kinects = [
        EmulatedKinect(Model.XBOX_1414, serial, TYPICAL_CALIBRATION, played) for _, serial in VIEWS
    ]
    rig = Rig(KinectPort(UsbBus(EmulatedBus(kinects))))
    system = load_reference_system(resource_path(DEFAULT_SYSTEM))
    manifest = Manifest("2026-11-20T10:00:00+00:00", Side.LEFT, system, ())
    plan = make_plan(VIEWS, frames=FRAMES, simultaneous=simultaneous)
    sensors = open_sensors(rig, plan.serials)
    with tempfile.TemporaryDirectory() as folder:
        draft = Draft(Path(folder) / "draft", manifest, plan.views)
        try:
            if live:
                wait_until_live(sensors)
            taken: list[float] = []

            def note(status: CaptureStatus) -> None:
                if status.phase is not CapturePhase.VERIFYING:
                    taken.append(time.monotonic())

            setup = CaptureSetup(system, NothingStored())
            start = time.monotonic()
            CaptureRunner(sensors, plan, setup, draft, CaptureCallbacks(note)).run()
            return taken[-1] - start, time.monotonic() - start
        finally:
            close_sensors(sensors.values())
            draft.close()


def main() -> None:
    played = footage()
    rows = []
    for name, simultaneous, live, limit_s in (
        ("one after the other, live", False, True, TURNS_LIMIT_S),
        ("one after the other, dark", False, False, TURNS_LIMIT_S),
        ("simultaneous, live", True, True, TOGETHER_LIMIT_S),
        ("simultaneous, dark", True, False, None),
    ):
        runs = [capture_s(played, simultaneous, live) for _ in range(REPEATS)]
        taken_s, whole_s = (statistics.median(times) for times in zip(*runs, strict=True))
        verdict = "" if limit_s is None else "kept" if whole_s <= limit_s else "BROKEN"
        rows.append((name, f"{taken_s:.2f}", f"{whole_s:.2f}", limit_s or "–", verdict))
    rows.append(("thesis, emitters blocked by hand", f"{THESIS_S:.2f}", "", "", ""))
    print_table(
        ("three views × 10 frames (median)", "last frame s", "on disk s", "limit s", ""), rows
    )


if __name__ == "__main__":
    main()
