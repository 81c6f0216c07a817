"""Formats of scans: which file is read by what."""

from __future__ import annotations

import binascii
import json
import struct
from collections.abc import Callable
from dataclasses import replace
from typing import Final
from xml.parsers import expat

from insole_core.errors import InputError
from insole_core.foreign_files import HEAD_BYTES, check_no_other_kind, pressure_device
from insole_core.messages import Message
from insole_core.scans.gltf import read_gltf
from insole_core.scans.number_text import BYTE_ORDER_MARKS, DecimalCommaError
from insole_core.scans.obj import read_obj
from insole_core.scans.off import read_off
from insole_core.scans.ply import read_ply
from insole_core.scans.point_text import read_point_text
from insole_core.scans.raw_surface import RawSurface
from insole_core.scans.scan_content import ScanContent, padding_note, unreadable
from insole_core.scans.stl import read_stl
from insole_core.scans.three_mf import read_three_mf

_READERS: Final[dict[str, Callable[[ScanContent], RawSurface]]] = {
    ".stl": read_stl,
    ".ply": read_ply,
    ".obj": read_obj,
    ".3mf": read_three_mf,
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".off": read_off,
    ".xyz": read_point_text,
    ".asc": read_point_text,
    ".pts": read_point_text,
}
_SIGNATURES: Final = (
    (b"glTF", "GLB", {".glb", ".gltf"}),
    (b"ply\n", "PLY", {".ply"}),
    (b"ply\r\n", "PLY", {".ply"}),
    (b"PK\x03\x04", "zip archive", {".3mf"}),
    (b"solid ", "STL", {".stl"}),
    (b"OFF\n", "OFF", {".off"}),
)
_UNREADABLE = (
    ValueError, LookupError, TypeError, AttributeError, struct.error, OverflowError, MemoryError,
    RecursionError, binascii.Error, json.JSONDecodeError, expat.ExpatError,
)  # fmt: skip


def read_raw(source: ScanContent) -> RawSurface:
    """Read the surface or the points of one file.

    Raises
    ------
    InputError
        When it is empty, of another format than its name says, damaged or cut off.
    """
    if not source.content.strip(b" \t\r\n\0"):
        raise InputError("{path} is empty; export it again.", path=source.path)
    head = source.content[:HEAD_BYTES]
    check_no_other_kind(source.path, head)
    device = pressure_device(head)
    if device is not None:
        raise InputError(
            "{path} is a pressure map of {device}, and no scan of a foot; choose the scan. The map "
            "is laid under a foot by Tools, Lay a pressure map.",
            path=source.path,
            device=device,
        )
    for signature, name, suffixes in _SIGNATURES:
        if source.content.startswith(signature) and source.suffix not in suffixes:
            raise InputError(
                "{path} holds something else than its name says ({format}, not {suffix}); choose "
                "another file, or give it its right name.",
                path=source.path,
                format=name,
                suffix=source.suffix,
            )
    text = _without_padding(source)
    padding = len(source.content) - len(text.content)
    try:
        raw = _READERS[source.suffix](text)
    except DecimalCommaError as error:
        raise InputError(
            "{path} is written with decimal commas, which no {format} file has; choose "
            "decimal points in the program or the system that wrote it, and export it again.",
            path=source.path,
            format=source.suffix[1:].upper(),
        ) from error
    except _UNREADABLE as error:
        raise unreadable(source, _reason(error)) from error

    return replace(raw, notes=(*raw.notes, padding_note(padding))) if padding else raw


def _without_padding(source: ScanContent) -> ScanContent:
    """Return a text without the zero bytes that some programs write behind it."""
    content = source.content
    if not content.endswith(b"\0") or content.startswith(tuple(BYTE_ORDER_MARKS)):
        return source
    text = content.rstrip(b"\0")
    return source if b"\0" in text else replace(source, content=text)


def _reason(error: BaseException) -> Message:
    """Return what a reader says of a file; what Python says of it helps nobody."""
    said = error.args[0] if error.args else ""
    if isinstance(said, Message):
        return said
    if isinstance(error, KeyError):
        return Message("it lacks {name}", name=repr(said)[:40])
    return Message("what it holds does not follow the rules of the format")
