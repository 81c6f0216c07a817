"""Infrared pictures of flat walls, each with a raw depth frame of the same wall."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.walls.captures import WallCapture, capture_from_frames, read_depth
from insole_core.errors import CalibrationError, InputError
from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.json_object import JsonObject
from insole_core.progress import SILENT, Progress
from insole_core.recording.images import read_picture
from insole_core.recording.sensor_folder import SENSOR_FILE, infrared_shift_px
from insole_core.regular_file import is_folder
from insole_core.sensing.infrared_reference import GREATEST, on_depth_pixels

_NAME = re.compile(r"infrared_(\d{2,4})\.png")
_SHAPE = (480, 640)
MEAN_SCALE = 64
"""A mean of pictures is stored as 64 times the number of the sensor, which has 10 bits."""
_SATURATED_SHARE = 0.01
_LEAST_LIGHT = 4.0
"""Mean number above the black level; a wall at 1 m shows 25."""
_LOCAL_PX = 16.0
_MOST_GAIN = 50.0


@dataclass(frozen=True, eq=False)
class InfraredWall:
    """One flat wall as the infrared camera saw it.

    Parameters
    ----------
    depth
        The raw depth frame of the same wall.
    brightness : (480, 640) float32
        Relative to the mean nearby: 1 on average.
    shift_px
        That the picture had against the depth (see `DotPictures`).
    """

    depth: WallCapture
    brightness: Float32Array
    shift_px: tuple[float, float] = (0.0, 0.0)


def read_infrared_walls(
    folder: Path,
    serial: str = "",
    progress: Progress = SILENT,
    *,
    shift_px: tuple[float, float] = (0.0, 0.0),
    most: int | None = None,
) -> list[InfraredWall]:
    """Read ``infrared_00.png …`` and ``depth_00.png …`` of a folder.

    Parameters
    ----------
    serial
        Of the device whose walls are expected; a ``sensor.json`` beside the pictures names theirs.
    progress
    shift_px
        As of `DotPictures`; where a ``sensor.json`` beside the pictures says it, that counts.
    most
        Number of walls to read; None for all.

    Returns
    -------
    list of InfraredWall
        In the order of their numbers, at least one.

    Raises
    ------
    InputError
        If the folder or a picture cannot be read, or a picture is of another size.
    CalibrationError
        If a picture is saturated or dark, or the walls are of another device.
    """
    names = infrared_wall_names(folder, serial)[:most]
    walls = []
    for done, name in enumerate(names):
        progress.step(done / len(names), "Reading {file}", file=name)
        walls.append(read_infrared_wall(folder, name, shift_px=shift_px))
    return walls


def infrared_wall_names(folder: Path, serial: str = "") -> list[str]:
    """List the infrared pictures of a folder of walls, in the order of their numbers.

    Parameters
    ----------
    serial
        As of `read_infrared_walls`.

    Raises
    ------
    InputError
        If there is none.
    CalibrationError
        If the walls are of another device.
    """
    if not is_folder(folder):
        raise InputError(
            "There is no folder {folder}; name the folder with the infrared pictures of walls.",
            folder=folder,
        )
    _check_device(folder, serial)
    matches = filter(None, map(_NAME.fullmatch, (path.name for path in folder.iterdir())))
    names = [match[0] for match in sorted(matches, key=lambda match: int(match[1]))]
    if not names:
        raise InputError(
            "{folder} holds no infrared_00.png; name the folder with the infrared pictures of "
            "walls.",
            folder=folder,
        )
    return names


def read_infrared_wall(
    folder: Path, name: str, *, shift_px: tuple[float, float] = (0.0, 0.0)
) -> InfraredWall:
    """Read one wall.

    Parameters
    ----------
    name
        Of the infrared picture.
    shift_px
        As of `read_infrared_walls`.

    Raises
    ------
    InputError, CalibrationError
        As of `read_infrared_walls`.
    """
    beside = folder / SENSOR_FILE
    own_px = infrared_shift_px(JsonObject.read(beside)) if beside.exists() else None
    return _read_wall(folder, name, name.replace("infrared", "depth"), own_px or shift_px)


def relative_brightness(picture: FloatArray) -> Float32Array:
    """Return a picture (480, 640) without its black level, relative to the mean nearby."""
    lit = np.clip(picture - np.percentile(picture, 1), 0, None).astype(np.float32)
    mean = cv2.GaussianBlur(lit, (0, 0), _LOCAL_PX)
    return np.asarray(np.minimum(lit / np.maximum(mean, 1e-3), _MOST_GAIN), np.float32)


def _check_device(folder: Path, serial: str) -> None:
    beside = folder / SENSOR_FILE
    found = JsonObject.read(beside).text("serial") if serial and beside.exists() else serial
    if found != serial:
        raise CalibrationError(
            "The walls of {folder} were recorded with sensor {found}, but the calibration is of "
            "sensor {serial}; name the walls of that sensor.",
            folder=folder,
            found=found,
            serial=serial,
        )


def _read_wall(
    folder: Path, infrared: str, depth: str, shift_px: tuple[float, float]
) -> InfraredWall:
    path = folder / infrared
    picture = read_infrared_picture(path)
    if not (folder / depth).exists():
        raise InputError(
            "{depth} is missing beside {infrared} in {folder}; a wall needs both, so restore it or "
            "take the picture out.",
            depth=depth,
            infrared=infrared,
            folder=folder,
        )
    if (picture >= GREATEST).mean() > _SATURATED_SHARE:
        raise CalibrationError(
            "{path} is saturated: its dots are as bright as the sensor can tell; lower the "
            "infrared brightness or step back, and capture the wall again.",
            path=path,
        )
    if picture.mean() - np.percentile(picture, 1) < _LEAST_LIGHT:
        raise CalibrationError(
            "{path} is almost dark; uncover the emitter and capture the wall again.", path=path
        )
    capture = capture_from_frames(infrared, [read_depth(folder / depth)])
    return InfraredWall(capture, relative_brightness(on_depth_pixels(picture, shift_px)), shift_px)


def read_infrared_picture(path: Path) -> FloatArray:
    """Read an infrared picture (480, 640) float64 of 10 bits, or of 64 times their mean.

    Raises
    ------
    InputError
    """
    image = read_picture(path, cv2.IMREAD_UNCHANGED)
    if image is None:
        raise InputError(
            "{path} is no readable image; restore it or take it out of the folder.", path=path
        )
    if image.dtype != np.uint16 or image.shape != _SHAPE:
        raise InputError(
            "{path} is no infrared picture of 640×480 with 16 bits of grey; record it as the "
            "sensor sends it beside the depth.",
            path=path,
        )
    return np.asarray(image / (MEAN_SCALE if image.max() > GREATEST else 1), np.float64)
