"""First intersections of rays with a surface, computed by Embree, and what a pointer picks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore_scene import EmbreeScene

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class RayHits:
    """First intersections of rays with a surface; only of the rays that hit it.

    Parameters
    ----------
    ray : (n,) int64
        Index of the ray.
    triangle : (n,) int64
        Index of the triangle.
    weights : (n, 3) float64
        Barycentric coordinates of the intersection.
    """

    ray: IntArray
    triangle: IntArray
    weights: FloatArray


class RayCaster:
    """Intersects rays with one mesh; both of its sides are hit.

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
        """Find the first intersections of rays.

        Parameters
        ----------
        origin : (3,) or (n, 3) float64, mm, frame of the mesh
            Common to all rays, or of each.
        directions : (n, 3) float64
            Of any length.

        Returns
        -------
        RayHits
            Of the rays that hit the mesh, in the order given.
        """
        hits = self._scene.run(*self._rays(origin, directions), output=1)
        ray = np.flatnonzero(hits["primID"] >= 0)
        u, v = (hits[key][ray].astype(float) for key in ("u", "v"))
        return RayHits(ray, hits["primID"][ray].astype(np.int64), np.stack([1 - u - v, u, v], 1))

    def is_blocked(self, points: FloatArray, target: FloatArray, clearance_mm: float) -> BoolArray:
        """Find the points that the surface hides from a target.

        Parameters
        ----------
        points : (n, 3) float64, mm, frame of the mesh
        target : (3,) float64, mm, frame of the mesh
        clearance_mm
            Surface nearer to a point than this does not count: it is the point's own.

        Returns
        -------
        (n,) bool
        """
        way = target - points
        start = points + clearance_mm * way / np.linalg.norm(way, axis=1, keepdims=True)
        return np.asarray(self._scene.run(*self._rays(start, way), query="OCCLUDED") == 0)

    def _rays(
        self, origin: FloatArray, directions: FloatArray
    ) -> tuple[Float32Array, Float32Array]:
        start = np.broadcast_to(origin - self._center, directions.shape)
        return start.astype(np.float32), directions.astype(np.float32)


class SurfacePicker:
    """Intersects single rays with one mesh.

    Parameters
    ----------
    mesh
        At least one triangle; both of its sides are hit.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self._caster = RayCaster(mesh)
        self._corners = mesh.vertices[mesh.triangles]

    def pick(self, origin: FloatArray, direction: FloatArray) -> FloatArray | None:
        """Find the first intersection of a ray with the mesh.

        Parameters
        ----------
        origin : (3,) float64, mm, frame of the mesh
        direction : (3,) float64
            Of any length.

        Returns
        -------
        (3,) float64, mm, frame of the mesh
            None where the ray misses the mesh.
        """
        met = self._caster.cast(origin, direction[None]).triangle
        if len(met) == 0:
            return None
        # Embree works in single precision: take its triangle, but compute the point in double.
        a, b, c = self._corners[met[0]]
        normal = np.cross(b - a, c - a)
        distance = np.dot(a - origin, normal) / np.dot(direction, normal)
        return np.asarray(origin + distance * direction)
