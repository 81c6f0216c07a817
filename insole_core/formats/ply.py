"""PLY: surfaces with colours, and clouds of points with normals; written in mm, binary.

Every count of a header that is read is held against the bytes before anything is made of it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.formats.number_text import Lines, floats, plain_text, words_per_line
from insole_core.formats.raw_surface import MOST_CORNERS, RawSurface, as_indices, fans
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.solid_content import SolidContent
from insole_core.formats.units import MM_PER_UNIT, Unit
from insole_core.geometry.arrays import ByteArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.mesh import PLY_ELEMENT, ContourConstraints, TriangleMesh
from insole_core.messages import Message

_HEAD_BYTES = 64 * 1024
_UNIT = re.compile(r"comment\b.*\bunits?[ :=]+(mm|cm|m|inch)", re.IGNORECASE)
_ELEMENT = re.compile(r"element\s+(\S+)\s+(\d{1,12})")
_FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip
_POSITION, _NORMAL, _COLOR = ("x", "y", "z"), ("nx", "ny", "nz"), ("red", "green", "blue")
_FACES = ("vertex_indices", "vertex_index")
_PADDING = b"\x00 \r\n\t"
_WRITTEN_VERTEX = [("position", "<f4", 3)]
_WRITTEN_COLOR = [("color", "u1", 3)]
_WRITTEN_TRIANGLE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])

_Table = dict[str, npt.NDArray[Any]]
"""Columns (n,) by name."""


@dataclass
class _Element:
    """An element of the header: its number, and its properties as (name, type, type of count)."""

    name: str
    count: int
    properties: list[tuple[str, str, str | None]] = field(default_factory=list)

    @property
    def list_name(self) -> str | None:
        return next((name for name, _, count in self.properties if count is not None), None)


@dataclass(frozen=True, eq=False)
class _Polygons:
    """Corners (n,) of all polygons, and the number (m,) of each."""

    corners: IntArray
    counts: IntArray


def read_ply(source: ScanContent) -> RawSurface:
    """Read a PLY; without faces it is a cloud of points.

    Raises
    ------
    InputError
        When it holds less than it declares.
    ValueError
        When it is damaged otherwise.
    """
    order, elements, body = _header(source)
    read = _read_text if order == "" else _read_binary
    tables, polygons = read(elements, body, order, source)
    vertex = tables.get("vertex", {})
    vertices = _columns(vertex, _POSITION)
    if vertices is None:
        raise ValueError(Message("it holds no points with x, y and z"))
    triangles = np.empty((0, 3), dtype=np.int32)
    if polygons is not None:
        triangles = as_indices(polygons.corners[fans(polygons.corners, polygons.counts)])
    normals = None if len(triangles) else _columns(vertex, _NORMAL)
    return RawSurface(
        vertices,
        triangles,
        _colors(vertex),
        normals,
        _touches(tables),
        _stated_unit(source),
        is_unit_remark=True,
    )


def _stated_unit(source: ScanContent) -> Unit | None:
    """Return the unit of a comment of the header, as this program writes one."""
    head = source.content[:_HEAD_BYTES].partition(b"end_header")[0].decode("utf-8", "replace")
    named = {
        found[1].lower() for line in head.splitlines() if (found := _UNIT.fullmatch(line.strip()))
    }
    return next((unit for unit in MM_PER_UNIT if named == {unit}), None)


def _header(source: ScanContent) -> tuple[str, list[_Element], memoryview]:
    """Return the byte order ("" of a text), the elements, and what follows the header."""
    content = source.content
    head, end, _ = content[:_HEAD_BYTES].partition(b"end_header")
    if not end or not head.startswith(b"ply"):
        raise InputError("{path} has no header of a PLY; export it again.", path=source.path)
    lines = [line.strip() for line in head.decode("utf-8", "replace").splitlines()]
    words = [line.split() for line in lines if line]
    form = next((line[1] for line in words if line[0] == "format" and len(line) > 1), "")
    if form not in _FORMATS:
        raise ValueError(Message("its format {name} is none of PLY", name=form[:30]))
    elements = _elements(lines, source)
    start = len(head) + len(end)
    line_end = content[start : start + 2]
    start += 2 if line_end == b"\r\n" else 1
    return _FORMATS[form], elements, memoryview(content)[start:]


def _elements(lines: list[str], source: ScanContent) -> list[_Element]:
    elements: list[_Element] = []
    declared = [line for line in lines if line.startswith("element")]
    for line in lines:
        words = line.split()
        if line.startswith("element"):
            match = _ELEMENT.fullmatch(line)
            if match is not None:
                elements.append(_Element(match[1], int(match[2])))
        elif line.startswith("property") and elements:
            elements[-1].properties.append(_property(words))
    names = {element.name for element in elements}
    if len(names) < len(declared):
        raise InputError(
            "{path} declares something twice or without a number in its header; export it again.",
            path=source.path,
        )
    return elements


def _property(words: list[str]) -> tuple[str, str, str | None]:
    is_list = len(words) == 5 and words[1] == "list"
    types = words[2:4] if is_list else words[1:2]
    if not (is_list or len(words) == 3) or any(kind not in _TYPES for kind in types):
        raise ValueError(Message('its header holds "{text}"', text=" ".join(words)[:60]))
    return words[-1], _TYPES[types[-1]], _TYPES[types[0]] if is_list else None


def _read_text(
    elements: list[_Element], body: memoryview, _order: str, source: ScanContent
) -> tuple[dict[str, _Table], _Polygons | None]:
    lines = Lines(plain_text(bytes(body)))
    words = words_per_line(lines.text)
    filled = words > 0
    number = np.cumsum(filled)
    if number[-1] != sum(element.count for element in elements):
        raise _incomplete(elements, source)
    tables: dict[str, _Table] = {}
    polygons = None
    before = 0
    for element in elements:
        chosen = filled & (number > before) & (number <= before + element.count)
        before += element.count
        if element.count == 0 or (element.list_name and element.name != "face"):
            continue
        values, columns = floats(lines.joined(chosen)), words[chosen]
        if element.name == "face":
            polygons = _text_polygons(element, values, columns)
        elif (columns == len(element.properties)).all():
            rows = values.reshape(element.count, -1)
            names = [name for name, _, _ in element.properties]
            tables[element.name] = dict(zip(names, rows.T, strict=True))
        else:
            raise ValueError(Message("a line of its {name} is incomplete", name=element.name[:20]))
    return tables, polygons


def _text_polygons(element: _Element, values: FloatArray, columns: IntArray) -> _Polygons:
    place = [name for name, _, _ in element.properties].index(_face_name(element))
    if any(count is not None for _, _, count in element.properties[:place]):
        raise ValueError(Message("another list stands before the corners of its faces"))
    firsts = np.cumsum(columns) - columns
    if (columns <= place).any():
        raise ValueError(Message("a face in it is incomplete"))
    counts = values[firsts + place].astype(np.int64)
    if (counts < 0).any() or (place + counts >= columns).any():
        raise ValueError(Message("a face in it has fewer corners than it declares"))
    offset = np.arange(len(values)) - np.repeat(firsts + place, columns)
    is_corner = (offset > 0) & (offset <= np.repeat(counts, columns))
    return _Polygons(values[is_corner].astype(np.int64), counts)


def _face_name(element: _Element) -> str:
    for name in _FACES:
        if any(name == known and count is not None for known, _, count in element.properties):
            return name
    raise ValueError(Message("its faces name no corners"))


def _read_binary(
    elements: list[_Element], body: memoryview, order: str, source: ScanContent
) -> tuple[dict[str, _Table], _Polygons | None]:
    tables: dict[str, _Table] = {}
    polygons = None
    for element in elements:
        if element.list_name is None:
            rows = _fixed_rows(element, body, order, 0)
            if rows is None:
                raise _incomplete(elements, source)
            tables[element.name] = {name: rows[name] for name, _, _ in element.properties}
            body = body[rows.nbytes :]
        else:
            read = _listed_rows(element, body, order)
            if read is None:
                raise _incomplete(elements, source)
            found, used = read
            polygons = found if element.name == "face" else polygons
            body = body[used:]
    if bytes(body).strip(_PADDING):
        raise _incomplete(elements, source)
    return tables, polygons


def _row_type(element: _Element, order: str, corners: int) -> np.dtype[Any]:
    """Return the type of rows whose lists all have the same number of corners."""
    fields: list[tuple[Any, ...]] = []
    for name, kind, count in element.properties:
        if count is not None:
            fields.append((f"{name} count", order + count))
            fields.append((name, order + kind, (corners,)))
        else:
            fields.append((name, order + kind))
    return np.dtype(fields)


def _fixed_rows(
    element: _Element, body: memoryview, order: str, corners: int
) -> npt.NDArray[Any] | None:
    """Return the rows of an element; None where there are fewer bytes."""
    kind = _row_type(element, order, corners)
    if element.count * max(kind.itemsize, 1) > len(body):
        return None
    return np.frombuffer(body, kind, element.count)


def _listed_rows(
    element: _Element, body: memoryview, order: str
) -> tuple[_Polygons | None, int] | None:
    """Return the polygons of an element and its bytes; None where there are fewer bytes."""
    if element.count == 0:
        return None if element.name != "face" else (_Polygons(*_no_polygons()), 0)
    name = _face_name(element) if element.name == "face" else str(element.list_name)
    lists = [known for known, _, count in element.properties if count is not None]
    if len(lists) == 1:
        for corners in (3, 4):
            rows = _fixed_rows(element, body, order, corners)
            if rows is not None and (rows[f"{name} count"] == corners).all():
                counts = np.full(element.count, corners, dtype=np.int64)
                return _Polygons(rows[name].ravel().astype(np.int64), counts), rows.nbytes
    return _walked_rows(element, body, order, name)


def _no_polygons() -> tuple[IntArray, IntArray]:
    return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)


def _walked_rows(
    element: _Element, body: memoryview, order: str, wanted: str
) -> tuple[_Polygons, int] | None:
    """Walk through rows whose lists differ in length."""
    steps = [
        (name, np.dtype(order + kind), None if count is None else np.dtype(order + count))
        for name, kind, count in element.properties
    ]
    parts, counts, place = [], np.empty(element.count, dtype=np.int64), 0
    if element.count > len(body):
        return None
    for row in range(element.count):
        for name, kind, count_kind in steps:
            length = 1
            if count_kind is not None:
                length = _number(body[place : place + count_kind.itemsize], order)
                place += count_kind.itemsize
                if length > MOST_CORNERS:
                    raise ValueError(
                        Message("a polygon has more than {most} corners", most=MOST_CORNERS)
                    )
            end = place + length * kind.itemsize
            if end > len(body):
                return None
            if name == wanted:
                counts[row] = length
                parts.append(body[place:end])
            place = end
    kind = next(kind for name, kind, _ in steps if name == wanted)
    return _Polygons(np.frombuffer(b"".join(parts), kind).astype(np.int64), counts), place


def _number(content: memoryview, order: str) -> int:
    return int.from_bytes(content, "big" if order == ">" else "little")


def _incomplete(elements: list[_Element], source: ScanContent) -> InputError:
    return InputError(
        "{path} declares {declared} points and triangles, but it does not hold exactly as many; "
        "it is damaged or cut off, so export it again.",
        path=source.path,
        declared=sum(element.count for element in elements),
    )


def _columns(table: _Table, names: tuple[str, ...]) -> FloatArray | None:
    """Return columns (n, len(names)); None where one is missing."""
    if not set(names) <= table.keys():
        return None
    return np.column_stack([np.asarray(table[name], dtype=float) for name in names])


def _colors(table: _Table) -> ByteArray | None:
    values = _columns(table, _COLOR)
    if values is None or not np.isfinite(values).all() or values.min(initial=0) < 0:
        return None
    is_share = table["red"].dtype.kind == "f" and values.max(initial=0) <= 1.0
    return np.rint(np.clip(values * (255.0 if is_share else 1.0), 0, 255)).astype(np.uint8)


def _touches(tables: dict[str, _Table]) -> ContourConstraints | None:
    """Return the contour constraints that a foot reconstructed by this program holds."""
    values = _columns(tables.get(PLY_ELEMENT, {}), (*_POSITION, *_NORMAL))
    if values is None:
        return None
    values = values[np.isfinite(values).all(axis=1)]
    return ContourConstraints(values[:, :3], values[:, 3:])


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write the parts as shells of one mesh, in their colours."""
    write_ply(solid.painted, path, solid.note)


