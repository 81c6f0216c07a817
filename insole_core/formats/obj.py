"""OBJ: read with materials and textures, three million triangles in seconds; written in mm."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.errors import InputError
from insole_core.files.atomic import replacing_file
from insole_core.formats.number_text import (
    Lines,
    floats,
    integers,
    plain_text,
    unindented,
    word_starts,
    words_per_line,
    written_rows,
)
from insole_core.formats.raw_surface import RawSurface, as_indices, fans
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.solid_content import SolidContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    NO_COLOR,
    colors_of_numbers,
    colors_of_shares,
    decode_texture,
    missing_texture,
    sampled,
)
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message

_MOST_LIBRARIES, _MOST_LIBRARY_BYTES = 10, 2**20
_MOST_MATERIALS = 100
_OPTIONS = {
    b"-blendu": 1, b"-blendv": 1, b"-boost": 1, b"-mm": 2, b"-o": 3, b"-s": 3, b"-t": 3,
    b"-texres": 1, b"-clamp": 1, b"-bm": 1, b"-imfchan": 1, b"-type": 1, b"-cc": 1,
}  # fmt: skip
"""Numbers of values behind each option of a map."""
_SLASHED = re.compile(rb"/[^ \t\n]*")
_Counts = Callable[[], IntArray]
"""How many vertices or coordinates stand before each polygon (m,)."""


@dataclass(frozen=True, eq=False)
class Material:
    """A colour (3,) uint8, a picture (h, w, 3) uint8, both RGB, or neither."""

    color: ByteArray | None = None
    picture: ByteArray | None = None


@dataclass(frozen=True)
class _Entry:
    color: tuple[float, ...] = ()
    picture: str = ""


def read_materials(
    libraries: list[bytes], wanted: set[bytes], source: ScanContent
) -> tuple[dict[bytes, Material], list[Message]]:
    """Read the wanted materials.

    Parameters
    ----------
    libraries
        Lines of the OBJ that name them.

    Returns
    -------
    materials : dict
    notes : list
        What was missing, a sentence each.
    """
    notes: list[Message] = []
    entries: dict[bytes, _Entry] = {}
    for line in libraries[:_MOST_LIBRARIES]:
        name = line.partition(b" ")[2].strip().decode("utf-8", "replace")
        content = source.beside(name, _MOST_LIBRARY_BYTES)
        try:
            entries |= _entries(plain_text(content or b""))
        except ValueError:
            content = None
        if content is None:
            notes.append(
                Message(
                    "The file of colours {library} is not beside the scan or cannot be read; the "
                    "scan has no colours.",
                    library=name[:80],
                )
            )
    used = {name: entry for name, entry in entries.items() if name in wanted}
    if len(used) > _MOST_MATERIALS:
        return {}, notes
    pictures: dict[str, ByteArray | None] = {}
    for name in dict.fromkeys(entry.picture for entry in used.values() if entry.picture):
        content = source.beside(name, MOST_TEXTURE_BYTES)
        pictures[name] = None if content is None else decode_texture(content)
        if pictures[name] is None:
            notes.append(missing_texture(name))
    return {
        name: Material(_color(entry), pictures.get(entry.picture)) for name, entry in used.items()
    }, notes


def _color(entry: _Entry) -> ByteArray | None:
    """Return the colour of a material; None where a picture shows it."""
    if len(entry.color) != 3 or entry.picture or not np.isfinite(entry.color).all():
        return None
    return colors_of_shares(np.array(entry.color))


def _entries(text: bytes) -> dict[bytes, _Entry]:
    found: dict[bytes, _Entry] = {}
    name: bytes | None = None
    for line in text.splitlines():
        key, _, rest = line.strip().partition(b" ")
        if key == b"newmtl":
            name = rest.strip()
            found[name] = _Entry()
        elif name is not None and key == b"Kd":
            found[name] = replace(found[name], color=tuple(floats(rest).tolist()))
        elif name is not None and key == b"map_Kd":
            found[name] = replace(found[name], picture=_picture_name(rest))
    return found


def _picture_name(rest: bytes) -> str:
    """Return what follows the options of a map; the name may hold spaces."""
    words = rest.strip().split(b" ")
    while words and words[0] in _OPTIONS:
        words = words[1 + _OPTIONS[words[0]] :]
    return b" ".join(words).decode("utf-8", "replace")


@dataclass(frozen=True, eq=False)
class _Corners:
    """Corners of the polygons: vertex (n,), texture coordinate (n,) if any, corners of each."""

    vertex: IntArray
    texture: IntArray | None
    counts: IntArray


def read_obj(source: ScanContent) -> RawSurface:
    """Read an OBJ: its vertices, polygons, and the colours of its vertices or textures.

    Raises
    ------
    InputError
        When a polygon has the corner 0.
    ValueError
        When it is no OBJ.
    """
    text = unindented(plain_text(source.content).replace(b"\\\n", b" "))
    lines = Lines(text)
    is_vertex, is_face = lines.begin_with(b"v"), lines.begin_with(b"f")
    rows = _rows(lines.joined(is_vertex), int(is_vertex.sum()), b"v")
    if rows.shape[1] < 3:
        raise ValueError(Message("a point in it has fewer than three coordinates"))
    corners = _corners(
        lines.joined(is_face),
        lambda: np.cumsum(is_vertex, dtype=np.int64)[is_face],
        lambda: np.cumsum(lines.begin_with(b"vt"), dtype=np.int64)[is_face],
        source,
    )
    triangles = corners.vertex[fans(corners.vertex, corners.counts)]
    colors = _own_colors(rows)
    notes: list[Message] = []
    if colors is None and len(triangles) and b"usemtl" in text:
        colors, notes = _material_colors(lines, is_face, corners, len(rows), source)
    return RawSurface(
        np.ascontiguousarray(rows[:, :3]),
        as_indices(triangles),
        colors,
        notes=tuple(notes),
    )


def _rows(text: bytes, count: int, letters: bytes) -> FloatArray:
    """Return the numbers (count, columns) of lines that begin with the letters."""
    values = floats(text.translate(None, letters))
    if count == 0:
        return np.empty((0, 3))
    columns = words_per_line(text) - 1
    if (columns != columns[0]).any():  # some have a weight or a colour, and some none
        least = int(columns.min())
        firsts = np.cumsum(columns) - columns
        return np.asarray(values[firsts[:, None] + np.arange(least)])
    return values.reshape(count, -1)


def _corners(
    text: bytes, vertices_before: _Counts, coordinates_before: _Counts, source: ScanContent
) -> _Corners:
    """Read the polygons; relative indices count back from what is before them."""
    begins = word_starts(np.frombuffer(text, np.uint8))
    counts = words_per_line(text, begins) - 1 if text else np.empty(0, dtype=np.int64)
    per_corner, with_texture = _form(text, begins)
    if per_corner == 0:  # corners of different forms
        text, per_corner, with_texture = _SLASHED.sub(b"", text), 1, False
    numbers = integers(text.translate(bytes.maketrans(b"/", b" "), b"f"))
    if len(numbers) != per_corner * counts.sum():
        raise ValueError(Message("a triangle in it is incomplete"))
    numbers = numbers.reshape(-1, per_corner)
    vertex = _from_zero(numbers[:, 0], vertices_before, counts, source)
    if not with_texture:
        return _Corners(vertex, None, counts)
    return _Corners(vertex, _from_zero(numbers[:, 1], coordinates_before, counts, source), counts)


def _form(text: bytes, begins: IntArray) -> tuple[int, bool]:
    """Return the numbers per corner, and whether the second is a texture; 0 if they differ.

    `begins` (m,) are where its words begin.
    """
    codes = np.frombuffer(text, np.uint8)
    slashes = np.flatnonzero(codes == ord("/"))
    if not len(slashes):
        return 1, False
    starts = begins[codes[begins] != ord("f")]
    each, rest = divmod(len(slashes), len(starts))
    double = text.count(b"//")
    if rest or double not in {0, len(starts)} or b"/ " in text or b"/\n" in text:
        return 0, False
    by_corner = slashes.reshape(-1, each)
    if (by_corner[:, 0] < starts).any() or (by_corner[:-1, -1] > starts[1:]).any():
        return 0, False
    return (2, False) if double else (each + 1, True)


def _from_zero(
    numbers: IntArray, before: _Counts, counts: IntArray, source: ScanContent
) -> IntArray:
    """Return indices that count from 0, whether they count from 1 or back from their line."""
    if (numbers == 0).any():
        raise InputError(
            "{path} has a triangle with the corner 0, but an OBJ counts from 1; export it again.",
            path=source.path,
        )
    if numbers.min(initial=1) > 0:
        return numbers - 1
    return np.where(numbers > 0, numbers - 1, np.repeat(before(), counts) + numbers)


def _own_colors(rows: FloatArray) -> ByteArray | None:
    """Return the colours behind the coordinates; a weight may stand before them."""
    if rows.shape[1] not in (6, 7):
        return None
    return colors_of_numbers(rows[:, -3:])


def _material_colors(
    lines: Lines, is_face: BoolArray, corners: _Corners, count: int, source: ScanContent
) -> tuple[ByteArray | None, list[Message]]:
    """Return the colours (count, 3) of the materials, and what was missing."""
    is_use = lines.begin_with(b"usemtl")
    names = [line.partition(b" ")[2].strip() for line in lines.each(is_use)]
    libraries = lines.each(lines.begin_with(b"mtllib"))
    materials, notes = read_materials(libraries, set(names), source)
    inside = (corners.vertex >= 0) & (corners.vertex < count)
    if not materials or not inside.all():
        return None, notes
    number = {name: place for place, name in enumerate(materials)}
    of_use = np.array([-1, *(number.get(name, -1) for name in names)])
    which = np.repeat(of_use[np.cumsum(is_use)[is_face]], corners.counts)
    uv = _texture_coordinates(lines) if corners.texture is not None else None
    colors = np.full((count, 3), NO_COLOR, dtype=np.uint8)
    found = len(materials) > 1  # one colour all over tells nothing
    for place, material in enumerate(materials.values()):
        chosen = which == place
        vertex = corners.vertex[chosen]
        if material.picture is not None and uv is not None and corners.texture is not None:
            texture = np.clip(corners.texture[chosen], 0, len(uv) - 1)
            colors[vertex], found = sampled(material.picture, uv)[texture], True
        elif material.color is not None:
            colors[vertex] = material.color
    return (colors if found else None), notes


def _texture_coordinates(lines: Lines) -> FloatArray | None:
    """Return all texture coordinates (n, 2); None where there are none."""
    is_coordinate = lines.begin_with(b"vt")
    if not is_coordinate.any():
        return None
    coordinates = _rows(lines.joined(is_coordinate), int(is_coordinate.sum()), b"vt")
    return coordinates[:, :2] if coordinates.shape[1] >= 2 else None


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write the parts as shells of one mesh."""
    write_obj(solid.merged, path, solid.note)


def write_obj(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as OBJ, atomically.

    Colours follow the coordinates of their vertex, a common extension.

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
    numbers, form = mesh.vertices, "v %.5f %.5f %.5f\n"
    if mesh.colors is not None:
        numbers = np.concatenate([numbers, mesh.colors / 255], axis=1)
        form = "v %.5f %.5f %.5f %.4f %.4f %.4f\n"
    vertices = written_rows(form, numbers)
    triangles = written_rows("f %d %d %d\n", mesh.triangles + 1)
    comment = f"# {note}\n" if note else ""
    with replacing_file(path) as beside, beside.open("w", encoding="utf-8", newline="\n") as file:
        file.write(f"# Insole Studio, unit mm\n{comment}{vertices}{triangles}")
