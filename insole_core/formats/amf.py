"""AMF, a format of 3-D printing (ISO/ASTM 52915): unit, names, colours, and bodies of an object.

A file is XML, or a zip archive of one. It is written as plain XML, which more programs read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape

import numpy as np
import scipy

from insole_core.files.atomic import replacing_file
from insole_core.formats.bounded_xml import walk_xml
from insole_core.formats.number_text import written_rows
from insole_core.formats.raw_surface import Assembly, RawSurface, join_objects
from insole_core.formats.scan_content import MOST_BYTES, ScanContent
from insole_core.formats.solid_content import SolidContent, SolidPart, assemblies, merged
from insole_core.formats.units import Unit
from insole_core.geometry.arrays import FloatArray
from insole_core.messages import Message
from insole_core.zip_archive import ZipArchive

_UNITS: Final[dict[str, tuple[Unit, float]]] = {
    "millimeter": ("mm", 1.0), "meter": ("m", 1.0), "inch": ("inch", 1.0), "feet": ("inch", 12.0),
    "micron": ("mm", 0.001),
}  # fmt: skip
_AXES: Final = ("x", "y", "z")
_CORNERS: Final = ("v1", "v2", "v3")
_MOVES: Final = ("deltax", "deltay", "deltaz")
_TURNS: Final = ("rx", "ry", "rz")
_CONSTELLATION: Final = "constellation "  # some programs number them as they do objects
_NUMBERS: Final = frozenset((*_AXES, *_CORNERS, *_MOVES, *_TURNS))


def read_amf(source: ScanContent) -> RawSurface:
    """Read all objects, moved to the places that a constellation gives them.

    Raises
    ------
    InputError
        When its archive is damaged or unfolds to far more than a scan, or it declares entities.
    ValueError, LookupError, expat.ExpatError
        When it is damaged.
    """
    model = _Model()
    walk_xml(_xml(source), source, model.start, model.end, model.text)
    return model.surface()


def _xml(source: ScanContent) -> bytes:
    if not source.content.startswith(b"PK"):
        return source.content
    archive = ZipArchive(str(source.path), source.content)
    names = [name for name in archive.names if name.lower().endswith(".amf")]
    if len(names) != 1:
        raise ValueError(Message("it holds no model, or several"))
    return archive.read(names[0], MOST_BYTES)


class _Model:
    """The objects and places of an AMF, as its elements come."""

    def __init__(self) -> None:
        self._objects: dict[str, Assembly] = {}
        self._unit, self._factor = _UNITS["millimeter"]
        self._current = Assembly()
        self._instance = ""
        self._numbers: dict[str, str] = {}
        self._number: list[str] | None = None

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Take the start of an element."""
        self._number = [] if name in _NUMBERS else None
        if name == "amf":
            unit = attributes.get("unit", "millimeter").lower()
            if unit not in _UNITS:
                raise ValueError(Message("its unit {unit} is none of AMF", unit=unit[:20]))
            self._unit, self._factor = _UNITS[unit]
        elif name == "object":
            self._current = self._objects.setdefault(attributes["id"], Assembly())
        elif name == "constellation":
            named = _CONSTELLATION + attributes.get("id", "")
            self._current = self._objects.setdefault(named, Assembly())
        elif name == "instance":
            self._instance = attributes["objectid"]
            self._numbers = dict.fromkeys((*_MOVES, *_TURNS), "0")

    def text(self, text: str) -> None:
        """Take a part of the text of an element."""
        if self._number is not None:
            self._number.append(text)

    def end(self, name: str) -> None:
        """Take the end of an element."""
        if name in _NUMBERS:
            self._numbers[name] = "".join(self._number or ())
        elif name == "coordinates":
            self._current.vertices.extend(float(self._numbers.pop(axis)) for axis in _AXES)
        elif name == "triangle":
            self._current.triangles.extend(int(self._numbers.pop(corner)) for corner in _CORNERS)
        elif name == "instance":
            self._current.parts.append((self._instance, _object2file(self._numbers)))
        self._number = None

    def surface(self) -> RawSurface:
        """Join the objects; those that no constellation places stay where they are."""
        for thing in self._objects.values():
            thing.parts = [(self._meant(name), place) for name, place in thing.parts]
        parts = {name for thing in self._objects.values() for name, _ in thing.parts}
        build = [(name, np.eye(4)) for name in self._objects if name not in parts]
        if not build:
            raise ValueError(Message("it holds no object"))
        vertices, triangles = join_objects(self._objects, build)
        return RawSurface(vertices * self._factor, triangles, unit=self._unit)

    def _meant(self, name: str) -> str:
        return name if name in self._objects else _CONSTELLATION + name


def _object2file(numbers: dict[str, str]) -> FloatArray:
    """Return the place (4, 4) of an instance: turned about x, y, then z, and moved."""
    angles = np.array([float(numbers[turn]) for turn in _TURNS])
    object2file = np.eye(4)
    object2file[:3, :3] = scipy.spatial.transform.Rotation.from_euler(
        "xyz", angles, degrees=True
    ).as_matrix()
    object2file[:3, 3] = [float(numbers[move]) for move in _MOVES]
    if not np.isfinite(object2file).all():
        raise ValueError(Message("the place of an object in it is no number"))
    return object2file


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write every assembly as an object, and its parts as bodies of it, atomically.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    with replacing_file(path) as beside, beside.open("w", encoding="utf-8", newline="\n") as file:
        file.writelines(_document(solid))


def _document(solid: SolidContent) -> Iterable[str]:
    yield '<?xml version="1.0" encoding="UTF-8"?>\n<amf unit="millimeter" version="1.1">\n'
    yield _name(solid.title)
    yield '<metadata type="cad">Insole Studio</metadata>\n'
    for number, part in enumerate(solid.parts, start=1):
        red, green, blue = (channel / 255 for channel in part.color)
        color = f"<r>{red:.4f}</r><g>{green:.4f}</g><b>{blue:.4f}</b>"
        yield f'<material id="{number}">{_name(part.name)}<color>{color}</color></material>\n'
    first = len(solid.parts) + 1  # numbers of materials and objects are apart
    for number, (name, members) in enumerate(_objects(solid.parts), start=first):
        yield f'<object id="{number}">\n{_name(name)}<mesh>\n'
        yield from _mesh([solid.parts[member] for member in members], members)
        yield "</mesh>\n</object>\n"
    yield "</amf>\n"


def _objects(parts: Sequence[SolidPart]) -> Iterator[tuple[str, list[int]]]:
    """Yield the name of each object and the numbers of its parts."""
    for number, part in enumerate(parts):
        if not part.assembly:
            yield part.name, [number]
    yield from assemblies(parts).items()


def _mesh(parts: Sequence[SolidPart], numbers: Sequence[int]) -> Iterator[str]:
    whole = merged([part.mesh for part in parts])
    yield "<vertices>\n"
    yield written_rows(
        "<vertex><coordinates><x>%.5f</x><y>%.5f</y><z>%.5f</z></coordinates></vertex>\n",
        whole.vertices,
    )
    yield "</vertices>\n"
    first = 0
    for number, part in zip(numbers, parts, strict=True):
        corners = whole.triangles[first : first + len(part.mesh.triangles)]
        first += len(corners)
        yield f'<volume materialid="{number + 1}">\n{_name(part.name)}'
        yield written_rows("<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>\n", corners)
        yield "</volume>\n"


def _name(text: str) -> str:
    return f'<metadata type="name">{escape(text)}</metadata>\n'
