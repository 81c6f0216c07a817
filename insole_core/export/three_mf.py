"""3MF, the format of 3-D printing: unit, names, colours, and zones with individual density.

Core specification 1.3 (3MF Consortium): a zip with the model as XML. Every part is a separate
object with a base material; its density is in a metadata group that other programs ignore.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from insole_core.export.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
OWN = "urn:insole-studio:2026"
_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_CONTENT_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
    'relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.'
    '3dmanufacturing-3dmodel+xml"/></Types>\n'
)
_RELATIONS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    f'<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="{_RELATION}"/></Relationships>\n'
)
_FAST = 1  # shrinks the XML to a tenth already; a higher level costs seconds


@dataclass(frozen=True, eq=False)
class ThreeMfPart:
    """One object of a 3MF file.

    Parameters
    ----------
    mesh : mm
        Closed, facing outwards.
    name
        In any script.
    color : (red, green, blue), 0 to 255
    density_percent
        Infill density of the zone; None leaves it to the shop.
    assembly
        Name of the assembly that the part belongs to. Parts of one assembly, such as the layers of
        an insole, are printed as one object and keep their relative positions; empty for a part of
        its own.
    """

    mesh: TriangleMesh
    name: str
    color: tuple[int, int, int] = (214, 190, 160)
    density_percent: float | None = None
    assembly: str = ""


def write_3mf(parts: Sequence[ThreeMfPart], path: Path, title: str = "Insole") -> None:
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
    with (
        replacing_file(path) as beside,
        zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED, compresslevel=_FAST) as archive,
    ):
        write_package(archive, _model(parts, title))


def write_package(archive: zipfile.ZipFile, model: Iterable[str]) -> None:
    """Write the model and what leads a reader to it."""
    archive.writestr("[Content_Types].xml", _CONTENT_TYPES)
    archive.writestr("_rels/.rels", _RELATIONS)
    archive.writestr("3D/3dmodel.model", "".join(model))


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


def _model(parts: Sequence[ThreeMfPart], title: str) -> Iterable[str]:
    yield from model_head(title, {"insole": OWN}, {})
    yield '<resources>\n<basematerials id="1">\n'
    for part in parts:
        color = "".join(f"{channel:02X}" for channel in part.color)
        yield f'<base name={quoteattr(part.name)} displaycolor="#{color}"/>\n'
    yield "</basematerials>\n"
    for number, part in enumerate(parts):
        yield from _object(part, number)
    items = [number + 2 for number, part in enumerate(parts) if not part.assembly]
    for name in dict.fromkeys(part.assembly for part in parts if part.assembly):
        items.append(len(parts) + 2 + len(items))
        members = [n + 2 for n, part in enumerate(parts) if part.assembly == name]
        yield from assembly_xml(name, items[-1], members)
    yield "</resources>\n"
    yield from build_xml(items)


def assembly_xml(name: str, number: int, members: Sequence[int]) -> Iterable[str]:
    """Yield an object of that id made of other objects."""
    yield f'<object id="{number}" name={quoteattr(name)} type="model">\n<components>\n'
    for member in members:
        yield f'<component objectid="{member}"/>\n'
    yield "</components>\n</object>\n"


def _object(part: ThreeMfPart, number: int) -> Iterable[str]:
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
    coordinates = mesh.vertices.ravel().tolist()
    yield '<vertex x="%.5f" y="%.5f" z="%.5f"/>\n' * len(mesh.vertices) % tuple(coordinates)
    yield "</vertices>\n<triangles>\n"
    corners = mesh.triangles.ravel().tolist()
    yield '<triangle v1="%d" v2="%d" v3="%d"/>\n' * len(mesh.triangles) % tuple(corners)
    yield "</triangles>\n</mesh>\n</object>\n"
