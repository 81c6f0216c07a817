"""Writing of solids in the format that the suffix of the file name selects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from insole_core.errors import UsageError
from insole_core.export.obj import write_obj
from insole_core.export.ply import write_ply
from insole_core.export.stl import write_ascii_stl, write_stl
from insole_core.export.three_mf import ThreeMfPart, write_3mf
from insole_core.geometry.mesh import TriangleMesh

SUFFIXES = (".stl", ".3mf", ".ply", ".obj")


def check_suffix(path: Path, what: str = "the insole") -> None:
    """Check that the suffix of a name is a format of solids.

    Parameters
    ----------
    what
        The object in the message.

    Raises
    ------
    UsageError
        When it is not.
    """
    if path.suffix.lower() not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise UsageError(
            "{path} names no format that {what} is written as; choose {formats}.",
            path=path,
            what=what,
            formats=known,
        )


def write_solids(
    parts: Sequence[ThreeMfPart],
    path: Path,
    *,
    ascii_stl: bool = False,
    label: str = "",
    note: str = "",
) -> None:
    """Write parts in the format that the suffix of `path` selects.

    3MF keeps the parts separate; in the other formats they are shells of one mesh. PLY has colours.

    Parameters
    ----------
    parts : mm
        In a common frame.
    path
        With one of `SUFFIXES`.
    ascii_stl
        Whether STL is written as ASCII.
    label
        Identifies the order, in the header of a binary STL and the title of a 3MF.
    note
        ASCII, one line: what the files without a label have to say as well.

    Raises
    ------
    UsageError
        When the format is not known.
    OutputError
        When the place cannot be written; a file that was there before is untouched.
    """
    check_suffix(path)
    kind = path.suffix.lower()
    if kind == ".3mf":
        write_3mf(parts, path, " ".join(filter(None, ("Insole", label))))
        return
    mesh = merged([part.mesh for part in parts])
    if kind == ".stl":
        if ascii_stl:
            write_ascii_stl(mesh, path, note)
        else:
            write_stl(mesh, path, label)
    elif kind == ".obj":
        write_obj(mesh, path, note)
    else:
        write_ply(merged([_painted(part) for part in parts]), path, note)


def _painted(part: ThreeMfPart) -> TriangleMesh:
    """Return the surface of a part, in the colour of the part where it has none of its own."""
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
