"""A solid seen from above: its heights on a grid."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.arrays import FloatArray


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
