"""The sole of a foot seen from above, as heights on a grid: what a footprint is compared with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray

CELL_MM = 2.0
AWAY_MM = 30.0
"""Height beside the sole; higher points of it never press on the ground."""
_AROUND_MM = 60.0
_FACING = -0.2
_GAP_CELLS = 5


@dataclass(frozen=True, eq=False)
class SolePrint:
    """Heights of the sole over the ground.

    Parameters
    ----------
    heights_mm : (ny, nx) float64
        On cells of 2 mm; `AWAY_MM` beside the sole.
    first_mm
        x and y of the cell [0, 0], insole frame.
    is_beside : (ny, nx) bool
        Where there is no sole.
    length_mm
        Of the foot.
    """

    heights_mm: FloatArray
    first_mm: tuple[float, float]
    is_beside: BoolArray
    length_mm: float

    @staticmethod
    def of(foot: Foot) -> SolePrint:
        """Return the print of a foot; computed once."""
        made: SolePrint = foot.derived.get("sole print", (), lambda: _print_of(foot))
        return made

    def cells(self, points: FloatArray) -> FloatArray:
        """Return rows and columns (2, n) of points (n, 2) of the insole frame."""
        return np.asarray((points[:, ::-1] - self.first_mm[::-1]).T / CELL_MM)


def _print_of(foot: Foot) -> SolePrint:
    from scipy import ndimage

    even = foot.even
    facing = (even.normals[:, 2] < _FACING) & (even.points[:, 2] < AWAY_MM)
    points = even.points[facing if facing.any() else slice(None)]
    low = np.floor(points[:, :2].min(axis=0)) - _AROUND_MM
    size = np.ceil((points[:, :2].max(axis=0) + _AROUND_MM - low) / CELL_MM).astype(int) + 1
    heights = np.full((size[1], size[0]), AWAY_MM)
    column, row = np.round((points[:, :2] - low) / CELL_MM).astype(int).T
    np.minimum.at(heights, (row, column), points[:, 2])
    # Holes between points and small ones of the scan get the height around them.
    heights = ndimage.grey_opening(heights, size=(_GAP_CELLS, _GAP_CELLS), mode="nearest")
    return SolePrint(
        heights, (float(low[0]), float(low[1])), heights >= AWAY_MM, float(foot.length_mm)
    )
