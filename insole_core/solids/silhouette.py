"""The outline of a solid seen from above, and polygons of the solid modeller."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.solids.simplification import to_manifold

if TYPE_CHECKING:
    import manifold3d

_LEAST_MM2: Final = 0.01
"""Of an area; less is a sliver of the triangles."""


def silhouette(solid: TriangleMesh) -> tuple[FloatArray, ...]:
    """Return the outlines (n, 2) of a solid from above, mm; holes turn clockwise.

    Raises
    ------
    DesignError
        If it is not closed.
    """
    return polygons_of(to_manifold(solid).project())


def polygons_of(area: manifold3d.CrossSection) -> tuple[FloatArray, ...]:
    """Return the polygons (n, 2) of an area, mm, without slivers."""
    found = (np.asarray(polygon, float) for polygon in area.to_polygons())
    return tuple(polygon for polygon in found if abs(_area_mm2(polygon)) > _LEAST_MM2)


def _area_mm2(polygon: FloatArray) -> float:
    x, y = polygon.T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))
