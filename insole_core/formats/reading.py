"""Reading of scans: the reader that the name of a file selects, and one sentence for each fault."""

from __future__ import annotations

import binascii
import json
import struct
from dataclasses import replace
from typing import Final
from xml.parsers import expat

from insole_core.errors import InputError
from insole_core.foreign_files import HEAD_BYTES, check_no_other_kind, pressure_device
from insole_core.formats.file_formats import MESH_FORMATS, mesh_format
from insole_core.formats.number_text import BYTE_ORDER_MARKS, DecimalCommaError
from insole_core.formats.raw_surface import RawSurface
from insole_core.formats.scan_content import ScanContent, padding_note, unreadable
from insole_core.messages import Message

_ZIP: Final = b"PK\x03\x04"
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
    _check_signature(source)
    text = _without_padding(source)
    padding = len(source.content) - len(text.content)
    try:
        raw = mesh_format(source.suffix).read(text)
    except DecimalCommaError as error:
        raise InputError(
            "{path} is written with decimal commas, which no {format} file has; choose "
            "decimal points in the program or the system that wrote it, and export it again.",
            path=source.path,
            format=source.suffix[1:].upper(),
        ) from error
    except ModuleNotFoundError as error:
        raise InputError(
            "{path} is read by the library {library}, which is not installed; export the scan as "
            ".glb or .obj.",
            path=source.path,
            library=error.name or "",
        ) from error
    except _UNREADABLE as error:
        raise unreadable(source, _reason(error)) from error

    return replace(raw, notes=(*raw.notes, padding_note(padding))) if padding else raw


def _check_signature(source: ScanContent) -> None:
    """Refuse a file whose first bytes are those of another format."""
    named = mesh_format(source.suffix)
    held = [form.name for form in MESH_FORMATS if source.content.startswith(form.begins_with)]
    if source.content.startswith(_ZIP):
        held = [named.name] if named.is_archive else ["zip archive"]
    if held and held != [named.name]:
        raise InputError(
            "{path} holds something else than its name says ({format}, not {suffix}); choose "
            "another file, or give it its right name.",
            path=source.path,
            format=held[0],
            suffix=source.suffix,
        )


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
