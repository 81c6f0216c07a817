"""A thin plate under light tension, on springs, and through heights along an edge.

It minimises the bending energy, the integral of the squared second derivatives, plus tau² times
that of the squared slope, plus the springs' energy; its border is free. Inside this is the
bi-Laplacian L² + tau² L; written with all second derivatives it is well-posed up to the free border
too. Nodes whose springs are rigid are condensed out. What is left is banded along the rim, so that
a Cholesky factorisation takes milliseconds (reverse Cuthill-McKee ordering).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.insole.primitives.height_field import HeightField

TENSION_PER_MM = 1 / 8
"""Where two zones are farther apart than its reciprocal, the plate between them is nearly flat."""
_EDGE_WEIGHT = 100.0
"""Of the squared deviation from the heights along the edge, per point and mm²: at about 1 point per
mm, bending energy moves them by some hundredths of a millimetre at most."""

# Offsets (row, column) of the nodes of a difference, and their weights times step**2 or step.
_CURVATURES = (
    (((0, -1), (0, 0), (0, 1)), (1.0, -2.0, 1.0)),
    (((-1, 0), (0, 0), (1, 0)), (1.0, -2.0, 1.0)),
    (((0, 0), (0, 1), (1, 0), (1, 1)), (2**0.5, -(2**0.5), -(2**0.5), 2**0.5)),
)
_SLOPES = ((((0, 0), (0, 1)), (-1.0, 1.0)), (((0, 0), (1, 0)), (-1.0, 1.0)))


@dataclass(frozen=True, eq=False)
class Plate:
    """The energy of a plate over some nodes of a grid, and of the points along its edge.

    Parameters
    ----------
    nodes : (ny, nx) bool
        The plate's nodes, numbered row by row.
    energy : (n, n)
        Symmetric; the gradient of the whole energy at heights (n,) is `energy @ heights`.
    from_edge : (n, m)
        From heights at the edge's points to the gradient's constant part.
    """

    nodes: BoolArray
    step_mm: float
    energy: scipy.sparse.csr_matrix
    from_edge: scipy.sparse.csr_matrix

    @classmethod
    def over(cls, field: HeightField, nodes: BoolArray, edge_points_mm: FloatArray) -> Plate:
        """Return the plate over some nodes of a field.

        Parameters
        ----------
        edge_points_mm : (m, 2) float64
            Evenly spaced points; all corners of their cells must be among the nodes.
        """
        number = np.full(nodes.shape, -1)
        number[nodes] = np.arange(nodes.sum())
        step = field.step_mm
        rows = [_differences(number, *stencil, scale=1 / step) for stencil in _CURVATURES]
        rows += [_differences(number, *stencil, scale=TENSION_PER_MM) for stencil in _SLOPES]
        stencils = scipy.sparse.vstack(rows).tocsr()
        read = _interpolation(field, number, edge_points_mm)
        weighted = _EDGE_WEIGHT * read.T
        energy = (stencils.T @ stencils + weighted @ read).tocsr()
        return cls(nodes, step, energy, weighted.tocsr())

    def on_springs(self, stiffness: FloatArray) -> SprungPlate:
        """Factorise the plate on springs to given heights.

        Parameters
        ----------
        stiffness : (ny, nx) float64
            Of the spring at each node per area, 1/mm⁴; inf where the node is fixed.
        """
        springs = stiffness[self.nodes] * self.step_mm**2
        held = np.isinf(springs)
        free, held_at = np.flatnonzero(~held), np.flatnonzero(held)
        rows = self.energy[free]
        inner = (rows[:, free] + scipy.sparse.diags_array(springs[free])).tocsr()
        order = scipy.sparse.csgraph.reverse_cuthill_mckee(inner, symmetric_mode=True)
        free = free[order]
        return SprungPlate(
            self,
            free,
            held_at,
            _cholesky(inner[order][:, order]),
            rows[order][:, held_at].tocsr(),
            self.from_edge[free].tocsr(),
            springs[free],
        )


@dataclass(frozen=True, eq=False)
class SprungPlate:
    """A plate on springs, ready to be solved for any heights of theirs.

    Parameters
    ----------
    free, held : (k,), (l,) int64
        Numbers of the nodes that move, in the order of the band, and of the fixed ones.
    factor : (width, k) float64
        Cholesky factor, lower, in band storage.
    from_held : (k, l), from_edge : (k, m)
        From heights at the fixed nodes and at the edge's points to the right-hand side.
    springs : (k,) float64
    """

    plate: Plate
    free: IntArray
    held: IntArray
    factor: FloatArray
    from_held: scipy.sparse.csr_matrix
    from_edge: scipy.sparse.csr_matrix
    springs: FloatArray

    def solve(self, goal_mm: FloatArray, edge_mm: FloatArray) -> FloatArray:
        """Return the plate's heights.

        Parameters
        ----------
        goal_mm : (ny, nx) float64
            Heights of the fixed nodes and of the springs' ends.
        edge_mm : (m,) float64
            Heights at the edge's points.

        Returns
        -------
        (n,) float64, mm
            At the plate's nodes, row by row.
        """
        heights = goal_mm[self.plate.nodes]
        pull = self.from_edge @ edge_mm - self.from_held @ heights[self.held]
        pull += self.springs * heights[self.free]
        if len(self.free):
            heights[self.free] = scipy.linalg.cho_solve_banded(
                (self.factor, True), pull, check_finite=False
            )
        return np.asarray(heights)


def _differences(
    number: IntArray,
    offsets: tuple[tuple[int, int], ...],
    weights: tuple[float, ...],
    *,
    scale: float,
) -> scipy.sparse.csr_matrix:
    """Return a row for each place of a stencil whose nodes all belong to the plate."""
    ny, nx = number.shape
    (top, left), (bottom, right) = np.min(offsets, axis=0), np.max(offsets, axis=0)
    corners = np.stack(
        [number[i - top : ny - bottom + i, j - left : nx - right + j].ravel() for i, j in offsets],
        axis=1,
    )
    corners = corners[(corners >= 0).all(axis=1)]
    return _rows(corners, np.tile(scale * np.array(weights), (len(corners), 1)), number)


def _interpolation(
    field: HeightField, number: IntArray, places: FloatArray
) -> scipy.sparse.csr_matrix:
    """Return the matrix of the bilinear interpolation at places (m, 2)."""
    at = (places - [field.x0_mm, field.y0_mm]) / field.step_mm
    (j, i), (u, v) = np.floor(at).astype(int).T, (at % 1.0).T
    corners = np.stack([number[i + a, j + b] for a, b in ((0, 0), (0, 1), (1, 0), (1, 1))], axis=1)
    shares = np.stack([(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v], axis=1)
    return _rows(corners, shares, number)


def _rows(corners: IntArray, weights: FloatArray, number: IntArray) -> scipy.sparse.csr_matrix:
    count, width = corners.shape
    ends = np.arange(count + 1) * width
    return scipy.sparse.csr_matrix(
        (weights.ravel(), corners.ravel(), ends), (count, int(number.max()) + 1)
    )


def _cholesky(matrix: scipy.sparse.csr_matrix) -> FloatArray:
    """Return the lower Cholesky factor of a banded matrix, in LAPACK's band storage."""
    entries = matrix.tocoo()
    below = entries.row - entries.col
    lower = below >= 0
    width = int(below.max(initial=0)) + 1
    band = np.zeros((width, matrix.shape[0]))
    band[below[lower], entries.col[lower]] = entries.data[lower]
    if not matrix.shape[0]:
        return band
    return np.asarray(
        scipy.linalg.cholesky_banded(band, overwrite_ab=True, lower=True, check_finite=False)
    )
