"""STL: read in either form; written in mm, binary, and as text for machines that read no other."""

from __future__ import annotations

from pathlib import Path
from typing import TypeAlias

import numpy as np

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.formats.number_text import (
    BYTE_ORDER_MARKS,
    Lines,
    floats,
    plain_text,
    unindented,
    written_rows,
)
from insole_core.formats.raw_surface import RawSurface
from insole_core.formats.scan_content import ScanContent, padding_note
from insole_core.formats.solid_content import SolidContent
from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message

_TITLE, _HEAD, _TAIL = 80, 84, 512
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = "Insole Studio, unit mm"  # must not begin with "solid", which would mark ASCII
_ASCII_FACET = (
    " facet normal %.6g %.6g %.6g\n  outer loop\n"
    + 3 * "   vertex %.9g %.9g %.9g\n"
    + "  endloop\n endfacet\n"
)

_Columns: TypeAlias = list[Float32Array]


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
    if content.startswith(tuple(BYTE_ORDER_MARKS)):
        return True
    if len(content) < _HEAD:
        return content.lstrip().lower().startswith(b"solid")
    declared = int.from_bytes(content[_TITLE:_HEAD], "little")
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
    declared = int.from_bytes(content[_TITLE:_HEAD], "little")
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
    lines = Lines(unindented(text))
    is_corner = lines.begin_with(b"vertex")
    values = floats(lines.joined(is_corner).replace(b"vertex", b""))
    count = int(is_corner.sum())
    facets = int(lines.begin_with(b"facet").sum())
    if len(values) != 3 * count or count != 3 * facets:
        raise ValueError(Message("a triangle in it does not have three corners of three numbers"))
    return values.reshape(-1, 3)


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write the parts as shells of one binary STL."""
    write_stl(solid.merged, path, solid.label)


def write_parts_as_text(solid: SolidContent, path: Path) -> None:
    """Write the parts as shells of one STL in text."""
    write_ascii_stl(solid.merged, path, solid.note)


def write_stl(mesh: TriangleMesh, path: Path, label: str = "") -> None:
    """Write a mesh as binary STL, atomically.

    Parameters
    ----------
    mesh : mm
    label
        Identifies the order in the header; shortened to what the header holds.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    facets = _facets(mesh)
    header = ", ".join(filter(None, (_HEADER, label))).encode("ascii", "replace")
    with replacing_file(path) as beside, beside.open("wb") as file:
        file.write(header[:_TITLE].ljust(_TITLE))
        file.write(np.uint32(len(facets)).astype("<u4").tobytes())
        file.write(facets.data)


def write_ascii_stl(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as ASCII STL, atomically, with enough digits to read the same numbers back.

    Parameters
    ----------
    mesh : mm
        Its coordinates are written in single precision.
    note
        Follows the name of the solid: one line of ASCII.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    facets = _facets(mesh)
    numbers = np.concatenate([facets["normal"], facets["corners"].reshape(-1, 9)], axis=1)
    text = written_rows(_ASCII_FACET, numbers)
    name = " ".join(filter(None, ("insole_mm", note)))
    with replacing_file(path) as beside, beside.open("w", encoding="ascii", newline="\n") as file:
        file.write(f"solid {name}\n{text}endsolid {name}\n")


def _facets(mesh: TriangleMesh) -> np.ndarray[tuple[int], np.dtype[np.void]]:
    """Return corners and normals of every triangle, single precision.

    The normals are those of the rounded corners, so that a reader finds them consistent.
    """
    facets = np.zeros(len(mesh.triangles), _FACET)
    # One contiguous array for each coordinate and corner: over twice as fast as rows of three.
    coordinates = np.ascontiguousarray(mesh.vertices.T, dtype=np.float32)
    corners = np.ascontiguousarray(mesh.triangles.T)
    a, b, c = ([axis[corner] for axis in coordinates] for corner in corners)
    for axis in range(3):
        for number, corner in enumerate((a, b, c)):
            facets["corners"][:, number, axis] = corner[axis]
    for axis, component in enumerate(_unit_cross(a, b, c)):
        facets["normal"][:, axis] = component
    return facets


def _unit_cross(a: _Columns, b: _Columns, c: _Columns) -> _Columns:
    """Compute the normals of triangles by component; zero for a triangle without area."""
    ab, ac = ([end - start for start, end in zip(a, other, strict=True)] for other in (b, c))
    cross = [
        ab[(axis + 1) % 3] * ac[(axis + 2) % 3] - ab[(axis + 2) % 3] * ac[(axis + 1) % 3]
        for axis in range(3)
    ]
    length = np.sqrt(cross[0] ** 2 + cross[1] ** 2 + cross[2] ** 2)
    length[length == 0] = 1
    return [component / length for component in cross]
