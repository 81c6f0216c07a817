"""Cast rays into a coloured scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster

_CLEARANCE_MM = 0.5
"""Distance of a shadow ray's start from its surface, so that it does not hit the surface itself."""


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits of rays with a scene; only of the rays that hit something.

    Parameters
    ----------
    ray : (n,) int64
        Index of the ray.
    distance : (n,) float64
        In units of that ray's direction.
    points, normals : (n, 3) float64
        Position and unit surface normal towards the ray's origin, frame of the scene.
    colors : (n, 3) float64
        0 to 255, interpolated between the vertices.
    """

    ray: IntArray
    distance: FloatArray
    points: FloatArray
    normals: FloatArray
    colors: FloatArray


class SceneCaster:
    """A coloured mesh, prepared for casting rays."""

    def __init__(self, scene: TriangleMesh) -> None:
        self._corners = scene.vertices[scene.triangles]
        self._normals = scene.vertex_normals
        colors = scene.colors
        self._colors = np.full(scene.vertices.shape, 200.0) if colors is None else colors
        self._triangles = scene.triangles
        self._caster = RayCaster(scene)

    def cast(self, origin: FloatArray, directions: FloatArray) -> Hits:
        """Find the first hits of rays from one origin.

        Parameters
        ----------
        origin : (3,) float64, mm, frame of the scene
        directions : (n, 3) float64
            Of any length.

        Returns
        -------
        Hits
        """
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
        """Return which points are hidden from a target.

        Parameters
        ----------
        points : (n, 3) float64, mm, frame of the scene
        target : (3,) float64, mm

        Returns
        -------
        (n,) bool
        """
        return self._caster.is_blocked(points, target, _CLEARANCE_MM)


def _solve(
    corners: FloatArray, origin: FloatArray, directions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Compute ray length (n,) and barycentric weights (n, 3) in double (Moller & Trumbore 1997)."""
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(directions, edge2)
    scale = 1 / np.einsum("nc,nc->n", edge1, p)
    offset = origin - corners[:, 0]
    u = np.einsum("nc,nc->n", offset, p) * scale
    q = np.cross(offset, edge1)
    v = np.einsum("nc,nc->n", directions, q) * scale
    weights = np.clip(np.stack([1 - u - v, u, v], axis=1), 0, 1)
    return np.einsum("nc,nc->n", edge2, q) * scale, weights / weights.sum(axis=1, keepdims=True)
