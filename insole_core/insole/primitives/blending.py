"""Smooth transitions between two values."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray


def smooth_step(value: FloatArray, start: float, end: float) -> FloatArray:
    """Return 0 up to `start`, 1 from `end` on, and between them a cubic with continuous slope."""
    s = np.clip((value - start) / (end - start), 0, 1)
    return np.asarray(s * s * (3 - 2 * s))


def smoother_step(value: FloatArray, start: float, end: float) -> FloatArray:
    """Return what `smooth_step` does, with continuous curvature: a polynomial of degree 5."""
    s = np.clip((value - start) / (end - start), 0, 1)
    return np.asarray(s * s * s * (10 + s * (6 * s - 15)))


def smooth_hinge(value: FloatArray, rounding: FloatArray | float) -> FloatArray:
    """Return 0 below `-rounding`, `value` above `rounding`, and between them a parabola."""
    bend = np.clip(value + rounding, 0, 2 * rounding)
    return np.asarray(bend * bend / (4 * rounding) + np.maximum(value - rounding, 0))


def gaussian_hill(share: FloatArray) -> FloatArray:
    """Return the thesis's Gaussian (25) about 0, brought to zero at 1 with continuous slope."""
    return np.asarray(np.exp(-0.5 * share * share) * (1 - smooth_step(share, 0.5, 1.0)))
