"""Wavefront OBJ, mm."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from insole_core.export.atomic import replacing_file
from insole_core.geometry.mesh import TriangleMesh


def write_obj(mesh: TriangleMesh, path: Path, note: str = "") -> None:
    """Write a mesh as OBJ, atomically.

    Colours follow the coordinates of their vertex, a common extension.

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
    numbers, form = mesh.vertices, "v %.5f %.5f %.5f\n"
    if mesh.colors is not None:
        numbers = np.concatenate([numbers, mesh.colors / 255], axis=1)
        form = "v %.5f %.5f %.5f %.4f %.4f %.4f\n"
    vertices = form * len(numbers) % tuple(numbers.ravel().tolist())
    corners = (mesh.triangles + 1).ravel().tolist()
    triangles = "f %d %d %d\n" * len(mesh.triangles) % tuple(corners)
    comment = f"# {note}\n" if note else ""
    with replacing_file(path) as beside, beside.open("w", encoding="utf-8", newline="\n") as file:
        file.write(f"# Insole Studio, unit mm\n{comment}{vertices}{triangles}")
