"""Where readings lie beside a sharp step, of which feet have none."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray

_ACROSS_PX = 4
"""From a step to the readings on both sides of it: half of a matching window."""
_NEAR_PX = 7
_SMOOTH_RAW, _STEP_RAW = 6.5, 9.5
"""Heights of a step up to which the surroundings count as smooth, and beyond which they do not:
about 11 and 16 mm at a distance of 780 mm."""
_OUTLINE_RAW = 40.0
"""What falls by more is the outline, against what lies far behind."""


def smoothness(raw: FloatArray) -> Float32Array:
    """Compute how far a reading lies off sharp steps, from the readings alone.

    The height of a step is what a surface falls across a pixel beyond what its slopes on both
    sides explain.

    Parameters
    ----------
    raw : (height, width) float64, raw units
        NaN = no reading.

    Returns
    -------
    (height, width) float32
        1 where there is no step, 0 beside one of 9.5 raw units and more.
    """
    highest = np.maximum(_step_heights(raw), _step_heights(raw.T).T)
    highest[highest > _OUTLINE_RAW] = 0
    near = cv2.dilate(highest, np.ones((_NEAR_PX, _NEAR_PX), np.uint8))
    return np.asarray(np.clip((_STEP_RAW - near) / (_STEP_RAW - _SMOOTH_RAW), 0, 1), np.float32)


def _step_heights(raw: FloatArray) -> Float32Array:
    """Return the heights (height, width) of steps along the columns; 0 where unknown."""
    across = _ACROSS_PX
    heights = np.zeros(raw.shape, np.float32)
    if len(raw) <= 4 * across:
        return heights
    far_before, before = raw[: -4 * across], raw[across : -3 * across]
    behind, far_behind = raw[3 * across : -across], raw[4 * across :]
    slope = np.maximum(np.abs(before - far_before), np.abs(far_behind - behind)) * 2
    heights[2 * across : -2 * across] = np.nan_to_num(np.abs(behind - before) - slope)
    return np.maximum(heights, 0)
