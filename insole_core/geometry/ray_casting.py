"""What rays meet first on a surface; the intersection is Embree's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore_scene import EmbreeScene

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class RayHits:
    """Where rays met a surface first; only the rays that met it.

    Parameters
    ----------
    ray : (n,) int64
        Index of the ray.
    triangle : (n,) int64
    weights : (n, 3) float64
        Barycentric weights of the triangle's corners.
    """

    ray: IntArray
    triangle: IntArray
    weights: FloatArray


class RayCaster:
    """Casts rays onto one mesh; both of its sides are hit.

    Parameters
    ----------
    mesh
        At least one triangle.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self._center = mesh.vertices.mean(0)
        self._scene = EmbreeScene()
        vertices = (mesh.vertices - self._center).astype(np.float32)
        EmbreeMesh(self._scene, vertices, np.ascontiguousarray(mesh.triangles, np.int32))

    def cast(self, origin: FloatArray, directions: FloatArray) -> RayHits:
        """Follow rays (n, 3) from one origin (3,) to what they meet first."""
        found = self._scene.run(*self._rays(origin, directions), output=1)
        ray = np.flatnonzero(found["primID"] >= 0)
        u, v = (found[key][ray].astype(float) for key in ("u", "v"))
        return RayHits(ray, found["primID"][ray].astype(np.int64), np.stack([1 - u - v, u, v], 1))

    def is_blocked(self, points: FloatArray, target: FloatArray, clearance_mm: float) -> BoolArray:
        """Tell for points (n, 3) whether the surface stands between them and the target (3,).

        What lies nearer to the point than `clearance_mm` does not count: the point's own surface.
        """
        way = target - points
        start = points + clearance_mm * way / np.linalg.norm(way, axis=1, keepdims=True)
        return np.asarray(self._scene.run(*self._rays(start, way), query="OCCLUDED") == 0)

    def _rays(
        self, origin: FloatArray, directions: FloatArray
    ) -> tuple[Float32Array, Float32Array]:
        start = np.broadcast_to(origin - self._center, directions.shape)
        return start.astype(np.float32), directions.astype(np.float32)
