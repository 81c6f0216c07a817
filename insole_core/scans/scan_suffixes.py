"""How the names of scans end: what the window has to know before any scan is read."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from insole_core.errors import InputError
from insole_core.foreign_files import kind_by_ending
from insole_core.messages import joined

SCAN_SUFFIXES: Final = (
    ".stl", ".ply", ".obj", ".3mf", ".glb", ".gltf", ".off", ".xyz", ".asc", ".pts",
)  # fmt: skip
"""Of all files that are read, in small letters."""


def check_suffix(path: Path) -> None:
    """Refuse a file that is none of the formats by its name.

    Raises
    ------
    InputError
    """
    if path.suffix.lower() in SCAN_SUFFIXES:
        return
    kind = kind_by_ending(path)
    if kind is not None:
        raise InputError("{path} is no scan that can be read: {kind}.", path=path, kind=kind)
    raise InputError(
        "{path} is no scan that can be read; hand in a file of one of the formats {suffixes}.",
        path=path,
        suffixes=joined(SCAN_SUFFIXES),
    )
