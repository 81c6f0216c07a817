"""A surface as it is seen along the normal of a plane: heights over it, on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import rigid, transform
from insole_core.imprints.planes import Plane

_COARSE_MM, _FINE_MM, _MOST_CELLS = 2.0, 1.0, 120_000
_MARGIN_MM = 10.0


@dataclass(frozen=True, eq=False)
class Relief:
    """Heights of the uppermost surface over a plane.

    Parameters
    ----------
    source2relief : (4, 4) float64, mm
        To a frame in which the plane is z = 0 and one looks along -z.
    first_mm : (2,) float64
        x and y of the node [0, 0], relief frame.
    cell_mm
        Distance of the nodes.
    heights_mm : (ny, nx) float64
        NaN where there is no surface.
    facing : (ny, nx) float64
        z of the triangles' normals as the surface has them; NaN where there is none.
    """

    source2relief: FloatArray
    first_mm: FloatArray
    cell_mm: float
    heights_mm: FloatArray
    facing: FloatArray

    @property
    def up(self) -> FloatArray:
        """(3,) unit vector against the direction in which one looks, source frame."""
        return self.source2relief[2, :3]

    def positions(self, mask: BoolArray) -> FloatArray:
        """Return x and y (n, 2) of the nodes in a mask (ny, nx), mm, relief frame."""
        rows, columns = np.nonzero(mask)
        return self.first_mm + self.cell_mm * np.stack([columns, rows], axis=1)

    def at(self, values: FloatArray, places: FloatArray, beyond: float) -> FloatArray:
        """Interpolate values (ny, nx) at places (n, 2), relief frame; `beyond` outside the grid."""
        column, row = ((places - self.first_mm) / self.cell_mm).T
        return np.asarray(
            scipy.ndimage.map_coordinates(values, [row, column], order=1, cval=beyond)
        )


class ReliefViewer:
    """Looks at one surface along the normals of planes."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._mesh = mesh
        self._caster = RayCaster(mesh)

    def relief(self, plane: Plane, sign: int) -> Relief:
        """Look at the whole surface against the normal of a plane.

        Parameters
        ----------
        sign
            -1 to look along the normal.
        """
        source2relief = _frame(plane, sign)
        local = transform(source2relief, self._mesh.vertices)[:, :2]
        low, high = local.min(axis=0) - _MARGIN_MM, local.max(axis=0) + _MARGIN_MM
        cell_mm = max(_COARSE_MM, float(np.sqrt(np.prod(high - low) / _MOST_CELLS)))
        return self._look(source2relief, low, high, cell_mm)

    def detail(self, relief: Relief, mask: BoolArray, margin_mm: float) -> Relief:
        """Look closely at the nodes in a mask (ny, nx) and what is beside them."""
        places = relief.positions(mask)
        low, high = places.min(axis=0) - margin_mm, places.max(axis=0) + margin_mm
        return self._look(relief.source2relief, low, high, _FINE_MM)

    def _look(
        self, source2relief: FloatArray, low: FloatArray, high: FloatArray, cell_mm: float
    ) -> Relief:
        """Return the relief between two corners (2,), relief frame."""
        local = transform(source2relief, self._mesh.vertices)[:, 2]
        x, y = (np.arange(a, b, cell_mm) for a, b in zip(low, high, strict=True))
        across, along = np.meshgrid(x, y)
        top = np.full(across.size, local.max() + _MARGIN_MM)
        starts = np.stack([across.ravel(), along.ravel(), top], axis=1)
        origins = (starts - source2relief[:3, 3]) @ source2relief[:3, :3]
        up = source2relief[2, :3]
        hits = self._caster.cast(origins, np.broadcast_to(-up, origins.shape))
        heights, facing = np.full((2, len(starts)), np.nan)
        corners = local[self._mesh.triangles[hits.triangle]]
        heights[hits.ray] = (hits.weights * corners).sum(axis=1)
        facing[hits.ray] = self._mesh.triangle_normals[hits.triangle] @ up
        shape = across.shape
        return Relief(source2relief, low, cell_mm, heights.reshape(shape), facing.reshape(shape))


def _frame(plane: Plane, sign: int) -> FloatArray:
    """Return the transform (4, 4) to a frame on the plane, z along its normal times `sign`."""
    up = sign * plane.normal
    aside = np.eye(3)[np.abs(up).argmin()]
    x = np.cross(aside, up)
    x /= np.linalg.norm(x)
    return rigid(np.stack([x, np.cross(up, x), up]), np.array([0.0, 0.0, -sign * plane.offset_mm]))
