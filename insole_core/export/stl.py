"""STL, mm: binary, and ASCII for machines that read nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import TypeAlias

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.arrays import Float32Array
from insole_core.geometry.mesh import TriangleMesh

_HEADER = "Insole Studio, unit mm"  # must not begin with "solid", which would mark ASCII
_HEADER_BYTES = 80
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_ASCII_FACET = (
    " facet normal %.6g %.6g %.6g\n  outer loop\n"
    + 3 * "   vertex %.9g %.9g %.9g\n"
    + "  endloop\n endfacet\n"
)

_Columns: TypeAlias = list[Float32Array]


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
        file.write(header[:_HEADER_BYTES].ljust(_HEADER_BYTES))
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
    text = _ASCII_FACET * len(facets) % tuple(numbers.ravel().tolist())
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
