"""What a file for a shop holds, and its writing in the format that the file's name selects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.formats.file_formats import check_solid_suffix, mesh_format
from insole_core.geometry.mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class SolidPart:
    """One body of a file.

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


@dataclass(frozen=True, eq=False)
class SolidContent:
    """The parts of one file, and what it says of itself.

    Parameters
    ----------
    parts : mm
        In a common frame.
    label
        Identifies the order, in formats that have a place for it.
    note
        ASCII, one line: what the files without a label have to say as well.
    """

    parts: Sequence[SolidPart]
    label: str = ""
    note: str = ""

    @property
    def title(self) -> str:
        """What a format with a title calls the file."""
        return " ".join(filter(None, ("Insole", self.label)))

    @property
    def merged(self) -> TriangleMesh:
        """The parts as shells of one mesh, for formats that keep no bodies apart."""
        return merged([part.mesh for part in self.parts])

    @property
    def painted(self) -> TriangleMesh:
        """The same in the colours of the parts, where a mesh has none of its own."""
        return merged([_painted(part) for part in self.parts])


def assemblies(parts: Sequence[SolidPart]) -> dict[str, list[int]]:
    """Return the numbers of the parts, from 0, of every assembly by its name."""
    found: dict[str, list[int]] = {}
    for number, part in enumerate(parts):
        if part.assembly:
            found.setdefault(part.assembly, []).append(number)
    return found


def _painted(part: SolidPart) -> TriangleMesh:
    if part.mesh.colors is not None:
        return part.mesh
    return replace(part.mesh, colors=np.full(part.mesh.vertices.shape, part.color, np.uint8))


def merged(meshes: Sequence[TriangleMesh]) -> TriangleMesh:
    """Concatenate meshes into one; colours are kept where all of them have colours."""
    if len(meshes) == 1:
        return meshes[0]
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    colors = [mesh.colors for mesh in meshes if mesh.colors is not None]
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(
            [mesh.triangles + np.int32(at) for mesh, at in zip(meshes, first, strict=True)]
        ),
        np.concatenate(colors) if len(colors) == len(meshes) else None,
    )


def write_solids(
    parts: Sequence[SolidPart],
    path: Path,
    *,
    as_text: bool = False,
    label: str = "",
    note: str = "",
) -> None:
    """Write parts in the format that the suffix of `path` selects.

    Formats that carry bodies keep the parts separate; in others they are shells of one mesh.

    Parameters
    ----------
    parts : mm
        In a common frame.
    as_text
        Whether STL is written in text.
    label, note
        As for `SolidContent`.

    Raises
    ------
    UsageError
        When the format is not known.
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    check_solid_suffix(path)
    content = SolidContent(parts, label, note)
    mesh_format(path.suffix.lower()).write(content, path, as_text=as_text)
