"""STL, millimetres: binary, and ASCII for machines that read nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh

_HEADER = b"Insole Studio, unit mm"  # must not begin with "solid", which would mark ASCII
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_ASCII_FACET = (
    " facet normal %.6g %.6g %.6g\n  outer loop\n"
    + 3 * "   vertex %.9g %.9g %.9g\n"
    + "  endloop\n endfacet\n"
)


def write_stl(mesh: TriangleMesh, path: Path) -> None:
    """Write a mesh as binary STL; the file appears as a whole or not at all.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    facets = _facets(mesh)
    with replacing_file(path) as beside, beside.open("wb") as file:
        file.write(_HEADER.ljust(80))
        file.write(np.uint32(len(facets)).astype("<u4").tobytes())
        file.write(facets.data)


def write_ascii_stl(mesh: TriangleMesh, path: Path) -> None:
    """Write a mesh as ASCII STL, with digits enough to read the same numbers back.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    facets = _facets(mesh)
    numbers = np.concatenate([facets["normal"], facets["corners"].reshape(-1, 9)], axis=1)
    text = _ASCII_FACET * len(facets) % tuple(numbers.ravel().tolist())
    with replacing_file(path) as beside, beside.open("w", encoding="ascii", newline="\n") as file:
        file.write(f"solid insole_mm\n{text}endsolid insole_mm\n")


def _facets(mesh: TriangleMesh) -> np.ndarray[tuple[int], np.dtype[np.void]]:
    """Corners and normals of every triangle, single precision.

    The normals are those of the rounded corners, so that a reader finds them consistent.
    """
    facets = np.zeros(len(mesh.triangles), _FACET)
    vertices = mesh.vertices.astype(np.float32)
    a, b, c = (vertices[mesh.triangles[:, corner]] for corner in range(3))
    facets["corners"][:, 0], facets["corners"][:, 1], facets["corners"][:, 2] = a, b, c
    b -= a
    c -= a
    normal = facets["normal"]
    for axis in range(3):
        y, z = (axis + 1) % 3, (axis + 2) % 3
        normal[:, axis] = b[:, y] * c[:, z] - b[:, z] * c[:, y]
    length = np.sqrt(np.einsum("ij,ij->i", normal, normal))
    normal /= np.where(length > 0, length, 1)[:, None]
    return facets
