"""Binary PLY: triangles with a colour for every vertex."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh

_VERTEX = [("position", "<f4", 3)]
_COLOR = [("color", "u1", 3)]
_TRIANGLE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def write_ply(mesh: TriangleMesh, path: Path) -> None:
    """Write a mesh, mm, as little-endian binary PLY.

    Raises
    ------
    OutputError
        When the place cannot be written; what stood there before is untouched.
    """
    colors = mesh.colors
    vertices = np.empty(len(mesh.vertices), _VERTEX + (_COLOR if colors is not None else []))
    vertices["position"] = mesh.vertices
    if colors is not None:
        vertices["color"] = colors
    triangles = np.empty(len(mesh.triangles), _TRIANGLE)
    triangles["count"] = 3
    triangles["corners"] = mesh.triangles
    with replacing_file(path) as beside, beside.open("wb") as file:
        file.write(_header(len(vertices), len(triangles), colors is not None))
        file.write(vertices.tobytes())
        file.write(triangles.tobytes())


def _header(vertices: int, triangles: int, colored: bool) -> bytes:
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        "comment Insole Studio, unit mm",
        f"element vertex {vertices}",
        *(f"property float {axis}" for axis in "xyz"),
        *(f"property uchar {name}" for name in ("red", "green", "blue") if colored),
        f"element face {triangles}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    return ("\n".join(lines) + "\n").encode("ascii")
