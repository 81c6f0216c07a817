"""pedar (novel): two insoles of 99 sensors, a line of text for each moment, ``.asc``.

The file numbers the sensors but does not say where they lie, nor which half of its columns is the
left insole: public readers of the format take opposite halves for it. So it is asked.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.geometry.arrays import IntArray
from insole_core.geometry.side import Side
from insole_core.pressure.export_text import cut_off, numbers_of, stacked
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_UNIT = re.compile(r"pressure values in\s+(\S+)")
_SENSORS = (5, *[7] * 12, 6, 4)
"""In the rows from heel to toes; numbered from medial to lateral."""
_BOUNDS = (0.0, 0.083, 0.162, 0.237, 0.308, 0.377, 0.451, 0.517, 0.582, 0.639, 0.696, 0.755, 0.811,
           0.872, 0.93, 1.0)  # fmt: skip
"""Edges of the rows, as shares of the insole's length."""
_MEDIAL = (0.19, 0.216, 0.234, 0.238, 0.242, 0.246, 0.251, 0.255, 0.281, 0.297, 0.312, 0.322, 0.322,
           0.313, 0.294)  # fmt: skip
_LATERAL = (0.033, 0.013, 0.004, 0.002, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.009, 0.022, 0.05,
            0.089)  # fmt: skip
"""Edges of each row, as shares of the length, from the most lateral point of the insole."""
_ROWS, _COLUMNS = 54, 18
_EACH = sum(_SENSORS)
_MOST_MOMENTS = 30_000


def is_pedar(text: str) -> bool:
    """Return whether a text is an export of pedar."""
    head = text[:4000]
    return "mask definition" in head and "sensor type" in head


def read_pedar(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read both insoles; the places of the sensors are shares of the insole's length.

    Raises
    ------
    InputError
        When the file is cut off, or has other sensors than an insole of 99.
    """
    lines = text.splitlines()
    start = next((n for n, line in enumerate(lines) if line.startswith("time[secs]")), None)
    unit = _UNIT.search(text[:4000])
    if start is None:
        raise cut_off(path)
    moments = []
    for number, line in enumerate(lines[start + 1 :], start + 1):
        cells = line.split()
        if not cells:
            continue
        if len(cells) != 1 + 2 * _EACH:
            raise cut_off(path)
        numbers = numbers_of(path, number, cells)[1:]
        moments.append((numbers[:_EACH], numbers[_EACH:]))
        if len(moments) > _MOST_MOMENTS:
            raise InputError(
                "{path} is longer than five minutes; export a part of the walk.", path=path
            )
    sensors = stacked(path, moments)
    cells_of = _cells()
    return tuple(
        PressureRecording(
            "pedar",
            name,
            _on_grid(sensors[:, half], cells_of),
            unit=None if unit is None else PressureUnit.written(unit[1]),
            seen_from=SeenFrom.ABOVE,
            drawn_as=Side.LEFT,
            is_insole=True,
        )
        for half, name in enumerate(("columns 1-99", "columns 100-198"))
    )


def _on_grid(sensors: npt.NDArray[np.float32], cells: IntArray) -> npt.NDArray[np.float32]:
    beside = np.full((len(sensors), 1), np.nan, dtype=np.float32)
    return np.concatenate([sensors, beside], axis=1)[:, cells]


def _cells() -> IntArray:
    """(rows, columns) number of the sensor at each cell of the grid, of a left insole from above.

    Cells beside the insole have the number after the last sensor.
    """
    along = (_ROWS - 0.5 - np.arange(_ROWS)) / _ROWS
    across = (np.arange(_COLUMNS) + 0.5) / _ROWS  # from the lateral edge, at the left
    row = np.searchsorted(_BOUNDS, along) - 1
    firsts = np.concatenate([[0], np.cumsum(_SENSORS)[:-1]])
    medial, lateral = np.array(_MEDIAL)[row], np.array(_LATERAL)[row]
    count = np.array(_SENSORS)[row]
    share = (medial[:, None] - across) / (medial - lateral)[:, None]
    place = np.floor(share * count[:, None]).astype(int)
    inside = (place >= 0) & (place < count[:, None])
    return np.where(inside, firsts[row][:, None] + place, _EACH)
