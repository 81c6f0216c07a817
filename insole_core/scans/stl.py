"""Read STL files, binary or text."""

from __future__ import annotations

import re

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.messages import Message
from insole_core.scans.number_text import Lines, floats, plain_text
from insole_core.scans.raw_surface import RawSurface
from insole_core.scans.scan_content import ScanContent, padding_note

_HEAD, _TAIL = 84, 512
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_INDENTED = re.compile(rb"^[ \t]+", re.MULTILINE)


def read_stl(source: ScanContent) -> RawSurface:
    """Read an STL: three corners for each triangle.

    Raises
    ------
    InputError
        When it holds another number of triangles than it declares, or is cut off.
    ValueError
        When it is no STL.
    """
    notes: tuple[Message, ...] = ()
    if _is_text(source.content):
        corners = _text_corners(source)
    else:
        corners, behind = _binary_corners(source)
        notes = (padding_note(behind),) if behind else ()
    triangles = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return RawSurface(corners, triangles, notes=notes)


def _is_text(content: bytes) -> bool:
    """Return whether it is a text; the heads of some binary ones begin with "solid", too."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff", b"\xef\xbb\xbf")):
        return True
    if len(content) < _HEAD:
        return content.lstrip().lower().startswith(b"solid")
    declared = int.from_bytes(content[80:_HEAD], "little")
    rest = len(content) - _HEAD
    fits = rest - _FACET.itemsize < declared * _FACET.itemsize <= rest
    if fits or not content[:_HEAD].lstrip().lower().startswith(b"solid"):
        return False
    return b"facet" in content[: _HEAD + _TAIL].lower()


def _binary_corners(source: ScanContent) -> tuple[FloatArray, int]:
    """Return the corners (n, 3), and the number of zero bytes behind the triangles."""
    content = source.content
    if len(content) < _HEAD:
        raise ValueError(Message("it is shorter than its header"))
    declared = int.from_bytes(content[80:_HEAD], "little")
    held = (len(content) - _HEAD) // _FACET.itemsize
    behind = content[_HEAD + declared * _FACET.itemsize :]
    is_padding = not behind.strip(b"\0")
    if declared > held or (declared < held and not is_padding):
        raise InputError(
            "{path} declares {declared} triangles and holds {held}; it is damaged or cut off, "
            "so export it again.",
            path=source.path,
            declared=declared,
            held=held,
        )
    facets = np.frombuffer(content, _FACET, declared, _HEAD)
    corners = facets["corners"].reshape(-1, 3).astype(float)
    return corners, len(behind) if is_padding else 0


def _text_corners(source: ScanContent) -> FloatArray:
    text = plain_text(source.content)
    if b"endsolid" not in text[-_TAIL:].lower():
        raise InputError(
            '{path} does not end in "endsolid", so it is cut off; export it again.',
            path=source.path,
        )
    if b"vertex" not in text:
        text = text.lower()
    lines = Lines(_INDENTED.sub(b"", text))
    is_corner = lines.begin_with(b"vertex")
    values = floats(lines.joined(is_corner).replace(b"vertex", b""))
    count = int(is_corner.sum())
    facets = int(lines.begin_with(b"facet").sum())
    if len(values) != 3 * count or count != 3 * facets:
        raise ValueError(Message("a triangle in it does not have three corners of three numbers"))
    return values.reshape(-1, 3)
