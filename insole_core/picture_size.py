"""How large a picture is by its header, before it is decoded."""

from __future__ import annotations

import struct

PNG = b"\x89PNG\r\n\x1a\n"
"""How a PNG begins."""
_NO_FRAMES = (0xFFC4, 0xFFC8, 0xFFCC)
"""Segments of a JPEG that are numbered like those that start a frame."""
_TIFF_WIDTH, _TIFF_HEIGHT, _TIFF_SHORT = 256, 257, 3


def picture_size(content: bytes) -> tuple[int, int] | None:
    """Return width and height by the header of a PNG, JPEG, BMP or TIFF; None for all else.

    Decoding first would fill the memory with what a small file can unfold to.
    """
    try:
        if content.startswith(PNG):
            width, height = struct.unpack_from(">II", content, 16)
            return width, height
        if content.startswith(b"BM"):
            width, height = struct.unpack_from("<ii", content, 18)
            return abs(width), abs(height)
        if content.startswith((b"II*\0", b"MM\0*")):
            return _tiff_size(content, "<" if content.startswith(b"II") else ">")
        return _jpeg_size(content) if content.startswith(b"\xff\xd8") else None
    except (struct.error, KeyError):
        return None


def _tiff_size(content: bytes, order: str) -> tuple[int, int]:
    """Look the size up in the first directory (TIFF 6.0, section 2)."""
    (start,) = struct.unpack_from(f"{order}I", content, 4)
    (count,) = struct.unpack_from(f"{order}H", content, start)
    fields = {}
    for place in range(start + 2, start + 2 + 12 * count, 12):
        tag, kind = struct.unpack_from(f"{order}HH", content, place)
        form = "H" if kind == _TIFF_SHORT else "I"
        (fields[tag],) = struct.unpack_from(f"{order}{form}", content, place + 8)
    return fields[_TIFF_WIDTH], fields[_TIFF_HEIGHT]


def _jpeg_size(content: bytes) -> tuple[int, int]:
    """Walk through the segments to the one that starts the frame (ITU T.81, B.2.2)."""
    position = 2
    while True:
        marker, length, _bits, height, width = struct.unpack_from(">HHBHH", content, position)
        if marker & 0xFFF0 == 0xFFC0 and marker not in _NO_FRAMES:
            return width, height
        position += 2 + max(length, 1)
