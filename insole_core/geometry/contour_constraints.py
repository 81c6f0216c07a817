"""Where lines of sight touch a surface: its outlines in pictures, as places and directions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform

PLY_ELEMENT = "touch"
"""Under this name a PLY file holds them, beside its vertices and faces."""


@dataclass(frozen=True, eq=False)
class ContourConstraints:
    """Planes through lines of sight that the surface touches from within.

    Across the plane a picture tells the surface to a fraction of a pixel; where along the line of
    sight it is touched is known no better than the surface itself.

    Parameters
    ----------
    points : (k, 3) float64, mm
        About where the surface touches the plane.
    normals : (k, 3) float64
        Unit normals of the planes, away from the surface.
    """

    points: FloatArray
    normals: FloatArray

    def transformed(self, a2b: FloatArray) -> ContourConstraints:
        """Bring them from frame a to frame b."""
        return ContourConstraints(
            transform(a2b, self.points), np.asarray(self.normals @ a2b[:3, :3].T)
        )

    def scaled(self, factor: float) -> ContourConstraints:
        """Bring them to another unit."""
        return ContourConstraints(self.points * factor, self.normals)
