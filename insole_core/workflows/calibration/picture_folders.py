"""Folders for the pictures that a calibration step takes with live sensors."""

from __future__ import annotations

import json
import re
from datetime import date
from pathlib import Path
from typing import Literal

import numpy as np

from insole_core.calibration.infrared.infrared_walls import MEAN_SCALE
from insole_core.errors import CalibrationError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.files.transaction import Transaction
from insole_core.geometry.arrays import ByteArray
from insole_core.recording.images import encode_png
from insole_core.recording.sensor_folder import INFRARED_SHIFT, SENSOR_FILE, sensor_json
from insole_core.recording.session import View

LiveKind = Literal["boards", "walls", "infrared", "dots"]


def folder_of_today(root: Path, serial: str, step: str) -> Path:
    """Return the folder for the pictures of one sensor, today, and one step.

    Parameters
    ----------
    serial
        Of the sensor.
    step
        Name of the folder below the date.
    """
    return root / serial / date.today().isoformat() / step


def keep_view(view: View, folder: Path, kind: LiveKind) -> None:
    """Save a capture: one position of the board, or a wall.

    For a board, the first depth frame is saved beside the colour picture as ``depth_003.png``, and
    all depth frames in ``depth_003``; a wall is a folder of its frames with the serial number; a
    wall of dots is ``infrared_03.png``, the mean of its pictures, and ``depth_03.png``.

    Parameters
    ----------
    folder
        As `folder_of_today`.

    Raises
    ------
    CalibrationError
        When infrared pictures are wanted, but were not taken.
    OutputError
        When the place cannot be written.
    """
    with Transaction() as outputs:
        if kind == "dots":
            _keep_dots(view, folder, outputs)
            return
        if kind == "walls":
            number = _next_number(folder, "wall_")
            _write_depth(view, folder / f"wall_{number:03d}", outputs)
            return
        number = _next_number(folder, "color_")
        _write_depth(view, folder / f"depth_{number:03d}", outputs)
        _write(folder / f"depth_{number:03d}.png", encode_png(view.read_depth(0)), outputs)
        _write(folder / f"color_{number:03d}.png", encode_png(view.read_color(0)), outputs)


def keep_infrared(picture: ByteArray, folder: Path) -> None:
    """Save an infrared picture of the board.

    Parameters
    ----------
    picture : (height, width) uint8
    folder
        As `folder_of_today`.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    with Transaction() as outputs:
        number = _next_number(folder, "ir_")
        _write(folder / f"ir_{number:03d}.png", encode_png(picture), outputs)


def _keep_dots(view: View, folder: Path, outputs: Transaction) -> None:
    dots = view.dots
    if dots is None or dots.pictures is None:
        raise CalibrationError(
            "The wall was not kept, because sensor or wall moved, or its infrared pictures are "
            "black or saturated; hold the sensor still with its emitter uncovered, and take it "
            "again."
        )
    mean = dots.pictures.mean()
    number = _next_number(folder, "infrared_")
    picture = np.rint(MEAN_SCALE * mean).astype(np.uint16)
    _write(folder / f"infrared_{number:02d}.png", encode_png(picture), outputs)
    _write(folder / f"depth_{number:02d}.png", encode_png(view.read_depth(0)), outputs)
    known = {"serial": view.sensor.serial, INFRARED_SHIFT: dots.shift_px}
    _write(folder / SENSOR_FILE, json.dumps(known).encode(), outputs)


def _write_depth(view: View, folder: Path, outputs: Transaction) -> None:
    for index in range(view.depth_count):
        _write(folder / f"depth_{index:03d}.png", encode_png(view.read_depth(index)), outputs)
    sensor = view.sensor
    told = {"serial": sensor.serial} if sensor.depth_unit_mm is None else sensor_json(sensor, None)
    _write(folder / SENSOR_FILE, json.dumps(told).encode(), outputs)


def _write(path: Path, content: bytes, outputs: Transaction) -> None:
    make_output_folder(path.parent)
    with replacing_file(outputs.file(path)) as beside:
        beside.write_bytes(content)


def _next_number(folder: Path, prefix: str) -> int:
    names = folder.glob(f"{prefix}*") if folder.is_dir() else ()
    matches = (re.fullmatch(rf"{prefix}(\d+)", path.stem) for path in names)
    return max((int(match[1]) for match in matches if match), default=-1) + 1
