"""Zip archives as no program of ours writes them."""

from __future__ import annotations

import io
import struct
import warnings
import zipfile
from collections.abc import Callable


def zip_of(*entries: tuple[str, bytes], packing: int = zipfile.ZIP_DEFLATED) -> bytes:
    packed = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(packed, "w", packing) as archive:
        warnings.simplefilter("ignore")  # of two entries of one name
        for name, content in entries:
            archive.writestr(name, content)
    return packed.getvalue()


def encrypted(archive: bytes) -> bytes:
    """Set the flag of every entry in the directory."""
    return with_directory(archive, lambda entry: struct.pack_into("<H", entry, 8, 1))


def with_sizes(archive: bytes, size: int) -> bytes:
    """State another size for every entry in the directory."""
    return with_directory(archive, lambda entry: struct.pack_into("<I", entry, 24, size))


def with_directory(archive: bytes, change: Callable[[memoryview], None]) -> bytes:
    content = bytearray(archive)
    at = content.find(b"PK\x01\x02")
    while at >= 0:
        change(memoryview(content)[at:])
        at = content.find(b"PK\x01\x02", at + 4)
    return bytes(content)


def with_backslashes(archive: bytes) -> bytes:
    """Separate the folders in the names as some programs for Windows do."""
    content = bytearray(archive)
    for signature, length_at, name_at in ((b"PK\x03\x04", 26, 30), (b"PK\x01\x02", 28, 46)):
        at = content.find(signature)
        while at >= 0:
            (length,) = struct.unpack_from("<H", content, at + length_at)
            name = slice(at + name_at, at + name_at + length)
            content[name] = content[name].replace(b"/", b"\\")
            at = content.find(signature, at + 4)
    return bytes(content)
