"""Whether a solid is sound: closed, one body, and nowhere through itself."""

from __future__ import annotations

import manifold3d
import numpy as np
import trimesh

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.solids.simplification import to_manifold

_LINES = 250


def faults(solid: TriangleMesh) -> list[str]:
    """Complaints of trimesh, manifold3d, and of vertical lines through the solid."""
    found = []
    mesh = trimesh.Trimesh(solid.vertices, solid.triangles, process=False)
    if not (mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0):
        found.append("trimesh: not watertight")
    body = to_manifold(solid)
    if body.status() != manifold3d.Error.NoError:
        found.append(f"manifold3d: {body.status()}")
    if len(body.decompose()) != 1:
        found.append(f"{len(body.decompose())} bodies")
    if abs(body.volume() / solid.volume_mm3 - 1) > 1e-3:
        found.append("manifold3d: another volume")
    twice = _entered_twice(solid)
    return [*found, f"{twice} of {_LINES} vertical lines enter it twice"] if twice else found


def _entered_twice(solid: TriangleMesh) -> int:
    """Count vertical lines that enter the solid again before they have left it."""
    corners = solid.vertices[solid.triangles]
    low, high = corners[..., :2].min(axis=1), corners[..., :2].max(axis=1)
    rng = np.random.default_rng(0)
    return sum(
        _is_entered_twice(corners[((low <= place) & (place <= high)).all(axis=1)], place)
        for place in rng.uniform(low.min(axis=0), high.max(axis=0), (_LINES, 2))
    )


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
