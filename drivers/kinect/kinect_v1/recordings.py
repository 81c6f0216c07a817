"""Recordings in the folder format of fakenect (PROTOCOL.md, section 8).

Depth is stored as received. Colour of 640 × 480 is stored interpolated, as fakenect requires; the
picture as received (Bayer mosaic or infrared, any size) is stored beside it as PNG, which is not
listed in fakenect's index.
"""

from __future__ import annotations

import json
import math
import re
import shutil
import struct
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.errors import RecordingError
from kinect_v1.modes import BAYER_640, PixelFormat
from kinect_v1.motor import COUNTS_PER_G, Posture
from kinect_v1.pixels import ByteArray, RawArray, demosaic
from kinect_v1.streams import Frame

INDEX = "INDEX.txt"
_DEVICE = "device.json"
_MOST_JSON_BYTES = 2**20
_GREATEST = 2**32
"""No number of the sensor's memory is larger."""
_TINY_CM = 1e-6
_POSTURE = struct.Struct("<hhhbxi")
_MOVING = 4
_NAME = re.compile(r"([drabi])-(\d+(?:\.\d+)?)-(\d+)\.(pgm|ppm|dump|png)")
_UNUSED = ("dx_center", "rollout_blank", "rollout_size", "back_comp1", "back_comp2")


@dataclass(frozen=True)
class RecordedFile:
    """One file of a recording.

    Parameters
    ----------
    kind
        d depth, r colour, a accelerometer; b Bayer mosaic and i infrared, beside the index.
    """

    path: Path
    kind: str
    host_time_s: float
    device_time: int


@dataclass(frozen=True)
class Recording:
    """A fakenect folder.

    Parameters
    ----------
    files
        In chronological order.
    serial, model
        None where the recording does not say.
    calibration
        None where there is no device.json.
    """

    files: tuple[RecordedFile, ...]
    serial: str | None
    model: str | None
    calibration: Calibration | None

    def of_kind(self, kind: str) -> tuple[RecordedFile, ...]:
        """Return the files of one kind."""
        return tuple(file for file in self.files if file.kind == kind)


