"""Checks that a mesh file holds what its own header says, before anything is made of it.

The readers of trimesh take what they find: a text that is cut off becomes half a foot.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import BinaryIO

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.mesh import TriangleMesh

_STL_HEAD, _STL_TAIL = 84, 512
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_PLY_HEAD = 64 * 1024
_PLY_ELEMENT = re.compile(rb"element\s+(\S+)\s+(\d{1,12})")
_INDEX_ZERO = re.compile(rb"^f[ \t](?:[^\n]*[ \t])?[+-]?0+(?=[/ \t\r\n]|\Z)", re.MULTILINE)


def read_binary_stl(path: Path) -> TriangleMesh | None:
    """Read a binary STL; None for a text.

    Raises
    ------
    InputError
        When it declares another number of triangles than it holds.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        head = file.read(_STL_HEAD)
        if _is_text(head, file, size) or len(head) < _STL_HEAD:
            return None
        declared = int.from_bytes(head[80:], "little")
        held = (size - _STL_HEAD) // _FACET.itemsize
        if declared != held:
            raise InputError(
                "{path} declares {declared} triangles and holds {held}; it is damaged or cut off, "
                "so export it again.",
                path=path,
                declared=declared,
                held=held,
            )
        facets = np.fromfile(file, _FACET, declared)
    corners = facets["corners"].reshape(-1, 3).astype(float)
    return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))


def check_text(path: Path) -> None:
    """Check the counts of a PLY, the end of an STL text, and the indices of an OBJ.

    Raises
    ------
    InputError
        When the file contradicts itself.
    """
    suffix = path.suffix.lower()
    if suffix == ".ply":
        _check_ply(path)
    elif suffix == ".stl":
        _check_stl_text(path)
    elif _INDEX_ZERO.search(path.read_bytes()):
        raise InputError(
            "{path} has a triangle with the corner 0, but an OBJ counts from 1; export it again.",
            path=path,
        )


def _is_text(head: bytes, file: BinaryIO, size: int) -> bool:
    """Return whether an STL is a text; the heads of some binary ones begin with "solid", too."""
    declared = int.from_bytes(head[80:], "little")
    fits = size - _STL_HEAD - _FACET.itemsize < declared * _FACET.itemsize <= size - _STL_HEAD
    if fits or not head.lstrip().lower().startswith(b"solid"):
        return False
    following = head + file.read(_STL_TAIL)
    file.seek(_STL_HEAD)
    return b"facet" in following.lower()


def _check_stl_text(path: Path) -> None:
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(max(0, size - _STL_TAIL))
        tail = file.read()
    if b"endsolid" not in tail.lower():
        raise InputError(
            '{path} does not end in "endsolid", so it is cut off; export it again.', path=path
        )


def _check_ply(path: Path) -> None:
    with path.open("rb") as file:
        head, end, _ = file.read(_PLY_HEAD).partition(b"end_header")
        if not end or not head.startswith(b"ply"):
            raise InputError("{path} has no header of a PLY; export it again.", path=path)
        elements = _elements(head, path)
        file.seek(len(head) + len(end))
        file.readline()
        if re.search(rb"^format\s+ascii", head, re.MULTILINE):
            held = sum(1 for line in file if line.strip())
            is_whole = held == sum(elements.values())
        else:  # an element has a byte or more, and trimesh counts the bytes
            held = path.stat().st_size - file.tell()
            is_whole = sum(elements.values()) <= held
    if not is_whole:
        raise InputError(
            "{path} declares {declared} points and triangles, but it does not hold as many; it is "
            "damaged or cut off, so export it again.",
            path=path,
            declared=sum(elements.values()),
        )


def _elements(head: bytes, path: Path) -> dict[bytes, int]:
    lines = [line.strip() for line in head.splitlines() if line.strip().startswith(b"element")]
    found = [match for match in map(_PLY_ELEMENT.fullmatch, lines) if match]
    elements = {match[1]: int(match[2]) for match in found}
    if len(elements) < len(lines):
        raise InputError(
            "{path} declares something twice or without a number in its header; export it again.",
            path=path,
        )
    return elements
