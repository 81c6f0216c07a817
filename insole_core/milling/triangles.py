"""Heights of triangles on the nodes of a grid."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray, IntArray

_OFF_LATTICE = 1.7e-3
"""Share of a step by which the nodes lie beside round numbers, on which edges often lie."""
Heights = TypeVar("Heights", Float32Array, FloatArray)


def raise_to_triangles(
    corners_mm: FloatArray, first_mm: FloatArray, step_mm: float, heights: Heights
) -> None:
    """Raise heights (nx, ny), mm, to those of triangles (n, 3, 3) above the same nodes.

    Each triangle is cut by the lines of the grid; between its two edges on a line, the nodes get
    the height of its plane.

    Parameters
    ----------
    first_mm : (2,) float64
        x and y of the node [0, 0].
    """
    corners = corners_mm.copy()
    corners[:, :, :2] = (corners[:, :, :2] - first_mm) / step_mm - _OFF_LATTICE
    order = np.argsort(corners[:, :, 0], axis=1, kind="stable")
    a, b, c = np.moveaxis(np.take_along_axis(corners, order[:, :, None], axis=1), 1, 0)
    first = np.maximum(np.ceil(a[:, 0]).astype(int), 0)
    last = np.minimum(np.floor(c[:, 0]).astype(int), heights.shape[0] - 1)
    of, line = _counted(first, last)
    beyond = (line > b[of, 0])[:, None]
    one = _along(a[of], c[of], line)
    other = _along(np.where(beyond, b[of], a[of]), np.where(beyond, c[of], b[of]), line)
    swap = (other[:, 0] < one[:, 0])[:, None]
    low, high = np.where(swap, other, one), np.where(swap, one, other)
    start = np.maximum(np.ceil(low[:, 0]).astype(int), 0)
    end = np.minimum(np.floor(high[:, 0]).astype(int), heights.shape[1] - 1)
    piece, node = _counted(start, end)
    width = np.maximum(high[piece, 0] - low[piece, 0], 1e-12)
    share = (node - low[piece, 0]) / width
    level = low[piece, 1] * (1 - share) + high[piece, 1] * share
    np.maximum.at(heights, (line[piece], node), level.astype(heights.dtype))


def _counted(first: IntArray, last: IntArray) -> tuple[IntArray, IntArray]:
    """Return the owner of each whole number of the ranges from first to last, and the number."""
    counts = np.maximum(last - first + 1, 0)
    owner = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, first[owner] + within


def _along(start: FloatArray, end: FloatArray, x: IntArray) -> FloatArray:
    """Return y and z (n, 2) at x of straight pieces (n, 3) that do not fall along x."""
    length = end[:, 0] - start[:, 0]
    share = ((x - start[:, 0]) / np.where(length > 0, length, 1))[:, None]
    return np.asarray(start[:, 1:] * (1 - share) + end[:, 1:] * share)
