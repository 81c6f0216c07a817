"""What lies under the pointer: the first meeting of a ray with a surface, cast by embree."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh.ray.ray_pyembree import RayMeshIntersector

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh


class SurfacePicker:
    """Finds what a ray meets first on one mesh.

    Parameters
    ----------
    mesh
        At least one triangle; both of its sides are hit.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        body = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False, validate=False)
        self._intersector = RayMeshIntersector(body, scale_to_box=False)
        self._corners = mesh.vertices[mesh.triangles]

    def pick(self, origin: FloatArray, direction: FloatArray) -> FloatArray | None:
        """Give the first point (3,) that a ray meets, in the frame of the mesh; None for none."""
        triangle = int(self._intersector.intersects_first(origin[None], direction[None])[0])
        if triangle < 0:
            return None
        # Embree works in single precision: its triangle is right, the place is computed anew.
        a, b, c = self._corners[triangle]
        normal = np.cross(b - a, c - a)
        distance = np.dot(a - origin, normal) / np.dot(direction, normal)
        return np.asarray(origin + distance * direction)
