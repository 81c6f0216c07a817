"""Contour constraints: tangent planes that the outlines of a surface in pictures define."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform

PLY_ELEMENT = "touch"
"""Name of the PLY element that holds the constraints, beside vertices and faces."""


@dataclass(frozen=True, eq=False)
class ContourConstraints:
    """Planes through lines of sight that are tangent to the surface.

    Across the plane a picture locates the surface to a fraction of a pixel; the position of the
    point of contact along the line of sight is known no better than the surface itself.

    Parameters
    ----------
    points : (k, 3) float64, mm
        Approximate points of contact.
    normals : (k, 3) float64
        Unit normals of the planes, away from the surface.
    """

    points: FloatArray
    normals: FloatArray

    def transformed(self, a2b: FloatArray) -> ContourConstraints:
        """Return the constraints in frame b, given a rigid transform (4, 4) from their frame a."""
        return ContourConstraints(
            transform(a2b, self.points), np.asarray(self.normals @ a2b[:3, :3].T)
        )

    def scaled(self, factor: float) -> ContourConstraints:
        """Return the constraints with their points multiplied by `factor`, to change the unit."""
        return ContourConstraints(self.points * factor, self.normals)
