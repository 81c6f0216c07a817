"""Read what a PDF of the product holds, without a reader of PDF."""

from __future__ import annotations

import re
import zlib
from pathlib import Path


def bytes_of_pdf(path: Path) -> bytes:
    """The file and all its streams, decompressed."""
    content = path.read_bytes()
    streams = re.findall(rb"stream\r?\n(.*?)\r?\n?endstream", content, re.DOTALL)
    return b"\n".join([content, *(_decoded(stream) for stream in streams)])


def text_of_pdf(path: Path) -> str:
    """The letters that are drawn, line by line; only ASCII keeps its codes in a subset font."""
    strings = re.findall(rb"\(((?:[^()\\]|\\.)*)\) Tj", bytes_of_pdf(path), re.DOTALL)
    plain = (re.sub(rb"\\([()\\])", rb"\1", string) for string in strings)
    return "\n".join(string.decode("latin-1") for string in plain)


def _decoded(stream: bytes) -> bytes:
    try:
        # Its last byte may be the one of a line break, which was taken for the end of the line.
        return zlib.decompressobj().decompress(stream)
    except zlib.error:
        return stream
