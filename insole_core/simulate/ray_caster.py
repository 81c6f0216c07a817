"""What straight rays meet in a coloured scene, and what it looks like there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster

_CLEARANCE_MM = 0.5
"""How far a shadow ray starts off its surface, so that it does not meet the surface itself."""


@dataclass(frozen=True, eq=False)
class Hits:
    """Where rays met the scene first; only the rays that met something.

    Parameters
    ----------
    ray : (n,) int64
        Index of the ray.
    distance : (n,) float64
        In lengths of that ray's direction.
    points, normals : (n, 3) float64
        Place and unit surface normal, turned towards the ray's origin; same frame as the scene.
    colors : (n, 3) float64
        0 to 255, interpolated between the vertices.
    """

    ray: IntArray
    distance: FloatArray
    points: FloatArray
    normals: FloatArray
    colors: FloatArray


class SceneCaster:
    """Casts rays into one coloured mesh."""

    def __init__(self, scene: TriangleMesh) -> None:
        self._corners = scene.vertices[scene.triangles]
        self._normals = scene.vertex_normals
        colors = scene.colors
        self._colors = np.full(scene.vertices.shape, 200.0) if colors is None else colors
        self._triangles = scene.triangles
        self._caster = RayCaster(scene)

    def cast(self, origin: FloatArray, directions: FloatArray) -> Hits:
        """Follow rays (n, 3) from one origin (3,) to what they meet first."""
        met = self._caster.cast(origin, directions)
        ray, triangle = met.ray, met.triangle
        directions = directions[ray]
        distance, weights = _solve(self._corners[triangle], origin, directions)
        at = self._triangles[triangle]
        normals = np.einsum("nk,nkc->nc", weights, self._normals[at])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        facing = np.sign(-np.einsum("nc,nc->n", normals, directions))
        return Hits(
            ray,
            distance,
            origin + distance[:, None] * directions,
            normals * facing[:, None],
            np.einsum("nk,nkc->nc", weights, self._colors[at].astype(float)),
        )

    def is_blocked(self, points: FloatArray, target: FloatArray) -> BoolArray:
        """Tell for points (n, 3) whether anything stands between them and the target (3,)."""
        return self._caster.is_blocked(points, target, _CLEARANCE_MM)


def _solve(
    corners: FloatArray, origin: FloatArray, directions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Ray length (n,) and barycentric weights (n, 3), Moller & Trumbore 1997, in double."""
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(directions, edge2)
    scale = 1 / np.einsum("nc,nc->n", edge1, p)
    offset = origin - corners[:, 0]
    u = np.einsum("nc,nc->n", offset, p) * scale
    q = np.cross(offset, edge1)
    v = np.einsum("nc,nc->n", directions, q) * scale
    weights = np.clip(np.stack([1 - u - v, u, v], axis=1), 0, 1)
    return np.einsum("nc,nc->n", edge2, q) * scale, weights / weights.sum(axis=1, keepdims=True)
