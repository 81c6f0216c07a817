"""The pictures that a calibration step collects from live sensors, in the folders steps read."""

from __future__ import annotations

import json
import re
from datetime import date
from pathlib import Path
from typing import Literal

from insole_core.errors import OutputError
from insole_core.export.atomic import describe, replacing_file
from insole_core.geometry.arrays import ByteArray
from insole_core.recording.images import encode_png
from insole_core.recording.session import View

LiveKind = Literal["boards", "walls", "infrared"]


def folder_of_today(root: Path, serial: str, step: str) -> Path:
    """Name the folder of one sensor, one day and one step."""
    return root / serial / date.today().isoformat() / step


def keep_view(view: View, folder: Path, kind: LiveKind) -> None:
    """Add what was captured: a position of the board, or a wall.

    Of a board the first depth frame stands beside the colour picture, as ``depth_003.png``, and all
    of them in ``depth_003``; a wall is a folder of its frames with the serial number beside them.

    Raises
    ------
    OutputError
    """
    if kind == "walls":
        number = _next_number(folder, "wall_")
        _write_depth(view, folder / f"wall_{number:03d}")
        return
    number = _next_number(folder, "color_")
    _write_depth(view, folder / f"depth_{number:03d}")
    _write(folder / f"depth_{number:03d}.png", encode_png(view.read_depth(0)))
    _write(folder / f"color_{number:03d}.png", encode_png(view.read_color(0)))


def keep_infrared(picture: ByteArray, folder: Path) -> None:
    """Add an infrared picture (height, width) uint8 of the board.

    Raises
    ------
    OutputError
    """
    _write(folder / f"ir_{_next_number(folder, 'ir_'):03d}.png", encode_png(picture))


def _write_depth(view: View, folder: Path) -> None:
    for index in range(view.depth_count):
        _write(folder / f"depth_{index:03d}.png", encode_png(view.read_depth(index)))
    _write(folder / "sensor.json", json.dumps({"serial": view.sensor.serial}).encode())


def _write(path: Path, content: bytes) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(describe(path.parent, error)) from error
    with replacing_file(path) as beside:
        beside.write_bytes(content)


def _next_number(folder: Path, prefix: str) -> int:
    names = folder.glob(f"{prefix}*") if folder.is_dir() else ()
    found = (re.fullmatch(rf"{prefix}(\d+)", path.stem) for path in names)
    return max((int(match[1]) for match in found if match), default=-1) + 1
