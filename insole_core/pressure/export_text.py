"""Reads the text of an export of a pressure plate: bounded, line by line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.foreign_files import check_no_pointer
from insole_core.given_file import read_given

MOST_BYTES = 64 * 2**20
"""Five minutes of two insoles with 99 sensors each, a hundred times a second."""
MOST_SENSORS = 512
"""In a row or a column; a plate of 2 m has 400."""
MOST_VALUES = 40_000_000
_MOST_PRESSURE = 1e9
"""In whatever unit: numbers beyond are damaged."""
_NO_SENSOR = {"", "b", "nan", "-", "n/a"}
_BINARY = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0", b"%PDF")


def read_text(path: Path) -> str:
    """Return the text of an export.

    Raises
    ------
    InputError
        When it is no text, or cannot be read.
    """
    content = read_given(path, MOST_BYTES)
    check_no_pointer(path, content)
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    else:
        if content.startswith(_BINARY) or b"\0" in content:
            raise InputError(
                "{path} is no text; export the pressure map as text, or save the table as CSV.",
                path=path,
            )
        encoding = "utf-8-sig" if _is_utf8(content) else "latin-1"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        raise InputError("{path} is no readable text; export it again.", path=path) from error


def _is_utf8(content: bytes) -> bool:
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def number_of(cell: str, *, comma: bool = False) -> float | None:
    """Return a number in a cell, NaN for a place without a sensor; None for anything else.

    Parameters
    ----------
    comma
        Whether decimals are written with a comma.
    """
    text = cell.strip()
    if text.lower() in _NO_SENSOR:
        return math.nan
    if "_" in text:
        return None
    try:
        value = float(text.replace(",", ".") if comma else text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def numbers_of(path: Path, line: int, cells: Sequence[str]) -> list[float]:
    """Return the numbers of a line of sensors.

    Parameters
    ----------
    line
        Number of the line, counted from 0, for the message.

    Raises
    ------
    InputError
        When a cell holds anything but a pressure.
    """
    numbers = [number_of(cell) for cell in cells]
    known = [number for number in numbers if number is not None]
    if len(known) < len(numbers):
        wrong = cells[numbers.index(None)].strip()[:20]
        raise InputError(
            '{path}: line {line} holds "{text}" in place of a pressure; export it again.',
            path=path,
            line=line + 1,
            text=wrong,
        )
    return known


def stacked(path: Path, frames: Sequence[npt.ArrayLike]) -> npt.NDArray[np.float32]:
    """Return frames as one array (frames, rows, columns).

    Raises
    ------
    InputError
        When there is none, they have different sizes, are too many, or hold what is no pressure.
    """
    with np.errstate(over="ignore"):  # infinite then, which is refused below
        arrays = [np.asarray(frame, dtype=np.float32) for frame in frames]
    if not arrays or any(array.ndim != 2 for array in arrays):
        raise InputError("{path} holds no frame of pressures; export it again.", path=path)
    shapes = {array.shape for array in arrays}
    rows, columns = next(iter(shapes))
    if len(shapes) > 1:
        raise InputError(
            "{path}: the frames differ in the number of their rows or columns; export it again.",
            path=path,
        )
    if max(rows, columns) > MOST_SENSORS or len(arrays) * rows * columns > MOST_VALUES:
        raise InputError(
            "{path} holds more sensors or frames than a plate has; export one step only.",
            path=path,
        )
    values = np.stack(arrays)
    if not np.isfinite(values).any():
        raise InputError("{path} holds no sensor; export it again.", path=path)
    if float(np.nanmin(values)) < 0:
        raise InputError("{path} holds pressures below 0; export it again, calibrated.", path=path)
    if float(np.nanmax(values)) > _MOST_PRESSURE:
        raise InputError(
            "{path} holds pressures that no device measures; export it again.", path=path
        )
    return values


def cut_off(path: Path) -> InputError:
    """Return the error for a file that ends too early."""
    return InputError("{path} is cut off; export it again.", path=path)
