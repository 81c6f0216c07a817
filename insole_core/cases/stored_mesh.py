"""The surface of a foot as arrays in a file (docs/formats/case.md)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import ContourConstraints, TriangleMesh
from insole_core.stored_arrays import pack_arrays, read_arrays

MAX_PART_BYTES = 256 * 2**20
"""The surface of a foot of four million triangles has 150 MB."""
_MOST_MM = 1e4


def pack_mesh(mesh: TriangleMesh) -> bytes:
    """Return a surface as the bytes of an ``.npz`` file; equal surfaces give equal bytes."""
    arrays: dict[str, npt.NDArray[Any]] = {"vertices": mesh.vertices, "triangles": mesh.triangles}
    if mesh.colors is not None:
        arrays["colors"] = mesh.colors
    if mesh.touches is not None:
        arrays |= {"touched": mesh.touches.points, "touched_normals": mesh.touches.normals}
    return pack_arrays(arrays)


def unpack_mesh(name: str, packed: bytes) -> TriangleMesh:
    """Read a surface, mm, insole frame; the inverse of `pack_mesh`.

    Parameters
    ----------
    name
        Of the file, for messages.

    Raises
    ------
    InputError
        When it is damaged.
    """
    try:
        arrays = read_arrays(name, packed, MAX_PART_BYTES)
        touches = None
        if "touched" in arrays:
            touches = ContourConstraints(arrays["touched"], arrays["touched_normals"])
        mesh = TriangleMesh(arrays["vertices"], arrays["triangles"], arrays.get("colors"), touches)
    except (InputError, KeyError) as error:
        raise _damaged(name) from error
    if not _is_sound(mesh):
        raise _damaged(name)
    return mesh


def _is_sound(mesh: TriangleMesh) -> bool:
    vertices, triangles, colors = mesh.vertices, mesh.triangles, mesh.colors
    kinds = vertices.dtype == np.float64 and triangles.dtype == np.int32
    shapes = vertices.ndim == triangles.ndim == 2 and vertices.shape[1] == triangles.shape[1] == 3
    if not (kinds and shapes and len(triangles) and _are_near(vertices)):
        return False
    if colors is not None and (colors.dtype != np.uint8 or colors.shape != vertices.shape):
        return False
    if mesh.touches is not None and not _are_sound(mesh.touches):
        return False
    return bool(triangles.min() >= 0 and triangles.max() < len(vertices))


def _are_sound(touches: ContourConstraints) -> bool:
    points, normals = touches.points, touches.normals
    shapes = points.ndim == 2 and points.shape[1] == 3 and points.shape == normals.shape
    kinds = points.dtype == normals.dtype == np.float64
    return bool(kinds and shapes and _are_near(points) and _are_near(normals))


def _are_near(points: FloatArray) -> bool:
    """Return whether all coordinates are finite and near the foot, so that nothing overflows."""
    return bool((np.abs(points) < _MOST_MM).all())


def _damaged(name: str) -> InputError:
    return InputError("{name} is damaged; restore it from a backup.", name=name)
