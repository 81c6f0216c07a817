"""XSENSOR insoles: a block of keys and sensels for each foot and frame, ``.csv``."""

from __future__ import annotations

import re
from pathlib import Path

from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.pressure.export_text import cut_off, numbers_of, stacked
from insole_core.pressure.recording import PressureRecording, PressureUnit, SeenFrom

_SIDES = {"LF": Side.LEFT, "RF": Side.RIGHT}
_SIDE = re.compile(r"-(LF|RF)\b")


def is_xsensor(text: str) -> bool:
    """Return whether a text is an export of XSENSOR insoles."""
    return "\nSENSOR," in text[:4000] and "Sensel Width" in text[:6000]


def read_xsensor(path: Path, text: str) -> tuple[PressureRecording, ...]:
    """Read the insoles of all frames; summaries of groups of sensels are left out.

    The rows run from the toes to the heel, seen from above; the name of the sensor tells the foot.

    Raises
    ------
    InputError
        When the file is cut off, or its unit is not known.
    """
    lines = [(n, line.split(",")) for n, line in enumerate(text.splitlines()) if line.strip(", \t")]
    keys: dict[str, str] = {}
    frames: dict[str, list[list[list[float]]]] = {}
    pitches: dict[str, tuple[float, float]] = {}
    is_group = False
    for place, (_, cells) in enumerate(lines):
        key, value = cells[0].strip(), cells[1].strip() if len(cells) > 1 else ""
        if key in ("SENSOR", "GROUP"):
            is_group = key == "GROUP"
        if key == "SENSELS" and not is_group:
            name = keys.get("SENSOR", "")
            rows, columns, pitches[name] = _size(path, keys)
            block = lines[place + 1 : place + 1 + rows]
            if len(block) < rows or any(len(row) < columns for _, row in block):
                raise cut_off(path)
            frames.setdefault(name, []).append(
                [numbers_of(path, number, row[:columns]) for number, row in block]
            )
        elif not is_group and value:
            keys[key] = value
    unit = PressureUnit.written(keys.get("Units:", ""))
    if not frames:
        raise cut_off(path)
    return tuple(
        PressureRecording(
            "XSENSOR", name, stacked(path, frames[name]), pitches[name], unit, _side(name),
            SeenFrom.ABOVE,
        )
        for name in frames
    )  # fmt: skip


def _size(path: Path, keys: dict[str, str]) -> tuple[int, int, tuple[float, float]]:
    try:
        rows, columns = int(keys["Rows"]), int(keys["Columns"])
        across, along = float(keys["Sensel Width (cm)"]), float(keys["Sensel Height (cm)"])
    except (KeyError, ValueError) as error:
        raise InputError(
            "{path} does not say how many sensels there are and how large they are; export it "
            "again.",
            path=path,
        ) from error
    return rows, columns, (10 * across, 10 * along)


def _side(name: str) -> Side | None:
    found = _SIDE.search(name)
    return None if found is None else _SIDES[found[1]]
