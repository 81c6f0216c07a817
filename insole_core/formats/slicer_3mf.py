"""3MF with print settings and modifier volumes, as a certain slicer reads them.

There is no common way to say "this zone at 15 %": every slicer has its own, and ignores the others.

Sources: PrusaSlicer, src/libslic3r/Format/3mf.cpp; OrcaSlicer and Bambu Studio,
src/libslic3r/Format/bbs_3mf.cpp; Cura, libSavitar/src/SceneNode.cpp and plugins/3MFReader.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias, get_args
from xml.sax.saxutils import quoteattr

from insole_core.formats.scan_content import MOST_BYTES
from insole_core.formats.solid_content import merged
from insole_core.formats.three_mf import (
    assembly_xml,
    build_xml,
    model_head,
    object_xml,
    write_package,
)
from insole_core.geometry.mesh import TriangleMesh
from insole_core.zip_archive import ZipArchive

Printer: TypeAlias = Literal["prusaslicer", "orca", "cura"]
PRINTERS: tuple[Printer, ...] = get_args(Printer)
PRINTER_NAMES: dict[Printer, str] = {
    "prusaslicer": "PrusaSlicer",
    "orca": "OrcaSlicer, Bambu Studio",
    "cura": "Cura",
}
"""What users call the programs."""
Pattern: TypeAlias = Literal["gyroid", "grid", "honeycomb", "cubic", "rectilinear", "concentric"]
PATTERNS: tuple[Pattern, ...] = get_args(Pattern)

_CURA = "http://software.ultimaker.com/xml/cura/3mf/2015/10"
_PRUSA = "http://schemas.slic3r.org/3mf/2017/06"
_PRUSA_SETTINGS = "Metadata/Slic3r_PE_model.config"
_ORCA_SETTINGS = "Metadata/model_settings.config"
_CURA_PATTERNS: dict[Pattern, str] = {
    "gyroid": "gyroid",
    "grid": "grid",
    "cubic": "cubic",
    "rectilinear": "lines",
    "concentric": "concentric",
}


@dataclass(frozen=True)
class Infill:
    """Density and pattern of the inside; at 100 % every slicer fills with straight lines."""

    density_percent: float
    pattern: Pattern = "gyroid"

    @property
    def used_pattern(self) -> Pattern:
        """The pattern that a slicer accepts with this density."""
        return "rectilinear" if self.density_percent >= 100 else self.pattern


@dataclass(frozen=True, eq=False)
class Modifier:
    """A closed body in which a part has another infill.

    Parameters
    ----------
    mesh : mm
        In the frame of the file; reaches over the part's surface.
    name
        Tells the density, too, for programs that ignore the rest.
    is_strip
        Whether it is only a step between two zones.
    """

    mesh: TriangleMesh
    name: str
    infill: Infill
    is_strip: bool = False


@dataclass(frozen=True, eq=False)
class PrintedPart:
    """One object of the print: its body, its settings, and the zones of other density.

    Parameters
    ----------
    mesh : mm
        Closed, on z = 0 of the file.
    walls, top_layers, bottom_layers
        Numbers of lines and layers of the shell.
    infill
        Outside the zones.
    modifiers
        Where two overlap, the later one is obeyed.
    """

    mesh: TriangleMesh
    name: str
    walls: int
    top_layers: int
    bottom_layers: int
    infill: Infill
    modifiers: tuple[Modifier, ...] = ()


def can_print(printer: Printer, pattern: Pattern) -> bool:
    """Return whether a slicer has a pattern."""
    return printer != "cura" or pattern in _CURA_PATTERNS


def write_slicer_3mf(
    parts: Sequence[PrintedPart], path: Path, printer: Printer, title: str = "Insole"
) -> None:
    """Write parts with their zones as a slicer reads them, atomically.

    Raises
    ------
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    write_package(path, *_WRITERS[printer](parts, title))


def is_for_slicer(archive: ZipArchive) -> bool:
    """Return whether a 3MF has the settings of a slicer: some of its bodies may then be zones.

    Raises
    ------
    InputError
        When its model is damaged.
    """
    if not {_PRUSA_SETTINGS, _ORCA_SETTINGS}.isdisjoint(archive.names):
        return True
    models = (name for name in archive.names if name.lower().endswith(".model"))
    return any(_CURA.encode() in archive.read(name, MOST_BYTES) for name in models)


_Files: TypeAlias = tuple[Iterable[str], Mapping[str, str]]
"""The model, and the files of settings by their place in the archive."""


def _prusaslicer(parts: Sequence[PrintedPart], title: str) -> _Files:
    """One mesh of all volumes for each part; the settings say which triangles are which volume."""
    model = [
        *model_head(title, {"slic3rpe": _PRUSA}, {"slic3rpe:Version3mf": "1"}),
        "<resources>\n",
    ]
    config = ['<?xml version="1.0" encoding="UTF-8"?>\n<config>\n']
    for number, part in enumerate(parts, start=1):
        bodies = (part.mesh, *(zone.mesh for zone in part.modifiers))
        model += object_xml(merged(bodies), part.name, number)
        config += [
            f'<object id="{number}">\n',
            *_prusa_settings("object", {"name": part.name, **_prusa_part(part)}),
        ]
        first = 0
        for body, zone in zip(bodies, (None, *part.modifiers), strict=True):
            last = first + len(body.triangles) - 1
            kind = "ModelPart" if zone is None else "ParameterModifier"
            settings = {"name": part.name if zone is None else zone.name, "volume_type": kind}
            config += [
                f'<volume firstid="{first}" lastid="{last}">\n',
                *_prusa_settings("volume", settings | ({} if zone is None else _prusa(zone))),
                "</volume>\n",
            ]
            first = last + 1
        config.append("</object>\n")
    model += ["</resources>\n", *build_xml(range(1, len(parts) + 1))]
    config.append("</config>\n")
    return model, {_PRUSA_SETTINGS: "".join(config)}


