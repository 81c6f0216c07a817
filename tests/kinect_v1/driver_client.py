"""What this driver gets from the sensors on a bus; run on an emulated usbfs by its tests.

Usage: driver_client.py VERB REQUEST OUT, with VERB one of the functions below. The request is JSON;
frames and findings are written to the folder OUT.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from kinect_v1.errors import KinectError
from kinect_v1.kinect_camera import CameraSettings, KinectCamera, open_camera
from kinect_v1.modes import MODES
from kinect_v1.motor import Led
from kinect_v1.streams import Stream
from kinect_v1.usb_bus import UsbBus, system_bus

PATIENT = CameraSettings(watchdog_s=10.0)
"""The emulator is slower than a device."""


def start(camera: KinectCamera, modes: dict[str, str]) -> dict[str, Stream]:
    streams = {}
    if "depth" in modes:
        streams["depth"] = camera.start_depth(MODES[modes["depth"]])
    if "video" in modes:
        streams["video"] = camera.start_video(MODES[modes["video"]])
    return streams


def stream(request: dict[str, Any], out: Path, bus: UsbBus) -> dict[str, Any]:
    """Read frames of all sensors at the same time, in each turn each in its modes."""
    turns = request["turns"]
    cameras = [open_camera(serial, PATIENT, bus) for serial in turns[0]]
    found: dict[str, Any] = {
        camera.serial: {
            "model": camera.model.value,
            "calibration": camera.calibration.as_dict(),
            "discarded": [],
        }
        for camera in cameras
    }
    for turn, modes in enumerate(turns):
        running = {camera.serial: start(camera, modes[camera.serial]) for camera in cameras}
        for camera in cameras:
            counts = {}
            for kind, one in running[camera.serial].items():
                frames = [one.read() for _ in range(request["frames"])]
                images = [frame.image for frame in frames]
                np.save(out / f"{camera.serial}-{turn}-{kind}.npy", images)
                counts[kind] = one.counts.discarded
            found[camera.serial]["discarded"].append(counts)
            camera.stop_depth()
            camera.stop_video()
    for camera in cameras:
        camera.close()
    return found


def share_controller(request: dict[str, Any], out: Path, bus: UsbBus) -> dict[str, Any]:
    """Stream from two sensors on one controller: together, then one after the other."""
    one, other = (open_camera(serial, PATIENT, bus) for serial in request["serials"])
    start(one, request["modes"])
    try:
        other.start_depth()
    except KinectError as error:
        together = [type(error).__name__, str(error)]
    one.stop_depth()
    one.stop_video()
    frame = other.start_depth().read()
    np.save(out / "alone.npy", frame.image)
    one.close()
    other.close()
    return {"together": together}


def survive_unplug(request: dict[str, Any], out: Path, bus: UsbBus) -> dict[str, Any]:
    """Read until the sensor is unplugged, then open it again."""
    (serial,) = request["serials"]
    camera = open_camera(serial, PATIENT, bus)
    depth = camera.start_depth()
    depth.read()
    print("streaming", flush=True)
    images = []
    try:
        while True:
            images.append(depth.read().image)
    except KinectError as error:
        lost = [type(error).__name__, str(error)]
    np.save(out / "before.npy", images[-50:])
    camera.close()
    print("lost", flush=True)
    sys.stdin.readline()
    with open_camera(serial, PATIENT, bus) as again:
        np.save(out / "after.npy", again.start_depth().read().image)
    return {"lost": lost}


def hold(request: dict[str, Any], out: Path, bus: UsbBus) -> dict[str, Any]:
    """Stream from a sensor until standard input ends."""
    (serial,) = request["serials"]
    with open_camera(serial, PATIENT, bus) as camera:
        camera.start_depth().read()
        print("streaming", flush=True)
        sys.stdin.readline()
    return {}


def move(request: dict[str, Any], out: Path, bus: UsbBus) -> dict[str, Any]:
    """Tilt and light every sensor, and tell how it stands."""
    postures = {}
    for serial in request["serials"]:
        with open_camera(serial, PATIENT, bus) as camera:
            camera.motor.set_led(Led.RED)
            camera.motor.set_tilt(-7)
            postures[serial] = asdict(camera.motor.posture())
    return postures


VERBS = {verb.__name__: verb for verb in (stream, share_controller, survive_unplug, hold, move)}


if __name__ == "__main__":
    asked = json.loads(Path(sys.argv[2]).read_text(encoding="utf-8"))
    folder = Path(sys.argv[3])
    answer = VERBS[sys.argv[1]](asked, folder, system_bus())
    (folder / "result.json").write_text(json.dumps(answer), encoding="utf-8")
