"""Read what a PDF of the product holds, without a reader of PDF."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np

_WORD = re.compile(
    rb"\((?:[^()\\]|\\.)*\)|<[0-9a-fA-F]*>|\[[^\]]*\]|/[^\s/\[\]()<>]+"
    rb"|[-+]?(?:\d+\.?\d*|\.\d+)|[A-Za-z'\"*]+"
)
_NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)")
_STRING = re.compile(rb"\((?:[^()\\]|\\.)*\)", re.DOTALL)
_ENDS = (b"n", b"S", b"s", b"f", b"F", b"B", b"b", b"f*", b"B*", b"b*")
"""Of a path: not painted, or painted."""


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


def paths_of_pdf(path: Path) -> list[np.ndarray]:
    """The lines and boxes that are painted, as points (n, 2) in mm on their page."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\n?endstream", path.read_bytes(), re.DOTALL)
    contents = (_STRING.sub(b"()", _decoded(stream)) for stream in streams)
    return [line for content in contents if content.isascii() for line in _painted(content)]


def _painted(content: bytes) -> Iterator[np.ndarray]:
    now, kept = np.eye(3), []
    numbers: list[float] = []
    lines: list[list[tuple[float, float]]] = []
    for word in _WORD.findall(content):
        if _NUMBER.fullmatch(word):
            numbers.append(float(word))
            continue
        if word == b"q":
            kept.append(now)
        elif word == b"Q" and kept:
            now = kept.pop()
        elif word == b"cm":
            a, b, c, d, e, f = numbers[-6:]
            now = np.array([[a, b, 0], [c, d, 0], [e, f, 1]]) @ now
        elif word in _ENDS:
            if word != b"n":
                yield from (_in_mm(line, now) for line in lines)
            lines = []
        else:
            _follow(word, numbers, lines)
        numbers = []


def _follow(word: bytes, numbers: list[float], lines: list[list[tuple[float, float]]]) -> None:
    """Begin or go on with a line."""
    if word == b"re":
        x, y, wide, tall = numbers[-4:]
        lines.append([(x, y), (x + wide, y + tall)])
    elif word == b"m":
        lines.append([(numbers[-2], numbers[-1])])
    elif word in (b"l", b"c") and lines:
        lines[-1].append((numbers[-2], numbers[-1]))


def _in_mm(line: list[tuple[float, float]], to_page: np.ndarray) -> np.ndarray:
    return (np.pad(line, ((0, 0), (0, 1)), constant_values=1) @ to_page)[:, :2] * 25.4 / 72


def _decoded(stream: bytes) -> bytes:
    try:
        # Its last byte may be the one of a line break, which was taken for the end of the line.
        return zlib.decompressobj().decompress(stream)
    except zlib.error:
        return stream
