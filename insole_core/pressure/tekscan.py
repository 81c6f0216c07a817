"""F-Scan and other Tekscan sensors: a header of keys and frames of cells, ``.asf``."""

from __future__ import annotations

import re
from pathlib import Path

from insole_core.errors import InputError
from insole_core.pressure.export_text import cut_off, numbers_of, stacked
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_MM = {"mm": 1.0, "cm": 10.0, "centimeters": 10.0, "millimeters": 1.0, "in": 25.4, "inches": 25.4}
_SPACING = re.compile(r"([\d.]+)\s*(\w+)")
_DATA = "ASCII_DATA"


def is_tekscan(text: str) -> bool:
    """Return whether a text is an export of a Tekscan program."""
    return text.startswith("DATA_TYPE") and "Tekscan" in text[:2000]


def read_tekscan(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read all frames; cells beside the sensor (``B``) are NaN.

    The file does not say which foot it is. The rows run from the toes to the heel, and the sensor
    is seen from above; where the program mirrored one of the two, it says so.

    Raises
    ------
    InputError
        When the file is cut off or not calibrated.
    """
    lines = text.splitlines()
    start = next((n for n, line in enumerate(lines) if line.startswith(_DATA)), None)
    if start is None:
        raise cut_off(path)
    keys = dict(line.partition(" ")[::2] for line in lines[:start] if " " in line)
    try:
        rows, columns = int(keys["ROWS"]), int(keys["COLS"])
        pitch_mm = _spacing(keys["COL_SPACING"]), _spacing(keys["ROW_SPACING"])
        stated = int(keys["END_FRAME"]) - int(keys["START_FRAME"]) + 1
    except (KeyError, ValueError) as error:
        raise cut_off(path) from error
    unit = PressureUnit.written(keys.get("UNITS", ""))
    if unit is None:
        raise InputError(
            '{path}: the unit "{unit}" is none of pressure; calibrate the recording and export it '
            "in kPa.",
            path=path,
            unit=keys.get("UNITS", "").strip()[:20],
        )
    frames = []
    for number, line in enumerate(lines):
        if number <= start or not line.startswith("Frame"):
            continue
        block = [cells.split(",") for cells in lines[number + 1 : number + 1 + rows]]
        if len(block) < rows or any(len(cells) != columns for cells in block):
            raise cut_off(path)
        frames.append([numbers_of(path, number + 1 + n, cells) for n, cells in enumerate(block)])
    if len(frames) < stated:
        raise cut_off(path)
    mirrored = keys.get("MIRROR_ROW", "0").strip() != keys.get("MIRROR_COL", "0").strip()
    seen_from = SeenFrom.BELOW if mirrored else SeenFrom.ABOVE
    values = stacked(path, frames)
    return (PressureRecording("F-Scan", "", values, pitch_mm, unit, seen_from=seen_from),)


def _spacing(text: str) -> float:
    found = _SPACING.match(text.strip())
    if found is None or found[2].lower() not in _MM:
        raise ValueError(text)
    return float(found[1]) * _MM[found[2].lower()]
