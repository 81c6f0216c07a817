"""Read clouds of points from texts: XYZ, ASC and PTS, with colours and normals or without."""

from __future__ import annotations

import re

import numpy as np

from insole_core.formats.number_text import floats, plain_text, words_per_line
from insole_core.formats.raw_surface import RawSurface
from insole_core.formats.scan_content import ScanContent
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.messages import Message

_MOST_HEAD_LINES = 50
_MOST_LINE_BYTES, _MOST_COLUMNS = 4096, 64
"""More than a point with its colour, its normal and what else a scanner says of it."""
_NUMBERS = re.compile(rb"[-+.,;\d\seE]*")
_UNIT_TOLERANCE = 0.02
_LEAST_SHARE = 0.9


def read_point_text(source: ScanContent) -> RawSurface:
    """Read a cloud of points, a line each: coordinates, then colours, normals, or what else.

    Decimal points and commas are understood, and words above the numbers.

    Raises
    ------
    ValueError
        When it holds no such lines.
    """
    text, count = _body(plain_text(source.content))
    text = _with_points(text)
    columns = words_per_line(text)
    columns = columns[columns > 0]
    if len(columns) == 0:
        raise ValueError(Message("it holds no points"))
    if columns.max() > _MOST_COLUMNS:
        raise _long_line()
    if columns.min() < 3 or columns.min() != columns.max():
        raise ValueError(Message("its lines do not hold the same number of columns, three or more"))
    if count is not None and count != len(columns):
        raise ValueError(
            Message("it declares {count} points and holds {held}", count=count, held=len(columns))
        )
    rows = floats(text).reshape(len(columns), -1)
    colors, normals = _attributes(rows[:, 3:])
    return RawSurface(np.ascontiguousarray(rows[:, :3]), colors=colors, normals=normals)


def _body(text: bytes) -> tuple[bytes, int | None]:
    """Return the lines of numbers, and how many a PTS declares before them.

    Raises
    ------
    ValueError
        When it has no lines of points.
    """
    count = None
    for _ in range(_MOST_HEAD_LINES):
        if text.find(b"\n", 0, _MOST_LINE_BYTES) < 0 and len(text) > _MOST_LINE_BYTES:
            raise _long_line()
        line, _, rest = text.partition(b"\n")
        words = line.split()
        is_numbers = _NUMBERS.fullmatch(line) and words
        if is_numbers and (len(words) > 1 or b"," in line or b";" in line):
            break
        if is_numbers and len(words) == 1 and words[0].isdigit():
            count = int(words[0])
        if not rest:
            break
        text = rest
    return (text if text.endswith(b"\n") else text + b"\n"), count


def _long_line() -> ValueError:
    return ValueError(
        Message("a line of it is longer than a point with its colours; each point has its own line")
    )


def _with_points(text: bytes) -> bytes:
    """Return the text with decimal points, and nothing but white space between its numbers.

    Raises
    ------
    ValueError
        When a comma may be either.
    """
    if b";" in text:
        return text.translate(bytes.maketrans(b";,", b" ."))
    if b"," not in text:
        return text
    line = text.lstrip().partition(b"\n")[0]
    words = line.split()
    if b"." not in text and len(words) >= 3 and all(b"," in word[:-1] for word in words[:3]):
        return text.replace(b",", b".")
    if b"." in text or b", " in text or line.count(b",") == 2:
        return text.replace(b",", b" ")
    raise ValueError(Message("its commas may be decimals or stand between the numbers"))


def _attributes(values: FloatArray) -> tuple[ByteArray | None, FloatArray | None]:
    """Return colours (n, 3) and normals (n, 3) among the columns behind the coordinates."""
    colors: ByteArray | None = None
    normals: FloatArray | None = None
    first = 0
    while first + 3 <= values.shape[1]:
        group = values[:, first : first + 3]
        if normals is None and _are_normals(group):
            normals, first = np.ascontiguousarray(group), first + 3
        elif colors is None and _are_colors(group):
            colors, first = group.astype(np.uint8), first + 3
        else:
            first += 1
    return colors, normals


def _are_normals(group: FloatArray) -> bool:
    off = np.abs(np.linalg.norm(group, axis=1) - 1.0) < _UNIT_TOLERANCE
    return bool(off.mean() > _LEAST_SHARE)


def _are_colors(group: FloatArray) -> bool:
    in_range = (group >= 0) & (group <= 255) & (group == np.floor(group))
    return bool(in_range.all() and group.max() > 1)
