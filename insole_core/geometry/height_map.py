"""A solid seen from above: its heights on a grid, and discs of its nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray


@dataclass(frozen=True, eq=False)
class HeightMap:
    """Heights of a solid on pixels of 1 mm.

    Parameters
    ----------
    top_mm, bottom_mm : (ny, nx) float64
        Upper and lower side; NaN beside the solid.
    first_mm
        x and y of the centre of the pixel [0, 0].
    """

    top_mm: FloatArray
    bottom_mm: FloatArray
    first_mm: tuple[float, float] = (0.0, 0.0)

    @property
    def extent_mm(self) -> tuple[float, float, float, float]:
        """Left, right, lower and upper edge, as plots take them."""
        (x, y), (rows, columns) = self.first_mm, self.top_mm.shape
        return x - 0.5, x + columns - 0.5, y - 0.5, y + rows - 0.5


def disc(radius_mm: float, step_mm: float) -> ByteArray:
    """Return which nodes (2 r + 1, 2 r + 1) lie within a radius of the one in the middle."""
    reach = int(radius_mm / step_mm)
    i, j = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    return np.asarray((i * i + j * j) * step_mm**2 <= radius_mm**2, np.uint8)
