"""3MF, the format of 3-D printing: unit, names, colours, and zones with individual density.

Core specification 1.3 (3MF Consortium): a zip with the model as XML. Of a file that is read, the
objects of the build are moved to their places. Of one that is written, every part is a separate
object with a base material; its density is in a metadata group that other programs ignore.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from insole_core.files.atomic import replacing_file
from insole_core.formats.bounded_xml import SEPARATOR, walk_xml
from insole_core.formats.number_text import written_rows
from insole_core.formats.raw_surface import Assembly, RawSurface, join_objects
from insole_core.formats.scan_content import MOST_BYTES, ScanContent
from insole_core.formats.solid_content import SolidContent, SolidPart, assemblies
from insole_core.formats.units import Unit
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message
from insole_core.zip_archive import ZipArchive

_UNITS: Final[dict[str, tuple[Unit, float]]] = {
    "millimeter": ("mm", 1.0), "centimeter": ("cm", 1.0), "meter": ("m", 1.0),
    "inch": ("inch", 1.0), "foot": ("inch", 12.0), "micron": ("mm", 0.001),
}  # fmt: skip
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
OWN = "urn:insole-studio:2026"
_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_CONTENT_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
    'relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.'
    '3dmanufacturing-3dmodel+xml"/>'
    '<Default Extension="config" ContentType="application/xml"/></Types>\n'
)
_RELATIONS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    f'<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="{_RELATION}"/></Relationships>\n'
)
_FAST = 1  # shrinks the XML to a tenth already; a higher level costs seconds


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
        self._objects: dict[str, Assembly] = {}
        self._build: list[tuple[str, FloatArray]] = []
        self._unit: Unit = "mm"
        self._factor = 1.0
        self._part = ""
        self._current = Assembly()
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
        walk_xml(content, source, self._start)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        handler = self._starts.get(name)
        if handler is not None:
            handler(attributes)

    def surface(self) -> RawSurface:
        """Join the objects of the build."""
        if not self._build:
            raise ValueError(Message("it holds no object that is to be built"))
        vertices, triangles = join_objects(self._objects, self._build)
        return RawSurface(vertices * self._factor, triangles, unit=self._unit)

    def _start_model(self, attributes: dict[str, str]) -> None:
        unit = attributes.get("unit", "millimeter")
        if unit not in _UNITS:
            raise ValueError(Message("its unit {unit} is none of 3MF", unit=unit[:20]))
        self._unit, self._factor = _UNITS[unit]

    def _start_object(self, attributes: dict[str, str]) -> None:
        self._current = self._objects.setdefault(self._part + "#" + attributes["id"], Assembly())

    def _start_vertex(self, attributes: dict[str, str]) -> None:
        self._current.vertices.extend(
            (float(attributes["x"]), float(attributes["y"]), float(attributes["z"]))
        )

    def _start_triangle(self, attributes: dict[str, str]) -> None:
        self._current.triangles.extend(
            (int(attributes["v1"]), int(attributes["v2"]), int(attributes["v3"]))
        )

    def _start_component(self, attributes: dict[str, str]) -> None:
        self._current.parts.append(self._reference(attributes))

    def _start_item(self, attributes: dict[str, str]) -> None:
        self._build.append(self._reference(attributes))

    def _reference(self, attributes: dict[str, str]) -> tuple[str, FloatArray]:
        """Return the object that is meant, in this or another part, and its place (4, 4)."""
        paths = [value for key, value in attributes.items() if key.endswith(SEPARATOR + "path")]
        place = np.eye(4)
        if "transform" in attributes:
            numbers = np.array(attributes["transform"].split(), dtype=float)
            if numbers.shape != (12,) or not np.isfinite(numbers).all():
                raise ValueError(Message("the place of an object in it is no number"))
            place[:3] = numbers.reshape(4, 3).T
        part = "/" + paths[0].lstrip("/") if paths else self._part
        return part + "#" + attributes["objectid"], place


def write_parts(solid: SolidContent, path: Path) -> None:
    """Write every part as an object of its own."""
    write_3mf(solid.parts, path, solid.title)


def write_3mf(parts: Sequence[SolidPart], path: Path, title: str = "Insole") -> None:
    """Write parts as separate objects in their common frame, atomically.

    Parameters
    ----------
    title
        Metadata of the model.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    write_package(path, _model(parts, title), {})


