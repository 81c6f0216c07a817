"""Find the point of a surface under the pointer."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster


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
