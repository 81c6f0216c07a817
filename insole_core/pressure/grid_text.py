"""A table of pressures as text: the form to which every program can be brought.

Lines of numbers are rows of sensors, from the toes to the heel; what stands between two blocks of
them separates frames. Lines before may state ``unit``, ``pitch_mm``, ``side`` and ``seen_from``
(docs/formats/pressure.md).
"""

from __future__ import annotations

import math
import re
from enum import StrEnum
from pathlib import Path
from typing import TypeVar

from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.pressure.export_text import number_of, stacked
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_Word = TypeVar("_Word", bound=StrEnum)
_LEAST_ROWS, _LEAST_COLUMNS = 6, 3
_KEY = re.compile(r'^\W*(unit|pitch_mm|side|seen_from)["\s]*[:;,=\t]["\s]*([^"]*?)[";,\s]*$', re.I)
_UNIT = re.compile(r"(?<![\w/])(kpa|n/cm(?:2|²|\^2)|mmhg|psi)(?![\w/])", re.I)


def read_grid(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read a table, with tabs, semicolons, commas or spaces between its numbers.

    Raises
    ------
    InputError
        When there is no table of pressures, or its rows differ in length.
    """
    lines = text.splitlines()
    separator = _separator(lines)
    comma = separator != "," and any("," in line for line in lines)
    blocks: list[list[list[float]]] = [[]]
    said: dict[str, str] = {}
    for line in lines:
        numbers = _row(line, separator, comma)
        if numbers is not None:
            blocks[-1].append(numbers)
            continue
        _note(line, said)
        if blocks[-1]:
            blocks.append([])
    frames = [block for block in blocks if len(block) >= _LEAST_ROWS]
    if not frames:
        raise InputError(
            "{path} holds no table of pressures: at least {rows} rows of {columns} numbers; choose "
            "the export of a pressure plate.",
            path=path,
            rows=_LEAST_ROWS,
            columns=_LEAST_COLUMNS,
        )
    if any(len({len(row) for row in frame}) > 1 for frame in frames):
        raise InputError(
            "{path}: the rows of the table differ in length; export it again.", path=path
        )
    return (
        PressureRecording(
            "",
            "",
            stacked(path, frames),
            _pitch(path, said.get("pitch_mm", "")),
            PressureUnit.written(said.get("unit", "")),
            _choice(Side, said.get("side", "")),
            _choice(SeenFrom, said.get("seen_from", "")),
        ),
    )


def _separator(lines: list[str]) -> str | None:
    """Return what separates the numbers; None for spaces."""
    for separator in ("\t", ";"):
        if sum(line.count(separator) >= _LEAST_COLUMNS - 1 for line in lines) >= _LEAST_ROWS:
            return separator
    # A comma in a table with spaces is that of the decimals.
    plain = sum(_row(line, ",", False) is not None for line in lines)
    spaced = sum(_row(line, None, True) is not None for line in lines)
    return "," if plain >= spaced and plain else None


def _row(line: str, separator: str | None, comma: bool) -> list[float] | None:
    """Return the numbers of a line; None when it is none of sensors."""
    cells = line.split(separator)
    if len(cells) > 1 and not cells[-1].strip():
        cells = cells[:-1]  # many programs end each line with a separator
    if len(cells) < _LEAST_COLUMNS:
        return None
    numbers = [number_of(cell, comma=comma) for cell in cells]
    row = [number for number in numbers if number is not None]
    if len(row) < len(numbers) or all(math.isnan(number) for number in row):
        return None
    return row


def _note(line: str, said: dict[str, str]) -> None:
    """Take what a line says of the numbers."""
    found = _KEY.match(line)
    if found is not None:
        said.setdefault(found[1].lower(), found[2])
        return
    unit = _UNIT.search(line)
    if unit is not None:
        said.setdefault("unit", unit[1])


def _pitch(path: Path, text: str) -> tuple[float, float] | None:
    if not text:
        return None
    parts = [number_of(part, comma=True) for part in re.split(r"\s*[x×]\s*", text)]
    known = [part for part in parts if part is not None and part > 0]
    if len(known) != len(parts) or len(known) > 2:
        raise InputError(
            '{path}: "{text}" is no distance of sensors; write such as 5 or 5 x 7.', path=path,
            text=text[:20],
        )  # fmt: skip
    return known[0], known[-1]


def _choice(words: type[_Word], text: str) -> _Word | None:
    return next((word for word in words if word.value == text.strip().lower()), None)
