"""What Debian's unmodified libfreenect gets from the sensors on a bus; the standard library only.

Usage: freenect_client.py REQUEST OUT. The request (JSON) names formats by serial number, turn by
turn, and how many frames; these and tables of depths are written to the folder OUT, the rest to
OUT/result.json.
"""

from __future__ import annotations

import ctypes
import json
import sys
import time
from pathlib import Path
from typing import Any

LIBRARY = "libfreenect.so.0.5"
DEPTH_FORMATS = {"depth-11": 0, "depth-10": 1}
VIDEO_FORMATS = {
    "rgb-640x480": (1, 0),
    "bayer-640x480": (1, 1),
    "bayer-1280x1024": (2, 1),
    "ir-640x488": (1, 3),
    "ir-1280x1024": (2, 3),
}
CAMERA_ONLY = 2
LIMIT_S = 15.0


class Mode(ctypes.Structure):
    _fields_ = [
        ("reserved", ctypes.c_uint32),
        ("resolution", ctypes.c_int),
        ("format", ctypes.c_int32),
        ("bytes", ctypes.c_int32),
        ("width", ctypes.c_int16),
        ("height", ctypes.c_int16),
        ("bits", ctypes.c_int8),
        ("padding_bits", ctypes.c_int8),
        ("framerate", ctypes.c_int8),
        ("is_valid", ctypes.c_int8),
    ]


class Registration(ctypes.Structure):
    _fields_ = [
        ("info", ctypes.c_int32 * 29),
        ("padding", ctypes.c_uint16 * 3),
        ("zero_plane", ctypes.c_float * 4),
        ("const_shift", ctypes.c_double),
        ("raw_to_mm", ctypes.c_void_p),
        ("shift", ctypes.c_void_p),
        ("table", ctypes.c_void_p),
    ]


class TimeValue(ctypes.Structure):
    _fields_ = [("seconds", ctypes.c_long), ("microseconds", ctypes.c_long)]


Callback = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_uint32)


def load() -> Any:
    library = ctypes.CDLL(LIBRARY)
    for name in ("freenect_find_video_mode", "freenect_find_depth_mode"):
        getattr(library, name).restype = Mode
    library.freenect_copy_registration.restype = Registration
    for kind in ("depth", "video"):
        getattr(library, f"freenect_set_{kind}_mode").argtypes = [ctypes.c_void_p, Mode]
        getattr(library, f"freenect_set_{kind}_callback").argtypes = [ctypes.c_void_p, Callback]
        getattr(library, f"freenect_start_{kind}").argtypes = [ctypes.c_void_p]
        getattr(library, f"freenect_stop_{kind}").argtypes = [ctypes.c_void_p]
    library.freenect_copy_registration.argtypes = [ctypes.c_void_p]
    library.freenect_close_device.argtypes = [ctypes.c_void_p]
    return library


class Device:
    """One sensor, open."""

    def __init__(self, library: Any, context: Any, serial: str) -> None:
        self.library = library
        self.serial = serial
        self.frames: dict[str, list[bytes]] = {}
        self.callbacks: dict[str, Any] = {}
        self.handle = ctypes.c_void_p()
        code = library.freenect_open_device_by_camera_serial(
            context, ctypes.byref(self.handle), serial.encode()
        )
        if code != 0:
            raise SystemExit(f"{serial} cannot be opened: {code}")

    def start(self, modes: dict[str, str]) -> None:
        self.frames = {kind: [] for kind in modes}
        if "depth" in modes:
            mode = self.library.freenect_find_depth_mode(1, DEPTH_FORMATS[modes["depth"]])
            self.start_one("depth", mode)
        if "video" in modes:
            mode = self.library.freenect_find_video_mode(*VIDEO_FORMATS[modes["video"]])
            self.start_one("video", mode)

    def start_one(self, kind: str, mode: Mode) -> None:
        def keep(_device: Any, data: int, _time: int) -> None:
            self.frames[kind].append(ctypes.string_at(data, mode.bytes))

        self.callbacks[kind] = Callback(keep)
        getattr(self.library, f"freenect_set_{kind}_callback")(self.handle, self.callbacks[kind])
        for verb in ("set", "start"):
            name = f"freenect_set_{kind}_mode" if verb == "set" else f"freenect_start_{kind}"
            arguments = (self.handle, mode) if verb == "set" else (self.handle,)
            if getattr(self.library, name)(*arguments) != 0:
                raise SystemExit(f"{name} failed on {self.serial}")

    def is_short_of(self, wanted: int) -> bool:
        return any(len(frames) < wanted for frames in self.frames.values())

    def stop(self) -> None:
        for kind in self.frames:
            getattr(self.library, f"freenect_stop_{kind}")(self.handle)

    def save_table(self, folder: Path) -> dict[str, Any]:
        found = self.library.freenect_copy_registration(self.handle)
        table = ctypes.string_at(found.raw_to_mm, 2048 * 2)
        (folder / f"{self.serial}-raw_to_mm").write_bytes(table)
        return {
            "info": list(found.info),
            "padding": list(found.padding),
            "zero_plane": list(found.zero_plane),
            "const_shift": found.const_shift,
        }


def stream(library: Any, context: Any, devices: list[Device], wanted: int, limit_s: float) -> None:
    """Let each device stream until it has sent what is wanted, or time is up; then stop it."""
    deadline = time.monotonic() + limit_s
    streaming = set(devices)
    while streaming and time.monotonic() <= deadline:
        for device in [one for one in streaming if not one.is_short_of(wanted)]:
            device.stop()
            streaming.remove(device)
        library.freenect_process_events_timeout(context, ctypes.byref(TimeValue(0, 20_000)))
    for device in streaming:
        device.stop()


def run(request: dict[str, Any], folder: Path) -> None:
    library = load()
    context = ctypes.c_void_p()
    if library.freenect_init(ctypes.byref(context), None) != 0:
        raise SystemExit("freenect_init failed")
    library.freenect_select_subdevices(context, CAMERA_ONLY)
    turns = request["turns"]
    devices = [Device(library, context, serial) for serial in turns[0]]
    wanted = request.get("frames", 0)
    for turn, modes_of in enumerate(turns):
        for device in devices:
            device.start(modes_of[device.serial])
        stream(library, context, devices, wanted, request.get("limit_s", LIMIT_S))
        for device in devices:
            for kind, frames in device.frames.items():
                for number, frame in enumerate(frames):
                    (folder / f"{device.serial}-{turn}-{kind}-{number}").write_bytes(frame)
    result = {}
    for device in devices:
        result[device.serial] = device.save_table(folder)
        library.freenect_close_device(device.handle)
    (folder / "result.json").write_text(json.dumps(result), encoding="utf-8")


if __name__ == "__main__":
    run(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")), Path(sys.argv[2]))
