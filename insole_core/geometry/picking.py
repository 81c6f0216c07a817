"""What lies under the pointer: the first meeting of a ray with a surface."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster


class SurfacePicker:
    """Finds what a ray meets first on one mesh.

    Parameters
    ----------
    mesh
        At least one triangle; both of its sides are hit.
    """

    def __init__(self, mesh: TriangleMesh) -> None:
        self._caster = RayCaster(mesh)
        self._corners = mesh.vertices[mesh.triangles]

    def pick(self, origin: FloatArray, direction: FloatArray) -> FloatArray | None:
        """Give the first point (3,) that a ray meets, in the frame of the mesh; None for none."""
        met = self._caster.cast(origin, direction[None]).triangle
        if len(met) == 0:
            return None
        # Embree works in single precision: its triangle is right, the place is computed anew.
        a, b, c = self._corners[met[0]]
        normal = np.cross(b - a, c - a)
        distance = np.dot(a - origin, normal) / np.dot(direction, normal)
        return np.asarray(origin + distance * direction)
