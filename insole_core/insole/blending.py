"""The one way in which this product goes from one value to another without an edge."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray


def smooth_step(value: FloatArray, start: float, end: float) -> FloatArray:
    """0 up to `start`, 1 from `end` on, between them a cubic with continuous slope."""
    s = np.clip((value - start) / (end - start), 0, 1)
    return np.asarray(s * s * (3 - 2 * s))
