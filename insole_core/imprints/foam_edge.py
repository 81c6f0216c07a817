"""Find where the foam around an imprint curls over its edge, and is no sole any more."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.imprints.relief import Relief

_DEEPEST_MM = 8.0
"""Depth below the rim to which an edge can curl; a ridge between two toes lies deeper."""
_REACH_MM = 4.0
_STEEP, _EASED = 1.2, 0.6
"""Slope of a wall, and the share of it below which the foam beside its upper end curls over."""
_STEP_MM, _NOISE_MM = 0.5, 0.7


def curled_over(relief: Relief) -> BoolArray:
    """Return the nodes (ny, nx) that lie over a wall close by and are much less steep than it.

    A sole has no such edge: its arch bends over tens of millimetres.
    """
    heights = _smoothed(relief)
    slope = np.hypot(*np.gradient(heights, relief.cell_mm))
    below = _steepest_below(heights, slope, round(_REACH_MM / relief.cell_mm))
    return np.asarray((heights > -_DEEPEST_MM) & (below > _STEEP) & (slope < _EASED * below))


def _smoothed(relief: Relief) -> FloatArray:
    """Return the heights without noise; what was not measured gets the nearest height."""
    missing = np.isnan(relief.heights_mm)
    nearest = scipy.ndimage.distance_transform_edt(
        missing, return_distances=False, return_indices=True
    )
    heights = relief.heights_mm[tuple(nearest)]
    return np.asarray(scipy.ndimage.gaussian_filter(heights, _NOISE_MM / relief.cell_mm))


def _steepest_below(heights: FloatArray, slope: FloatArray, reach: int) -> FloatArray:
    """Return the greatest slope of the lower nodes within some nodes; 0 where there is none."""
    padded_heights = np.pad(heights, reach, constant_values=np.inf)
    padded_slope = np.pad(slope, reach)
    rows, columns = heights.shape
    steepest = np.zeros_like(heights)
    for i in range(2 * reach + 1):
        for j in range(2 * reach + 1):
            if (i - reach) ** 2 + (j - reach) ** 2 > reach**2:
                continue
            window = slice(i, i + rows), slice(j, j + columns)
            lower = padded_heights[window] < heights - _STEP_MM
            steepest = np.maximum(steepest, np.where(lower, padded_slope[window], 0.0))
    return steepest
