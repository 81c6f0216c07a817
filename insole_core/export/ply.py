"""Binary PLY, mm: triangles, optionally with a colour for every vertex."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.arrays import Float32Array
from insole_core.geometry.contour_constraints import PLY_ELEMENT
from insole_core.geometry.mesh import TriangleMesh

_VERTEX = [("position", "<f4", 3)]
_COLOR = [("color", "u1", 3)]
_TRIANGLE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def write_ply(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as little-endian binary PLY, atomically.

    Contour constraints become an element of their own.

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
    colors = mesh.colors
    vertices = np.empty(len(mesh.vertices), _VERTEX + (_COLOR if colors is not None else []))
    vertices["position"] = mesh.vertices
    if colors is not None:
        vertices["color"] = colors
    triangles = np.empty(len(mesh.triangles), _TRIANGLE)
    triangles["count"] = 3
    triangles["corners"] = mesh.triangles
    touches = _touches(mesh)
    with replacing_file(path) as beside, beside.open("wb") as file:
        colored = colors is not None
        file.write(_header(len(vertices), len(triangles), colored, len(touches), note))
        file.write(vertices.tobytes())
        file.write(triangles.tobytes())
        file.write(touches.tobytes())


def _touches(mesh: TriangleMesh) -> Float32Array:
    """Return points and normals (k, 6); other programs skip an element that they do not know."""
    if mesh.touches is None:
        return np.zeros((0, 6), np.float32)
    return np.hstack([mesh.touches.points, mesh.touches.normals]).astype("<f4")


def _header(vertices: int, triangles: int, colored: bool, touches: int, note: str) -> bytes:
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        "comment Insole Studio, unit mm",
        *([f"comment {note}"] if note else []),
        f"element vertex {vertices}",
        *(f"property float {axis}" for axis in "xyz"),
        *(f"property uchar {name}" for name in ("red", "green", "blue") if colored),
        f"element face {triangles}",
        "property list uchar int vertex_indices",
        *([f"element {PLY_ELEMENT} {touches}"] if touches else []),
        *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz") if touches),
        "end_header",
    ]
    return ("\n".join(lines) + "\n").encode("ascii")