def write_package(path: Path, model: Iterable[str], settings: Mapping[str, str]) -> None:
    """Write the model, what leads a reader to it, and texts by their place in the archive."""
    with (
        replacing_file(path) as beside,
        zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED, compresslevel=_FAST) as archive,
    ):
        archive.writestr("[Content_Types].xml", _CONTENT_TYPES)
        archive.writestr("_rels/.rels", _RELATIONS)
        archive.writestr("3D/3dmodel.model", "".join(model))
        for name, text in settings.items():
            archive.writestr(name, text)


def model_head(
    title: str, namespaces: Mapping[str, str], metadata: Mapping[str, str]
) -> Iterable[str]:
    """Yield the start of a model: unit, namespaces by prefix, and metadata by name."""
    spaces = "".join(f' xmlns:{prefix}="{uri}"' for prefix, uri in namespaces.items())
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}"{spaces}>\n'
    )
    for name, value in {"Title": title, "Application": "Insole Studio", **metadata}.items():
        yield f'<metadata name="{name}">{escape(value)}</metadata>\n'


def build_xml(items: Iterable[int]) -> Iterable[str]:
    """Yield the end of a model: the objects that are made."""
    yield "<build>\n"
    for item in items:
        yield f'<item objectid="{item}"/>\n'
    yield "</build>\n</model>\n"


def _model(parts: Sequence[SolidPart], title: str) -> Iterable[str]:
    yield from model_head(title, {"insole": OWN}, {})
    yield '<resources>\n<basematerials id="1">\n'
    for part in parts:
        color = "".join(f"{channel:02X}" for channel in part.color)
        yield f'<base name={quoteattr(part.name)} displaycolor="#{color}"/>\n'
    yield "</basematerials>\n"
    for number, part in enumerate(parts):
        yield from _object(part, number)
    items = [number + 2 for number, part in enumerate(parts) if not part.assembly]
    for name, members in assemblies(parts).items():
        items.append(len(parts) + 2 + len(items))
        yield from assembly_xml(name, items[-1], [number + 2 for number in members])
    yield "</resources>\n"
    yield from build_xml(items)


def assembly_xml(name: str, number: int, members: Sequence[int]) -> Iterable[str]:
    """Yield an object of that id made of other objects."""
    yield f'<object id="{number}" name={quoteattr(name)} type="model">\n<components>\n'
    for member in members:
        yield f'<component objectid="{member}"/>\n'
    yield "</components>\n</object>\n"


def _object(part: SolidPart, number: int) -> Iterable[str]:
    density = ""
    if part.density_percent is not None:
        density = (
            '<metadatagroup><metadata name="insole:density_percent" type="xs:decimal"'
            f' preserve="1">{part.density_percent:g}</metadata></metadatagroup>\n'
        )
    material = f' pid="1" pindex="{number}"'
    yield from object_xml(part.mesh, part.name, number + 2, density, material)


def object_xml(
    mesh: TriangleMesh, name: str, number: int, metadata: str = "", attributes: str = ""
) -> Iterable[str]:
    """Yield an object of that id with its mesh.

    Parameters
    ----------
    metadata
        A group of metadata as XML.
    attributes
        More attributes of the object as XML.
    """
    yield f'<object id="{number}" name={quoteattr(name)} type="model"{attributes}>\n{metadata}'
    yield "<mesh>\n<vertices>\n"
    yield written_rows('<vertex x="%.5f" y="%.5f" z="%.5f"/>\n', mesh.vertices)
    yield "</vertices>\n<triangles>\n"
    yield written_rows('<triangle v1="%d" v2="%d" v3="%d"/>\n', mesh.triangles)
    yield "</triangles>\n</mesh>\n</object>\n"
