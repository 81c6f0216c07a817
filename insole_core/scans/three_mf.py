"""Read 3MF files: the objects of the build, moved to their places (core specification 1.3)."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final
from xml.parsers import expat

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.messages import Message
from insole_core.scans.raw_surface import RawSurface, placed
from insole_core.scans.scan_content import MOST_BYTES, ScanContent
from insole_core.scans.units import Unit
from insole_core.zip_archive import ZipArchive

_UNITS: Final[dict[str, tuple[Unit, float]]] = {
    "millimeter": ("mm", 1.0), "centimeter": ("cm", 1.0), "meter": ("m", 1.0),
    "inch": ("inch", 1.0), "foot": ("inch", 12.0), "micron": ("mm", 0.001),
}  # fmt: skip
_MOST_DEPTH, _MOST_PARTS = 64, 10_000
_SEPARATOR: Final = "\n"


@dataclass(eq=False)
class _Object:
    vertices: array[float] = field(default_factory=lambda: array("d"))
    triangles: array[int] = field(default_factory=lambda: array("q"))
    components: list[tuple[str, FloatArray]] = field(default_factory=list)


def read_three_mf(source: ScanContent) -> RawSurface:
    """Read all objects of the build.

    Raises
    ------
    InputError
        When the archive is damaged, encrypted or unfolds to far more than a scan.
    ValueError, LookupError, expat.ExpatError
        When its model is damaged.
    """
    archive = ZipArchive(str(source.path), source.content)
    names = [name for name in archive.names if name.lower().endswith(".model")]
    if not names:
        raise ValueError(Message("it holds no model"))
    model = _Model()
    rest = MOST_BYTES
    for name in sorted(names, key=lambda name: name.lower() != "3d/3dmodel.model"):
        content = archive.read(name, rest)
        rest -= len(content)
        model.read(content, "/" + name.lstrip("/"), source)
    return model.surface()


class _Model:
    """The objects and the build of one or several parts of a 3MF."""

    def __init__(self) -> None:
        self._objects: dict[str, _Object] = {}
        self._build: list[tuple[str, FloatArray]] = []
        self._unit: Unit = "mm"
        self._factor = 1.0
        self._part = ""
        self._current = _Object()
        self._starts: dict[str, Callable[[dict[str, str]], None]] = {
            "model": self._start_model,
            "object": self._start_object,
            "vertex": self._start_vertex,
            "triangle": self._start_triangle,
            "component": self._start_component,
            "item": self._start_item,
        }

    def read(self, content: bytes, part: str, source: ScanContent) -> None:
        """Add what one part holds; `part` is its name."""
        self._part = part
        parser = expat.ParserCreate(namespace_separator=_SEPARATOR)

        def start(name: str, attributes: dict[str, str]) -> None:
            handler = self._starts.get(name.rpartition(_SEPARATOR)[2])
            if handler is not None:
                handler(attributes)

        def refuse(*_: object) -> None:  # entities could unfold without end; no 3MF has any
            raise InputError(
                "{path} declares entities in its model, which no scan does; do not use it.",
                path=source.path,
            )

        parser.StartElementHandler = start
        parser.StartDoctypeDeclHandler = refuse
        parser.Parse(content, True)

    def surface(self) -> RawSurface:
        """Join the objects of the build."""
        vertices: list[FloatArray] = []
        triangles: list[IntArray] = []
        waiting = [(name, place, 0) for name, place in self._build]
        start = visited = 0
        while waiting:
            name, object2model, depth = waiting.pop()
            visited += 1
            if depth > _MOST_DEPTH or visited > _MOST_PARTS:
                raise ValueError(Message("its objects contain each other, or are far too many"))
            thing = self._objects[name]
            points = np.frombuffer(thing.vertices or array("d"), float).reshape(-1, 3)
            corners = np.frombuffer(thing.triangles or array("q"), np.int64).reshape(-1, 3)
            if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
                raise ValueError(Message("a triangle in it names a corner that it does not hold"))
            if np.linalg.det(object2model[:3, :3]) < 0:
                corners = corners[:, ::-1]
            vertices.append(placed(points, object2model))
            triangles.append(corners + start)
            start += len(points)
            waiting += [(part, object2model @ place, depth + 1) for part, place in thing.components]
        if not triangles:
            raise ValueError(Message("it holds no object that is to be built"))
        return RawSurface(
            np.concatenate(vertices) * self._factor,
            np.concatenate(triangles).astype(np.int32),
            unit=self._unit,
        )

    def _start_model(self, attributes: dict[str, str]) -> None:
        unit = attributes.get("unit", "millimeter")
        if unit not in _UNITS:
            raise ValueError(Message("its unit {unit} is none of 3MF", unit=unit[:20]))
        self._unit, self._factor = _UNITS[unit]

    def _start_object(self, attributes: dict[str, str]) -> None:
        self._current = self._objects.setdefault(self._part + "#" + attributes["id"], _Object())

    def _start_vertex(self, attributes: dict[str, str]) -> None:
        self._current.vertices.extend(
            (float(attributes["x"]), float(attributes["y"]), float(attributes["z"]))
        )

    def _start_triangle(self, attributes: dict[str, str]) -> None:
        self._current.triangles.extend(
            (int(attributes["v1"]), int(attributes["v2"]), int(attributes["v3"]))
        )

    def _start_component(self, attributes: dict[str, str]) -> None:
        self._current.components.append(self._reference(attributes))

    def _start_item(self, attributes: dict[str, str]) -> None:
        self._build.append(self._reference(attributes))

    def _reference(self, attributes: dict[str, str]) -> tuple[str, FloatArray]:
        """Return the object that is meant, in this or another part, and its place (4, 4)."""
        paths = [value for key, value in attributes.items() if key.endswith(_SEPARATOR + "path")]
        place = np.eye(4)
        if "transform" in attributes:
            numbers = np.array(attributes["transform"].split(), dtype=float)
            if numbers.shape != (12,) or not np.isfinite(numbers).all():
                raise ValueError(Message("the place of an object in it is no number"))
            place[:3] = numbers.reshape(4, 3).T
        part = "/" + paths[0].lstrip("/") if paths else self._part
        return part + "#" + attributes["objectid"], place
