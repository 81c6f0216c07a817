"""A surface over the (x, y)-plane: a height at every node of a grid; heel and heads on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import cv2
import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray

Grid: TypeAlias = tuple[float, float, float, tuple[int, int]]
"""x and y of the first node, step, and numbers of rows and columns; hashable, to be a key."""
HEEL_SHARE = 0.22
"""Length of the heel as a share of the foot's length."""


@dataclass(frozen=True, eq=False)
class HeightField:
    """Heights over a rectangular grid whose nodes lie at whole multiples of its step.

    Parameters
    ----------
    x0_mm, y0_mm
        Position of the node with row 0 and column 0.
    step_mm
        Distance between neighbouring nodes, in x and in y.
    heights_mm : (ny, nx) float64
        Row i, column j lies at (x0 + j step, y0 + i step).
    """

    x0_mm: float
    y0_mm: float
    step_mm: float
    heights_mm: FloatArray

    @property
    def grid(self) -> Grid:
        """The grid without the heights."""
        rows, columns = self.heights_mm.shape
        return self.x0_mm, self.y0_mm, self.step_mm, (rows, columns)

    @cached_property
    def x_mm(self) -> FloatArray:
        """(nx,) x of the columns."""
        return np.asarray(self.x0_mm + self.step_mm * np.arange(self.heights_mm.shape[1]))

    @cached_property
    def y_mm(self) -> FloatArray:
        """(ny,) y of the rows."""
        return np.asarray(self.y0_mm + self.step_mm * np.arange(self.heights_mm.shape[0]))

    @cached_property
    def nodes(self) -> FloatArray:
        """(ny * nx, 3) nodes with their heights, row by row."""
        x, y = np.meshgrid(self.x_mm, self.y_mm)
        return np.stack([x.ravel(), y.ravel(), self.heights_mm.ravel()], axis=1)

    def nodes_about(self, curve: FloatArray, beside: int) -> BoolArray:
        """Find the nodes in a closed curve (n, 2), mm, and this number of nodes beside it.

        Returns
        -------
        (ny, nx) bool
        """
        corner = np.array([self.x0_mm, self.y0_mm])
        pixels = np.rint((curve - corner) / self.step_mm).astype(np.int32)
        mask = np.zeros(self.heights_mm.shape, np.uint8)
        cv2.fillPoly(mask, [pixels], 1)
        return np.asarray(cv2.dilate(mask, np.ones((2 * beside + 1,) * 2, np.uint8)) > 0)

    def slope_deg(self) -> FloatArray:
        """Compute the inclination (ny, nx) of the surface from the horizontal, degrees."""
        along_y, along_x = np.gradient(self.heights_mm, self.step_mm)
        return np.asarray(np.degrees(np.arctan(np.hypot(along_x, along_y))))

    def laplacian(self) -> FloatArray:
        """Compute the sum of both second differences per step², (ny, nx), 1/mm; 0 at the rim."""
        h, bend = self.heights_mm, np.zeros_like(self.heights_mm)
        around = h[:-2, 1:-1] + h[2:, 1:-1] + (h[1:-1, :-2] + h[1:-1, 2:])
        bend[1:-1, 1:-1] = (around - 4 * h[1:-1, 1:-1]) / self.step_mm**2
        return bend

    def height_at(self, xy: FloatArray) -> FloatArray:
        """Interpolate heights at points (..., 2) bilinearly; NaN beyond the field."""
        (i, j), (u, v), inside = self._cells_at(xy)
        h = self.heights_mm
        below = h[i, j] * (1 - u) + h[i, j + 1] * u
        above = h[i + 1, j] * (1 - u) + h[i + 1, j + 1] * u
        return np.asarray(np.where(inside, below * (1 - v) + above * v, np.nan))

    def weights_at(self, xy: FloatArray) -> scipy.sparse.csr_array:
        """(n, ny * nx) shares of the nodes in the heights at points (n, 2), as `height_at`.

        For other heights on this grid that are asked for again and again at the same points.
        """
        (i, j), (u, v), inside = self._cells_at(xy)
        rows, columns = self.heights_mm.shape
        first = i * columns + j
        nodes = np.stack([first, first + 1, first + columns, first + columns + 1], axis=1)
        shares = np.stack([(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v], axis=1)
        shares[~inside] = np.nan
        ends = 4 * np.arange(len(xy) + 1)
        shape = len(xy), rows * columns
        return scipy.sparse.csr_array((shares.ravel(), nodes.ravel(), ends), shape)

    def _cells_at(
        self, xy: FloatArray
    ) -> tuple[tuple[IntArray, IntArray], tuple[FloatArray, FloatArray], BoolArray]:
        """Return row and column of the first nodes of cells that hold points, and places in them.

        Returns
        -------
        row, column : (...) int64
        across, along : (...) float64
            Places of the points in their cells, as shares of the step.
        inside : (...) bool
            Whether a point lies on the field.
        """
        xy = np.asarray(xy, dtype=float)
        rows, columns = self.heights_mm.shape
        column = (xy[..., 0] - self.x0_mm) / self.step_mm
        row = (xy[..., 1] - self.y0_mm) / self.step_mm
        j = np.clip(np.floor(column).astype(int), 0, columns - 2)
        i = np.clip(np.floor(row).astype(int), 0, rows - 2)
        inside = (column >= 0) & (column <= columns - 1) & (row >= 0) & (row <= rows - 1)
        return (i, j), (column - j, row - i), inside

    def triangles(self) -> IndexArray:
        """Return corner indices (m, 3) into `nodes`, counter-clockwise seen from above."""
        rows, columns = self.heights_mm.shape
        index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
        a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
        c, d = index[1:, 1:].ravel(), index[1:, :-1].ravel()
        return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def row_count(field: HeightField, end_mm: float) -> int:
    """Return how many rows of a field lie behind a place along the foot; at least one."""
    return max(1, int(np.searchsorted(field.y_mm, end_mm)))


def rows_up_to(field: HeightField, end_mm: float) -> slice:
    """Return these rows."""
    return slice(0, row_count(field, end_mm))


def heel_floor_mm(field: HeightField, length_mm: float) -> float:
    """Return the lowest height of the heel of a foot of this length."""
    return float(field.heights_mm[rows_up_to(field, HEEL_SHARE * length_mm)].min())


def heads_mm(foot: Foot) -> FloatArray:
    """Return the places (2, 2) of heads 1 and 5, mm, insole frame."""
    marks = find_landmarks(foot)
    return np.array([marks[name].point[:2] for name in (HEADS[0], HEADS[-1])])


def heads_ahead(foot: Foot) -> FloatArray:
    """Return the unit vector (2,) that points ahead, normal to the line of heads 1 and 5."""
    medial, lateral = heads_mm(foot)
    along = (medial - lateral) / np.hypot(*(medial - lateral))
    return np.array([-along[1], along[0]]) * foot.side.medial_sign


def ahead_of_heads_mm(foot: Foot, field: HeightField) -> FloatArray:
    """Return how far the nodes of a field lie ahead of the line of heads 1 and 5, (ny, nx), mm."""
    ahead, (medial, _) = heads_ahead(foot), heads_mm(foot)
    return np.asarray(ahead[0] * field.x_mm + ahead[1] * field.y_mm[:, None] - ahead @ medial)
