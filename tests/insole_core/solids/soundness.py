"""Whether a solid is sound: closed, one body, and nowhere through itself."""

from __future__ import annotations

from typing import NamedTuple

import manifold3d
import numpy as np
import trimesh

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.solids.simplification import to_manifold

_LINES = 250


def faults(solid: TriangleMesh) -> list[str]:
    """Complaints of trimesh, manifold3d, and of vertical lines through the solid."""
    found = []
    mesh = trimesh.Trimesh(solid.vertices, solid.triangles, process=False)
    if not (mesh.is_watertight and mesh.is_winding_consistent and solid.volume_mm3 > 0):
        found.append("trimesh: not watertight")
    body = to_manifold(solid)
    if body.status() != manifold3d.Error.NoError:
        found.append(f"manifold3d: {body.status()}")
    if (count := len(body.decompose())) != 1:
        found.append(f"{count} bodies")
    if abs(body.volume() / solid.volume_mm3 - 1) > 1e-3:
        found.append("manifold3d: another volume")
    twice = _entered_twice(solid)
    return [*found, f"{twice} of {_LINES} vertical lines enter it twice"] if twice else found


def _entered_twice(solid: TriangleMesh) -> int:
    """Count vertical lines that enter the solid again before they have left it."""
    corners = solid.vertices[solid.triangles]
    across, along = (Extents.of(corners[..., axis]) for axis in (0, 1))
    rng = np.random.default_rng(0)
    low = (across.low.min(), along.low.min())
    high = (across.high.max(), along.high.max())
    count = 0
    for place in rng.uniform(low, high, (_LINES, 2)):
        near = np.flatnonzero(across.contain(place[0]))
        near = near[along.take(near).contain(place[1])]
        count += _is_entered_twice(corners[near], place)
    return count


class Extents(NamedTuple):
    """From where to where triangles reach along an axis."""

    low: FloatArray
    high: FloatArray

    @classmethod
    def of(cls, corners: FloatArray) -> Extents:
        """Take the coordinates (n, 3) of the corners."""
        return cls(corners.min(axis=1), corners.max(axis=1))

    def take(self, index: IntArray) -> Extents:
        return Extents(self.low[index], self.high[index])

    def contain(self, place: float) -> BoolArray:
        return (self.low <= place) & (place <= self.high)


def _is_entered_twice(corners: FloatArray, place: FloatArray) -> bool:
    """Whether the triangles (n, 3, 3) about a vertical line go in or out twice in a row."""
    a, b, c = (corners[:, k, :2] - place for k in range(3))
    weights = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)], axis=1)
    hit = (weights > 0).all(axis=1) | (weights < 0).all(axis=1)
    weights, corners = weights[hit], corners[hit]
    area = weights.sum(axis=1)
    height = (weights * corners[..., 2]).sum(axis=1) / area
    depth = np.cumsum(-np.sign(area)[np.argsort(height)])
    return bool(((depth < 0) | (depth > 1)).any())


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