def _prusa_settings(kind: str, settings: Mapping[str, str]) -> Iterable[str]:
    for key, value in settings.items():
        yield f'<metadata type="{kind}" key="{key}" value={quoteattr(value)}/>\n'


def _prusa_part(part: PrintedPart) -> dict[str, str]:
    return {
        "perimeters": str(part.walls),
        "top_solid_layers": str(part.top_layers),
        "bottom_solid_layers": str(part.bottom_layers),
        **_prusa(part),
    }


def _prusa(item: PrintedPart | Modifier) -> dict[str, str]:
    return {
        "fill_density": f"{item.infill.density_percent:g}%",
        "fill_pattern": item.infill.used_pattern,
    }


def _orca(parts: Sequence[PrintedPart], title: str) -> _Files:
    """A parent of components for each part; the settings name the components by their ids."""
    model, parents, members = _in_components(parts, title, {}, lambda _item, _order: "")
    config = ['<?xml version="1.0" encoding="UTF-8"?>\n<config>\n']
    for part, parent, ids in zip(parts, parents, members, strict=True):
        settings = {
            "name": part.name,
            "wall_loops": str(part.walls),
            "top_shell_layers": str(part.top_layers),
            "bottom_shell_layers": str(part.bottom_layers),
            **_sparse(part),
        }
        config += [f'<object id="{parent}">\n', *_orca_settings(settings)]
        for number, zone in zip(ids, (None, *part.modifiers), strict=True):
            kind = "normal_part" if zone is None else "modifier_part"
            own = {"name": part.name} if zone is None else {"name": zone.name, **_sparse(zone)}
            config += [
                f'<part id="{number}" subtype="{kind}">\n',
                *_orca_settings(own),
                "</part>\n",
            ]
        config.append("</object>\n")
    config.append("</config>\n")
    return model, {_ORCA_SETTINGS: "".join(config)}


def _orca_settings(settings: Mapping[str, str]) -> Iterable[str]:
    for key, value in settings.items():
        yield f'<metadata key="{key}" value={quoteattr(value)}/>\n'


def _sparse(item: PrintedPart | Modifier) -> dict[str, str]:
    return {
        "sparse_infill_density": f"{item.infill.density_percent:g}%",
        "sparse_infill_pattern": item.infill.used_pattern,
    }


def _cura(parts: Sequence[PrintedPart], title: str) -> _Files:
    """A group of bodies for each part; each has its settings in the model itself.

    They are a group so that Cura does not place every body on the plate by itself.
    """
    return _in_components(parts, title, {"cura": _CURA}, _cura_settings)[0], {}


def _cura_settings(item: PrintedPart | Modifier, order: int) -> str:
    settings = {
        "infill_sparse_density": f"{item.infill.density_percent:g}",
        "infill_pattern": _CURA_PATTERNS[item.infill.used_pattern],
    }
    if isinstance(item, PrintedPart):
        walls, top, bottom = item.walls, item.top_layers, item.bottom_layers
    else:
        walls = top = bottom = 0
        settings |= {
            "infill_mesh": "True",
            "infill_mesh_order": str(order),
            "drop_to_buildplate": "False",
        }
    settings |= {
        "wall_line_count": str(walls),
        "top_layers": str(top),
        "bottom_layers": str(bottom),
    }
    lines = (
        f'<metadata name="cura:{key}" type="xs:string" preserve="1">{value}</metadata>\n'
        for key, value in settings.items()
    )
    return f"<metadatagroup>\n{''.join(lines)}</metadatagroup>\n"


def _in_components(
    parts: Sequence[PrintedPart],
    title: str,
    namespaces: Mapping[str, str],
    settings_of: Callable[[PrintedPart | Modifier, int], str],
) -> tuple[list[str], list[int], list[list[int]]]:
    """Return a model of one parent per part, the ids of the parents, and those of its bodies."""
    model = [*model_head(title, namespaces, {}), "<resources>\n"]
    parents: list[int] = []
    members: list[list[int]] = []
    number = 0
    for part in parts:
        ids = []
        bodies: tuple[PrintedPart | Modifier, ...] = (part, *part.modifiers)
        for order, body in enumerate(bodies):
            number += 1
            ids.append(number)
            model += object_xml(body.mesh, body.name, number, settings_of(body, order))
        number += 1
        model += assembly_xml(part.name, number, ids)
        parents.append(number)
        members.append(ids)
    model += ["</resources>\n", *build_xml(parents)]
    return model, parents, members


_WRITERS: dict[Printer, Callable[[Sequence[PrintedPart], str], _Files]] = {
    "prusaslicer": _prusaslicer,
    "orca": _orca,
    "cura": _cura,
}
