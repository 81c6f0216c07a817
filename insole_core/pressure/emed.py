"""emed (novel): one page of text for each frame, ``.lst``."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.pressure.export_text import MOST_SENSORS, cut_off, number_of, stacked
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_MATRIX = re.compile(r"Matrix:\s*(\d+)\s*x\s*(\d+)")
_SIZE = re.compile(r"Sensor size:\s*([\d.]+)\s*x\s*([\d.]+)\s*(cm|mm)")
_PICTURE = re.compile(r"Pict-No\.:\s*(\d+)")
_FORCE = "Force"
_SUM_N, _SUM_SHARE = 1.0, 0.02  # rounding of the sum that a page states


def is_emed(text: str) -> bool:
    """Return whether a text is an export of emed."""
    head = text[:4000]
    return "Sensor size:" in head and _MATRIX.search(head) is not None


def read_emed(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read the frames of a step; the pages of summaries (MVP, MPP) are left out.

    The rows run from the toes to the heel, and the plate is seen from above. Each page states the
    force on all sensors, so that unit and completeness can be checked.

    Raises
    ------
    InputError
        When the file is cut off or damaged.
    """
    matrix, size = _MATRIX.search(text), _SIZE.search(text)
    if matrix is None or size is None:
        raise cut_off(path)
    columns, rows = int(matrix[1]), int(matrix[2])
    if not (0 < columns <= MOST_SENSORS and 0 < rows <= MOST_SENSORS):
        raise cut_off(path)
    mm = 10.0 if size[3] == "cm" else 1.0
    pitch_mm = float(size[1]) * mm, float(size[2]) * mm
    frames: dict[str, FloatArray] = {}
    for page in text.split("\f"):
        picture = _PICTURE.search(page)
        if picture is None:
            continue
        frame = frames.setdefault(picture[1], np.zeros((rows, columns)))
        _read_page(path, page, frame, pitch_mm[0] * pitch_mm[1])
    values = stacked(path, list(frames.values()))
    on = np.flatnonzero(values.max(axis=0).any(axis=0))
    along = np.flatnonzero(values.max(axis=0).any(axis=1))
    if not len(on):
        raise InputError("{path} holds no pressure above 0; export it again.", path=path)
    values = values[:, along[0] : along[-1] + 1, on[0] : on[-1] + 1]
    return (
        PressureRecording("emed", "", values, pitch_mm, PressureUnit.KPA, seen_from=SeenFrom.ABOVE),
    )


def _read_page(path: Path, page: str, frame: FloatArray, sensor_mm2: float) -> None:
    """Enter the sensors of one page into its frame."""
    lines = [line.split("\t") for line in page.splitlines() if line.strip()]
    first = next((n for n, cells in enumerate(lines) if _is_heading(cells)), None)
    if first is None:
        raise cut_off(path)
    has_force = lines[first][-1].strip() == _FORCE
    heading = [cell.strip() for cell in lines[first] if cell.strip() not in ("", _FORCE)]
    if not all(cell.isdigit() for cell in heading):
        raise cut_off(path)
    columns = np.array([int(cell) - 1 for cell in heading])
    total_n, stated_n = 0.0, None
    for cells in lines[first + 1 :]:
        numbers = [number_of(cell) for cell in cells[1:]]
        if len(numbers) != len(columns) + has_force or None in numbers:
            raise cut_off(path)
        if cells[0].strip() == _FORCE:
            stated_n = numbers[-1] if has_force else None
            continue
        row = int(cells[0]) - 1 if cells[0].strip().isdigit() else -1
        pressures = np.array(numbers[: len(columns)], dtype=np.float64)
        if not (0 <= row < frame.shape[0] and 0 <= columns.min() <= columns.max() < frame.shape[1]):
            raise cut_off(path)
        frame[row, columns] = pressures
        total_n += float(pressures.sum()) * sensor_mm2 / 1000.0
    if has_force and (stated_n is None or _differ(total_n, stated_n)):
        raise InputError(
            "{path}: the pressures of a frame do not make up the force that it states; the file "
            "is damaged, so export it again.",
            path=path,
        )


def _is_heading(cells: list[str]) -> bool:
    return not cells[0].strip() and len(cells) > 2 and cells[1].strip().isdigit()


def _differ(total_n: float, stated_n: float) -> bool:
    return not abs(total_n - stated_n) <= _SUM_N + _SUM_SHARE * stated_n
