"""A surface or a cloud of points as a file has it, before its unit and its flaws are known."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from insole_core.formats.units import Unit
from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.contour_constraints import ContourConstraints
from insole_core.geometry.transforms import rigid


def _no_triangles() -> IndexArray:
    return np.empty((0, 3), dtype=np.int32)


@dataclass(frozen=True, eq=False)
class RawSurface:
    """What a file holds.

    Parameters
    ----------
    vertices : (n, 3) float64
        In the unit and the frame of the file.
    triangles : (m, 3) int32
        None of a cloud of points.
    colors : (n, 3) uint8, optional
        RGB.
    normals : (n, 3) float64, optional
        Of a cloud of points; of any length.
    touches : optional
        Constraints from outlines, of a foot that this program reconstructed.
    unit
        That the file or its format states.
    is_unit_remark
        Whether only a comment states it, which counts as nothing where it cannot be.
    notes
        What was not read, a sentence each.
    """

    vertices: FloatArray
    triangles: IndexArray = field(default_factory=_no_triangles)
    colors: ByteArray | None = None
    normals: FloatArray | None = None
    touches: ContourConstraints | None = None
    unit: Unit | None = None
    is_unit_remark: bool = False
    notes: tuple[str, ...] = ()

    def moved(self, by: FloatArray) -> RawSurface:
        """Return the surface moved by a way (3,), in its unit."""
        if not by.any():
            return self
        touches = None if self.touches is None else self.touches.transformed(rigid(np.eye(3), by))
        return replace(self, vertices=self.vertices + by, touches=touches)

    def at_points(self, chosen: IntArray) -> RawSurface:
        """Return some of the points (m,) of a cloud."""
        return replace(
            self,
            vertices=self.vertices[chosen],
            colors=None if self.colors is None else self.colors[chosen],
            normals=None if self.normals is None else self.normals[chosen],
        )


def placed(vertices: FloatArray, a2b: FloatArray) -> FloatArray:
    """Transform vertices (n, 3) by `a2b` (4, 4), affine; equal ones stay equal to the last bit.

    A product of matrices rounds by the place of a row, and seams of a texture would open.
    """
    columns = [vertices[:, [axis]] * a2b[:3, axis] for axis in range(3)]
    return columns[0] + columns[1] + columns[2] + a2b[:3, 3]