class RecordingWriter:
    """Writes frames into a folder as they arrive; see `recording_folder`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lines: list[str] = []
        self._wall_offset_s = time.time() - time.monotonic()

    def add(self, frame: Frame) -> None:
        """Store one frame."""
        stamp = f"{frame.host_time_s + self._wall_offset_s:f}-{frame.device_time}"
        if frame.mode.pixels is PixelFormat.DEPTH:
            header = f"P5 {frame.mode.width} {frame.mode.height} 65535\n".encode()
            self._store(f"d-{stamp}.pgm", header + frame.image.astype("<u2").tobytes())
            return
        if frame.mode is BAYER_640:
            header = f"P6 {frame.mode.width} {frame.mode.height} 255\n".encode()
            self._store(f"r-{stamp}.ppm", header + demosaic(frame.image).tobytes())
        letter = "b" if frame.mode.pixels is PixelFormat.BAYER else "i"
        _done, png = cv2.imencode(".png", frame.image)
        (self._folder / f"{letter}-{stamp}.png").write_bytes(png.tobytes())

    def add_posture(self, posture: Posture) -> None:
        """Store the reading of the accelerometer."""
        x, y, z = (round(value * COUNTS_PER_G) for value in posture.acceleration_g)
        tilt = -128 if posture.tilt_deg is None else round(2 * posture.tilt_deg)
        status = _MOVING if posture.moving else 0
        self._store(f"a-{time.time():f}-0.dump", _POSTURE.pack(x, y, z, tilt, status))

    def finish(self, serial: str, model: str, calibration: Calibration) -> None:
        """Write the index and the device's calibration.

        Parameters
        ----------
        model
            As in `Recording`.
        """
        (self._folder / INDEX).write_text(
            "".join(f"{line}\n" for line in self._lines), "ascii", newline="\n"
        )
        device = {"serial": serial, "model": model, **_encode_calibration(calibration)}
        (self._folder / _DEVICE).write_text(json.dumps(device, indent=1), "utf-8", newline="\n")

    def _store(self, name: str, data: bytes) -> None:
        (self._folder / name).write_bytes(data)
        self._lines.append(name)


@contextmanager
def recording_folder(folder: Path) -> Iterator[RecordingWriter]:
    """Write a new recording, which appears complete or not at all.

    Raises
    ------
    RecordingError
        When the folder is not empty, or cannot be written.
    """
    beside: Path | None = None
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise RecordingError(f"{folder} is there already; choose another folder.")
        beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=f".{folder.name}."))
        yield RecordingWriter(beside)
        if folder.exists():
            folder.rmdir()
        beside.rename(folder)
    except OSError as error:
        raise RecordingError(
            f"{folder} cannot be written ({error.strerror or error}); choose another place."
        ) from error
    finally:
        if beside is not None and beside.exists():
            shutil.rmtree(beside)


def read_recording(folder: Path) -> Recording:
    """Read the index of a fakenect folder; the frames are read on demand.

    Raises
    ------
    RecordingError
        When the folder is not a recording.
    """
    index = folder / INDEX
    try:
        names = index.read_text("ascii").split()
        beside = sorted(path.name for path in folder.glob("[bi]-*.png"))
    except (OSError, UnicodeDecodeError) as error:
        raise RecordingError(
            f"{folder} is no fakenect recording, its {INDEX} cannot be read; choose the folder "
            "that holds it."
        ) from error
    files = sorted((_recorded(folder, name) for name in names + beside), key=_time)
    device = _read_device(folder / _DEVICE)
    return Recording(
        tuple(files), device.get("serial"), device.get("model"), _decode_calibration(device)
    )


def _time(file: RecordedFile) -> float:
    return file.host_time_s


def _recorded(folder: Path, name: str) -> RecordedFile:
    match = _NAME.fullmatch(name)
    if match is None or not (folder / name).is_file():
        raise RecordingError(
            f"{folder / INDEX} names {name}, which is no picture in this folder; copy the "
            "recording again, with all its files."
        )
    kind, host_time, device_time, _extension = match.groups()
    return RecordedFile(folder / name, kind, float(host_time), int(device_time))


def read_depth(file: RecordedFile) -> RawArray:
    """Read a depth picture: (480, 640) uint16, raw 11-bit numbers."""
    (width, height), data = _read_netpbm(file.path, b"P5", b"65535")
    return _pixels(file.path, data, "<u2", (height, width)).astype(np.uint16)


def read_color(file: RecordedFile) -> ByteArray:
    """Read a colour picture: (480, 640, 3) uint8, RGB."""
    (width, height), data = _read_netpbm(file.path, b"P6", b"255")
    return _pixels(file.path, data, "u1", (height, width, 3)).copy()


def read_received(file: RecordedFile) -> NDArray[Any]:
    """Read a mosaic (uint8) or infrared picture (uint16) as received."""
    image = cv2.imdecode(np.fromfile(file.path, np.uint8), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise RecordingError(_unreadable(file.path))
    return np.asarray(image)


def read_posture(file: RecordedFile) -> Posture:
    """Read a reading of the accelerometer."""
    data = file.path.read_bytes()
    if len(data) != _POSTURE.size:
        raise RecordingError(_unreadable(file.path))
    x, y, z, tilt, status = _POSTURE.unpack(data)
    acceleration = (x / COUNTS_PER_G, y / COUNTS_PER_G, z / COUNTS_PER_G)
    return Posture(acceleration, None if tilt == -128 else tilt / 2, status == _MOVING)


def _read_netpbm(path: Path, magic: bytes, largest: bytes) -> tuple[tuple[int, int], bytes]:
    """Read a picture whose header is one line, as fakenect requires."""
    header, _newline, data = path.read_bytes().partition(b"\n")
    words = header.split()
    if len(words) != 4 or (words[0], words[3]) != (magic, largest):
        raise RecordingError(_unreadable(path))
    if not (words[1].isdigit() and words[2].isdigit()):
        raise RecordingError(_unreadable(path))
    return (int(words[1]), int(words[2])), data


def _pixels(path: Path, data: bytes, dtype: str, shape: tuple[int, ...]) -> NDArray[Any]:
    if len(data) != math.prod(shape) * np.dtype(dtype).itemsize:
        raise RecordingError(_unreadable(path))
    return np.frombuffer(data, dtype).reshape(shape)


def _unreadable(path: Path) -> str:
    return f"{path} is damaged or no fakenect picture; copy the recording again."


def _encode_calibration(calibration: Calibration) -> dict[str, Any]:
    """Return the calibration with the names that libfreenect's recorder uses."""
    info = calibration.as_dict()["registration"]
    plane = calibration.zero_plane
    return {
        "reg_info": {
            **{name: value for name, value in info.items() if name not in _UNUSED},
            "pad_info": calibration.as_dict()["padding"],
            "zero_plane_info": {
                "dcmos_emitter_distance": plane.emitter_distance_cm,
                "dcmos_rcmos_distance": plane.rgb_distance_cm,
                "reference_distance": plane.reference_distance_cm,
                "reference_pixel_size": plane.reference_pixel_cm,
            },
        },
        "const_shift": calibration.constant_shift,
    }


def _read_device(path: Path) -> dict[str, Any]:
    if not path.is_file():
        return {}
    try:
        if path.stat().st_size > _MOST_JSON_BYTES:
            raise ValueError
        device = json.loads(path.read_text("utf-8"), object_pairs_hook=_without_doubles)
    except (OSError, ValueError, RecursionError) as error:
        raise RecordingError(_unreadable(path)) from error
    named = (device.get("serial"), device.get("model")) if isinstance(device, dict) else (0,)
    if not all(text is None or isinstance(text, str) for text in named):
        raise RecordingError(_unreadable(path))
    return dict(device)


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) < len(pairs):
        raise ValueError
    return values


def _decode_calibration(device: dict[str, Any]) -> Calibration | None:
    if "reg_info" not in device:
        return None
    try:
        info = dict(device["reg_info"])
        padding = Padding(**_numbers(info.pop("pad_info")))
        plane = _numbers(info.pop("zero_plane_info"))
        zero_plane = ZeroPlane(
            plane["dcmos_emitter_distance"],
            plane["dcmos_rcmos_distance"],
            plane["reference_distance"],
            plane["reference_pixel_size"],
        )
        if min(zero_plane.reference_distance_cm, zero_plane.reference_pixel_cm) < _TINY_CM:
            raise ValueError("a distance is not above 0")
        registration = RegistrationInfo(**{**dict.fromkeys(_UNUSED, 0), **_numbers(info)})
        shift = _numbers({"const_shift": device["const_shift"]})["const_shift"]
        return Calibration(zero_plane, registration, padding, round(shift))
    except (KeyError, TypeError, ValueError) as error:
        raise RecordingError(
            f"The calibration in {_DEVICE} is incomplete ({error}); copy the recording again."
        ) from error


def _numbers(values: Any) -> dict[str, Any]:
    """Return an object of JSON whose values are all usual numbers."""
    for key, value in dict(values).items():
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not (is_number and abs(value) <= _GREATEST):
            raise TypeError(f"{key} is no usual number")
    return dict(values)
