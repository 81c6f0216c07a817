"""Binary STL, millimetres."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh

_HEADER = b"Insole Studio, unit mm"  # must not begin with "solid", which would mark ASCII
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(mesh: TriangleMesh, path: Path) -> None:
    """Write a mesh as binary STL; the file appears as a whole or not at all.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    facets = np.zeros(len(mesh.triangles), _FACET)
    facets["normal"] = mesh.triangle_normals
    facets["corners"] = mesh.vertices.astype(np.float32)[mesh.triangles]
    with replacing_file(path) as beside, beside.open("wb") as file:
        file.write(_HEADER.ljust(80))
        file.write(np.uint32(len(facets)).astype("<u4").tobytes())
        file.write(facets.tobytes())
