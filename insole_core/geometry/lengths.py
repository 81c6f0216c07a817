"""Lengths of many vectors at once."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray


def lengths(vectors: FloatArray) -> FloatArray:
    """Return the lengths (...) of vectors (..., 3).

    Coordinate by coordinate, which gives the same bits as numpy's norm: its sums along an axis of
    three take four times as long.
    """
    x, y, z = (vectors[..., axis] for axis in range(3))
    return np.asarray(np.sqrt(x * x + y * y + z * z))