def write_ply(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as little-endian binary PLY, atomically.

    Contour constraints become an element of their own.

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
    colors = mesh.colors
    vertices = np.empty(
        len(mesh.vertices), _WRITTEN_VERTEX + (_WRITTEN_COLOR if colors is not None else [])
    )
    vertices["position"] = mesh.vertices
    if colors is not None:
        vertices["color"] = colors
    triangles = np.empty(len(mesh.triangles), _WRITTEN_TRIANGLE)
    triangles["count"] = 3
    triangles["corners"] = mesh.triangles
    touches = _touch_rows(mesh)
    with replacing_file(path) as beside, beside.open("wb") as file:
        colored = colors is not None
        file.write(_written_header(len(vertices), len(triangles), colored, len(touches), note))
        file.write(vertices.tobytes())
        file.write(triangles.tobytes())
        file.write(touches.tobytes())


def _touch_rows(mesh: TriangleMesh) -> Float32Array:
    """Return points and normals (k, 6); other programs skip an element that they do not know."""
    if mesh.touches is None:
        return np.zeros((0, 6), np.float32)
    return np.hstack([mesh.touches.points, mesh.touches.normals]).astype("<f4")


def _written_header(vertices: int, triangles: int, colored: bool, touches: int, note: str) -> bytes:
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        "comment Insole Studio, unit mm",
        *([f"comment {note}"] if note else []),
        f"element vertex {vertices}",
        *(f"property float {axis}" for axis in "xyz"),
        *(f"property uchar {name}" for name in ("red", "green", "blue") if colored),
        f"element face {triangles}",
        "property list uchar int vertex_indices",
        *([f"element {PLY_ELEMENT} {touches}"] if touches else []),
        *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz") if touches),
        "end_header",
    ]
    return ("\n".join(lines) + "\n").encode("ascii")
