"""OFF: read with or without colours (COFF); written in mm, as text."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from insole_core.files.atomic import replacing_file
from insole_core.formats.number_text import (
    Lines,
    floats,
    plain_text,
    words_per_line,
    written_rows,
)
from insole_core.formats.raw_surface import RawSurface, as_indices, fans
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.solid_content import SolidContent
from insole_core.formats.texture import colors_of_numbers
from insole_core.geometry.arrays import ByteArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message

_HEAD = re.compile(rb"\s*(ST)?(C)?(N)?OFF\b\s*(\d{1,10})\s+(\d{1,10})(?:\s+\d{1,10})?[ \t]*\n")
_COMMENT = re.compile(rb"#[^\n]*")


def read_off(source: ScanContent) -> RawSurface:
    """Read an OFF.

    Raises
    ------
    ValueError
        When it is no OFF, or holds less than it declares.
    """
    text = plain_text(source.content)
    if b"#" in text:
        text = _COMMENT.sub(b"", text)
    head = _HEAD.match(text)
    if head is None:
        raise ValueError(
            Message('it does not begin with "OFF" and the numbers of points and faces')
        )
    points, faces = int(head[4]), int(head[5])
    body = text[head.end() :]
    lines = Lines(body)
    filled = words_per_line(lines.text) > 0
    if filled.sum() < points + faces:
        raise ValueError(
            Message(
                "it declares {points} points and {faces} faces and holds {held} of both",
                points=points,
                faces=faces,
                held=int(filled.sum()),
            )
        )
    order = np.cumsum(filled)
    columns = floats(lines.joined(filled & (order <= points)))
    if points == 0 or len(columns) % points or len(columns) < 3 * points:
        raise ValueError(Message("a point in it has fewer than three coordinates"))
    rows = columns.reshape(points, -1)
    corners, counts = _faces(lines.joined(filled & (order > points) & (order <= points + faces)))
    triangles = corners[fans(corners, counts)]
    colors = _colors(rows, skipped=3 + 3 * bool(head[3])) if head[2] else None
    return RawSurface(
        np.ascontiguousarray(rows[:, :3]),
        as_indices(triangles),
        colors,
    )


def _faces(text: bytes) -> tuple[IntArray, IntArray]:
    """Return the corners (n,) of all faces and the number (m,) of each; colours are dropped."""
    if not text:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    words = words_per_line(text)
    numbers = floats(text)  # colours of faces may have fractions
    firsts = np.cumsum(words) - words
    counts = numbers[firsts].astype(np.int64)
    if (counts < 0).any() or (counts >= words).any():
        raise ValueError(Message("a face in it has fewer corners than it declares"))
    place = np.arange(len(numbers)) - np.repeat(firsts, words)
    is_corner = (place > 0) & (place <= np.repeat(counts, words))
    return numbers[is_corner].astype(np.int64), counts


def _colors(rows: FloatArray, skipped: int) -> ByteArray | None:
    values = rows[:, skipped : skipped + 3]
    return colors_of_numbers(values) if values.shape[1] == 3 else None


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write the parts as shells of one mesh."""
    write_off(solid.merged, path, solid.note)


def write_off(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as OFF, atomically.

    Parameters
    ----------
    mesh : mm
    note
        A further comment, one line of ASCII.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    points, faces = len(mesh.vertices), len(mesh.triangles)
    rows = written_rows("%.5f %.5f %.5f\n", mesh.vertices)
    corners = written_rows("3 %d %d %d\n", mesh.triangles)
    comment = f"# {note}\n" if note else ""
    with replacing_file(path) as beside, beside.open("w", encoding="utf-8", newline="\n") as file:
        file.write(f"OFF\n# Insole Studio, unit mm\n{comment}{points} {faces} 0\n{rows}{corners}")
