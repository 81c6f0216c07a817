"""Edges of a triangulation along contour lines, so that what bends along them has no facets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray

_ON_LINE_MM = 0.01
"""A vertex as near to a contour line as this counts as on it, so that no sliver arises."""


@dataclass(frozen=True, eq=False)
class Split:
    """New vertices between two earlier ones each.

    Parameters
    ----------
    ends : (k, 2) int32
        Indices of the earlier vertices.
    share : (k,) float64
        Position between them, 0 at the first.
    """

    ends: IndexArray
    share: FloatArray

    def carry(self, values: FloatArray) -> FloatArray:
        """Append the new vertices' values to those of the earlier ones (n, ...)."""
        first, last = values[self.ends[:, 0]], values[self.ends[:, 1]]
        share = self.share.reshape(-1, *(1,) * (values.ndim - 1))
        return np.concatenate([values, first + share * (last - first)])


def split_along(
    triangles: IndexArray, values: FloatArray, level: float
) -> tuple[Split, IndexArray]:
    """Split triangles where a value that is linear in each of them passes a level.

    Parameters
    ----------
    triangles : (m, 3) int32
        Counter-clockwise.
    values : (n,) float64, mm
        Of the vertices.

    Returns
    -------
    split : Split
        The new vertices, numbered from n on.
    triangles : (m + k, 3) int32
        Counter-clockwise; neighbours still share their edges.
    """
    over = values - level
    side = np.where(np.abs(over) <= _ON_LINE_MM, 0, np.sign(over)).astype(np.int8)
    first, second, third = (side[corner] for corner in triangles.T)
    is_cut = np.minimum(np.minimum(first, second), third) < 0
    is_cut &= np.maximum(np.maximum(first, second), third) > 0
    cut = triangles[is_cut]
    sides = side[cut]
    touched = (sides == 0).any(axis=1)
    crossed = ~touched
    alone = _rolled(cut[crossed], sides[crossed] == -sides[crossed].sum(axis=1)[:, None])
    on_line = _rolled(cut[touched], sides[touched] == 0)
    pairs = np.concatenate([alone[:, [0, 1]], alone[:, [0, 2]], on_line[:, [1, 2]]])
    key = pairs.min(axis=1).astype(np.int64) * len(values) + pairs.max(axis=1)
    key, number = np.unique(key, return_inverse=True)
    ends = np.stack(np.divmod(key, len(values)), axis=1)
    new = (len(values) + number.ravel()).astype(np.int32)
    count = len(alone)
    on_second, on_third, on_opposite = new[:count], new[count : 2 * count], new[2 * count :]
    (a, b, c), (d, e, f) = alone.T, on_line.T
    # From the nearer corner, whatever the order: a mirror image is cut in the same way.
    second_is_near = np.abs(over[b]) < np.abs(over[c])
    parts = [
        triangles[~is_cut],
        np.stack([a, on_second, on_third], axis=1),
        np.stack([b, c, np.where(second_is_near, on_third, on_second)], axis=1),
        np.stack([on_third, on_second, np.where(second_is_near, b, c)], axis=1),
        np.stack([d, e, on_opposite], axis=1),
        np.stack([d, on_opposite, f], axis=1),
    ]
    start, end = values[ends[:, 0]], values[ends[:, 1]]
    split = Split(ends.astype(np.int32), (level - start) / (end - start))
    return split, np.concatenate(parts).astype(np.int32, copy=False)


def _rolled(triangles: IndexArray, chosen: IntArray) -> IndexArray:
    """Turn triangles so that the chosen corner, one for each, comes first."""
    first = chosen.argmax(axis=1)
    return np.asarray(np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1))
