"""A surface or a cloud of points as a file has it, before its unit and its flaws are known."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Final, TypeAlias

import numpy as np

from insole_core.formats.units import Unit
from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import ContourConstraints
from insole_core.geometry.transforms import rigid
from insole_core.messages import Message

_MOST_DEPTH, _MOST_PARTS = 64, 10_000
_MOST_CORNERS: Final = 20_000_000  # as many as one file of the greatest size holds
MOST_CORNERS = 1000
"""Of one polygon; a scan has triangles, seldom four corners."""
_Placed: TypeAlias = tuple[FloatArray, IntArray, FloatArray]
"""Vertices (n, 3), triangles (m, 3) and place (4, 4) of a mesh, affine."""


def _no_triangles() -> IndexArray:
    return np.empty((0, 3), dtype=np.int32)


@dataclass(frozen=True, eq=False)
class RawSurface:
    """What a file holds.

    Parameters
    ----------
    vertices : (n, 3) float64
        In the unit and the frame of the file.
    triangles : (m, 3) int32
        None of a cloud of points.
    colors : (n, 3) uint8, optional
        RGB.
    normals : (n, 3) float64, optional
        Of a cloud of points; of any length.
    touches : optional
        Constraints from outlines, of a foot that this program reconstructed.
    unit
        That the file or its format states.
    is_unit_remark
        Whether only a comment states it, which counts as nothing where it cannot be.
    notes
        What was not read, a sentence each.
    """

    vertices: FloatArray
    triangles: IndexArray = field(default_factory=_no_triangles)
    colors: ByteArray | None = None
    normals: FloatArray | None = None
    touches: ContourConstraints | None = None
    unit: Unit | None = None
    is_unit_remark: bool = False
    notes: tuple[str, ...] = ()

    def moved(self, by: FloatArray) -> RawSurface:
        """Return the surface moved by a way (3,), in its unit."""
        if not by.any():
            return self
        touches = None if self.touches is None else self.touches.transformed(rigid(np.eye(3), by))
        return replace(self, vertices=self.vertices + by, touches=touches)

    def at_points(self, chosen: IntArray) -> RawSurface:
        """Return some of the points (m,) of a cloud."""
        return replace(
            self,
            vertices=self.vertices[chosen],
            colors=None if self.colors is None else self.colors[chosen],
            normals=None if self.normals is None else self.normals[chosen],
        )


def _placed(vertices: FloatArray, a2b: FloatArray) -> FloatArray:
    """Transform vertices (n, 3) by `a2b` (4, 4), affine; equal ones stay equal to the last bit.

    A product of matrices rounds by the place of a row, and seams of a texture would open.
    """
    columns = [vertices[:, [axis]] * a2b[:3, axis] for axis in range(3)]
    return columns[0] + columns[1] + columns[2] + a2b[:3, 3]


def _as_many_as_in_scans(meshes: Iterable[_Placed]) -> list[_Placed]:
    """Return meshes that together are no larger than a scan: counted before any is moved."""
    counted: list[_Placed] = []
    corners = 0
    for points, faces, place in meshes:
        corners += max(len(points), len(faces))
        if corners > _MOST_CORNERS:
            raise ValueError(Message("it has far more corners than a scan"))
        counted.append((points, faces, place))
    return counted


def join_placed(meshes: Iterable[_Placed]) -> tuple[FloatArray, IndexArray]:
    """Join meshes, each moved to its place; a mirrored one stays the right way out.

    Parameters
    ----------
    meshes
        As they are placed.

    Returns
    -------
    vertices : (n, 3) float64
    triangles : (m, 3) int32

    Raises
    ------
    ValueError
        When a triangle names a corner that its mesh does not hold, or all are far more than a scan.
    """
    vertices: list[FloatArray] = [np.empty((0, 3))]
    triangles: list[IntArray] = [np.empty((0, 3), np.int64)]
    start = 0
    for points, faces, place in _as_many_as_in_scans(meshes):
        if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
            raise ValueError(Message("a triangle in it names a corner that it does not hold"))
        is_mirrored = np.linalg.det(place[:3, :3]) < 0
        vertices.append(_placed(points, place))
        triangles.append((faces[:, ::-1] if is_mirrored else faces) + start)
        start += len(points)
    return np.concatenate(vertices), np.concatenate(triangles).astype(np.int32)


@dataclass(eq=False)
class Assembly:
    """An object of a format of 3-D printing: a mesh, and other objects at their places."""

    vertices: array[float] = field(default_factory=lambda: array("d"))
    triangles: array[int] = field(default_factory=lambda: array("q"))
    parts: list[tuple[str, FloatArray]] = field(default_factory=list)


def join_objects(
    objects: Mapping[str, Assembly], build: Sequence[tuple[str, FloatArray]]
) -> tuple[FloatArray, IndexArray]:
    """Join the objects that are built, by name and place (4, 4), as `join_placed` does.

    Raises
    ------
    ValueError, LookupError
        As `join_placed`; or when they contain each other, are too many, or one is not there.
    """
    return join_placed(_meshes(objects, build))


def _meshes(
    objects: Mapping[str, Assembly], build: Sequence[tuple[str, FloatArray]]
) -> Iterable[_Placed]:
    waiting = [(name, place, 0) for name, place in build]
    visited = 0
    while waiting:
        name, object2model, depth = waiting.pop()
        visited += 1
        if depth > _MOST_DEPTH or visited > _MOST_PARTS:
            raise ValueError(Message("its objects contain each other, or are far too many"))
        thing = objects[name]
        points = np.frombuffer(thing.vertices or array("d"), float).reshape(-1, 3)
        faces = np.frombuffer(thing.triangles or array("q"), np.int64).reshape(-1, 3)
        yield points, faces, object2model
        waiting += [(part, object2model @ place, depth + 1) for part, place in thing.parts]


def fans(corners: IntArray, counts: IntArray) -> IntArray:
    """Split polygons into triangles around their first corners.

    Parameters
    ----------
    corners : (n,) int64
        Of all polygons, one after the other.
    counts : (m,) int64
        Corners of each; polygons with fewer than three are dropped.

    Returns
    -------
    (k, 3) int64
        Places in `corners`.

    Raises
    ------
    ValueError
        When a polygon has far more corners than a scan's.
    """
    if counts.max(initial=0) > MOST_CORNERS:
        raise ValueError(Message("a polygon has more than {most} corners", most=MOST_CORNERS))
    firsts = np.cumsum(counts) - counts
    if (counts == 3).all():
        return np.arange(len(corners)).reshape(-1, 3)
    parts = [
        firsts[counts > number + 1][:, None] + [0, number, number + 1]
        for number in range(1, int(counts.max(initial=0)) - 1)
    ]
    return np.concatenate(parts) if parts else np.empty((0, 3), dtype=np.int64)


def as_indices(corners: IntArray) -> IndexArray:
    """Return corners as int32; what no mesh has stays beyond every mesh."""
    return np.clip(corners, -1, np.iinfo(np.int32).max).astype(np.int32)
