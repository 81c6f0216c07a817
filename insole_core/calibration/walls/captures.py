"""Captures of flat walls, from which the distortion of a depth sensor is measured."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from insole_core.errors import CalibrationError, InputError
from insole_core.geometry.arrays import FloatArray, RawArray
from insole_core.json_object import JsonObject
from insole_core.progress import SILENT, Progress
from insole_core.recording.images import read_picture
from insole_core.recording.sensor_folder import SENSOR_FILE, parse_sensor
from insole_core.regular_file import is_folder
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.frames import mean_raw
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import Sensor

_SHAPE = (480, 640)
_MOST_STORED = 65535
_AT_ONCE = 2
"""Captures read in parallel: decoding and averaging mostly release the interpreter lock."""


@dataclass(frozen=True, eq=False)
class WallCapture:
    """One flat wall or board, seen from one distance.

    Parameters
    ----------
    name
        For messages: the file or folder it was read from.
    raw : (height, width) float64, raw units, NaN = no reading
        Mean over the frames; of a sensor that delivers millimetres, on the lattice of its readings.
    distance_mm
        Measured at the image centre along the optical axis, where it is known.
    plane : (3,) float64, 1/mm, optional
        The true plane in the depth camera frame, where it is known: 1/Z = plane · (x, y, 1) with
        normalised image coordinates.
    serial
        Of the device, where it is known.
    sensor
        That recorded it, where it delivers millimetres.
    """

    name: str
    raw: FloatArray
    distance_mm: float | None = None
    plane: FloatArray | None = None
    serial: str = ""
    sensor: Sensor | None = None


def capture_from_frames(
    name: str,
    frames: Iterable[RawArray],
    distance_mm: float | None = None,
    plane: FloatArray | None = None,
    serial: str = "",
    *,
    sensor: Sensor | None = None,
) -> WallCapture:
    """Average frames one by one; only a few are in memory at a time (thesis 5.2, k frames).

    Parameters
    ----------
    frames : each (height, width) uint16, as the sensor stores them
        Of a Kinect (480, 640), raw units; a Kinect's, if no sensor is given.
    distance_mm, plane, serial, sensor
        As in `WallCapture`.

    Raises
    ------
    CalibrationError
        If there are no frames, or they hold no readings.
    InputError
        If a frame has another size.
    """
    try:
        first, frames = _peek(frames)
    except StopIteration:
        raise CalibrationError(
            "{name} holds no depth frames; capture it again.", name=name
        ) from None
    shape = _SHAPE if sensor is None else _shape(sensor)
    if first.shape != shape:
        height, width = first.shape[:2]
        raise InputError(
            "{capture} is {width}×{height}, but a depth frame of this sensor must be "
            "{wanted_width}×{wanted_height}.",
            capture=name,
            width=width,
            height=height,
            wanted_width=shape[1],
            wanted_height=shape[0],
        )
    if sensor is None:
        raw = mean_raw(frames)
    else:
        readings = Readings.of(sensor)
        raw = mean_raw(map(readings.numbers, frames), readings.per_raw)
    return _with_readings(WallCapture(name, raw, distance_mm, plane, serial, sensor))


def capture_from_glance(name: str, raw: RawArray) -> WallCapture:
    """Take one live picture, in raw units on the lattice of any sensor (see `Readings.glance`).

    Parameters
    ----------
    name
    raw : (rows, columns) uint16, raw units, 2047 = no reading

    Raises
    ------
    CalibrationError
        If it holds no readings.
    """
    return _with_readings(WallCapture(name, np.where(raw < NO_READING, raw, np.nan)))


def _with_readings(capture: WallCapture) -> WallCapture:
    if not np.isfinite(capture.raw).any():
        raise CalibrationError(
            "{name} holds no reading at all; move the sensor 500 to 3000 mm from the wall and "
            "capture it again.",
            name=capture.name,
        )
    return capture


def _shape(sensor: Sensor) -> tuple[int, int]:
    return sensor.depth_camera.height, sensor.depth_camera.width


def read_captures(folder: Path, progress: Progress = SILENT) -> list[WallCapture]:
    """Read the wall captures of a folder of 16-bit PNG images, as the sensor delivers them.

    Every sub-folder is one capture and its images are the frames; in a folder without sub-folders
    every image is a capture of one frame. Colour pictures ``color…`` in a sub-folder are skipped. A
    ``sensor.json`` beside the images names the device, and says what one that delivers millimetres
    is like.

    Returns
    -------
    list of WallCapture
        In the order of their names.

    Raises
    ------
    InputError
        If the folder or an image cannot be read.
    """
    groups = _groups(folder)
    captures = []
    pool = ThreadPoolExecutor(_AT_ONCE)
    try:
        reading = [pool.submit(_read_capture, name, paths) for name, paths in groups]
        for done, (name, _) in enumerate(groups):
            progress.step(done / len(groups), "Reading {file}", file=name)
            captures.append(reading[done].result())
    finally:
        pool.shutdown(cancel_futures=True)
    return captures


def _read_capture(name: str, paths: Sequence[Path]) -> WallCapture:
    path = paths[0].with_name(SENSOR_FILE)
    root = JsonObject.read(path) if path.exists() else None
    if root is not None and root.has("depth_unit_mm"):
        sensor = parse_sensor(root, None)
        frames = (read_depth(path, most=_MOST_STORED) for path in paths)
        return capture_from_frames(name, frames, serial=sensor.serial, sensor=sensor)
    serial = "" if root is None else root.text("serial")
    return capture_from_frames(name, read_frames(paths), serial=serial)


def read_frames(paths: Iterable[Path]) -> Iterator[RawArray]:
    """Decode depth images lazily, one after the other."""
    return map(read_depth, paths)


def read_depth(path: Path, most: int = NO_READING) -> RawArray:
    """Read one depth image, (height, width) uint16.

    Parameters
    ----------
    path
    most
        The largest number that it can hold; of a Kinect 2047.

    Raises
    ------
    InputError
        If it cannot be read or is not 16-bit.
    """
    image = read_picture(path, cv2.IMREAD_UNCHANGED)
    if image is None:
        raise InputError(
            "{path} is no readable image; restore it or take it out of the folder.", path=path
        )
    if image.dtype != np.uint16 or image.ndim != 2 or image.max() > most:
        raise InputError(
            "{path} is no raw depth image (16-bit grey, numbers up to 2047); record the raw "
            "numbers of the sensor.",
            path=path,
        )
    return np.asarray(image)


def check_same_device(captures: Iterable[WallCapture]) -> None:
    """Check that all captures are of one device.

    Raises
    ------
    CalibrationError
        If they are of more than one.
    """
    by_serial = {capture.serial: capture.name for capture in captures if capture.serial}
    if len(by_serial) > 1:
        named = ", ".join(f"{name} ({serial})" for serial, name in by_serial.items())
        raise CalibrationError(
            "The captures come from different sensors: {sensors}; calibrate one sensor at a time.",
            sensors=named,
        )


def _groups(folder: Path) -> list[tuple[str, list[Path]]]:
    if not is_folder(folder):
        raise InputError(
            "There is no folder {folder}; name the folder with the wall captures.", folder=folder
        )
    below = [
        (sub.name, [path for path in sorted(sub.glob("*.png")) if not _is_color(path)])
        for sub in sorted(folder.iterdir())
        if sub.is_dir()
    ]
    groups = [(name, paths) for name, paths in below if paths]
    if not groups:
        _check_no_boards(folder)
        groups = [(path.name, [path]) for path in sorted(folder.glob("*.png"))]
    if not groups:
        raise InputError(
            "{folder} holds no PNG images; name the folder with the wall captures.", folder=folder
        )
    return groups


def _check_no_boards(folder: Path) -> None:
    paths = sorted(folder.iterdir())
    picture = next(filter(_is_color, paths), None)
    if picture is not None and any(path.name.startswith("depth") for path in paths):
        raise InputError(
            "{folder} holds colour pictures ({picture}) beside the depth images, as of a board for "
            "depth to colour; name the folder with the captures of flat, empty walls.",
            folder=folder,
            picture=picture.name,
        )


def _is_color(path: Path) -> bool:
    return path.name.startswith("color")


def _peek(frames: Iterable[RawArray]) -> tuple[RawArray, Iterator[RawArray]]:
    stream = iter(frames)
    first = next(stream)
    return first, itertools.chain([first], stream)
