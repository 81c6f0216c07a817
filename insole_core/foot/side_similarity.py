"""How similar a surface, seen from below, is to a left or a right foot.

A foot of the usual proportions is described by its borders and its arch, in shares of its length;
the lower side of a scan is drawn on the same coarse raster, and the mean difference of the two is
the dissimilarity. The mirrored raster is the other foot.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side

# All in shares of the foot's length. Medial is +x: a left foot.
_BORDERS = np.array(
    [  # y, medial x, lateral x
        (0.00, 0.020, -0.020),
        (0.02, 0.070, -0.070),
        (0.05, 0.100, -0.100),
        (0.10, 0.125, -0.125),
        (0.20, 0.130, -0.145),
        (0.30, 0.120, -0.155),
        (0.40, 0.115, -0.165),
        (0.50, 0.120, -0.180),
        (0.60, 0.145, -0.200),
        (0.70, 0.170, -0.210),
        (0.76, 0.180, -0.195),
        (0.85, 0.170, -0.150),
        (0.92, 0.170, -0.090),
        (0.97, 0.150, -0.030),
        (1.00, 0.110, 0.020),
    ]
)
_ARCH_Y, _ARCH_WIDTH, _ARCH_HEIGHT = 0.42, 0.12, 0.09
_RIM_HEIGHT = 0.05
_TIP_HEIGHT = 0.03

_STEP = 0.025
_HALF_WIDTH = 0.35
_OVERHANG = 0.1
HEIGHT_LIMIT = 0.125
"""Height over the ground, in shares of the length, from which on a cell counts as empty."""

_X_AXIS = np.arange(-_HALF_WIDTH, _HALF_WIDTH + _STEP / 2, _STEP)
_Y_AXIS = np.arange(-_OVERHANG, 1 + _OVERHANG + _STEP / 2, _STEP)


@cache
def usual_foot(side: Side) -> FloatArray:
    """Return the heights (rows, columns) of the usual foot's lower side, in shares of its length.

    HEIGHT_LIMIT where there is none; the middle lies on x = 0.
    """
    heights = _left_foot(0.0)
    heights = _left_foot(_middle(heights))
    return heights if side is Side.LEFT else heights[:, ::-1]


def lower_side(points: FloatArray, length_mm: float) -> FloatArray:
    """Draw the lower side of a surface on the raster of `usual_foot`, its middle on x = 0.

    Parameters
    ----------
    points : (n, 3) float64, mm
        Samples of the surface; heel at y = 0, ground at z = 0.
    length_mm
        Of the foot.

    Returns
    -------
    (rows, columns) float64
        Lowest height in every cell, in shares of the length; HEIGHT_LIMIT where it is empty.
    """
    scaled = points / length_mm
    return _draw(scaled - np.array([_middle(_draw(scaled)), 0.0, 0.0]))


def side_dissimilarity(drawn: FloatArray, side: Side) -> float:
    """Compute the dissimilarity from the usual foot of a side; 0 is identical.

    Parameters
    ----------
    drawn : (rows, columns) float64
        From `lower_side`.
    side

    Returns
    -------
    float
        Mean difference, relative to the volume of the usual foot.
    """
    usual = usual_foot(side)
    return float(np.abs(drawn - usual).sum() / (HEIGHT_LIMIT - usual).sum())


def foot_borders(share: FloatArray) -> FloatArray:
    """Return medial and lateral x (2, ...) of a usual left foot at shares of its length; medial +x.

    All in shares of the length.
    """
    return np.stack([np.interp(share, _BORDERS[:, 0], _BORDERS[:, side]) for side in (1, 2)])


def _left_foot(middle: float) -> FloatArray:
    x, y = np.meshgrid(_X_AXIS + middle, _Y_AXIS)
    medial, lateral = foot_borders(y)
    across = (medial - x) / (medial - lateral)  # 0 at the medial border, 1 at the lateral one
    arch = _ARCH_HEIGHT * np.exp(-(((y - _ARCH_Y) / _ARCH_WIDTH) ** 2)) * np.clip(1 - across, 0, 1)
    rim = _RIM_HEIGHT * np.abs(2 * across - 1) ** 6
    tip = _TIP_HEIGHT * np.clip((y - 0.85) / 0.15, 0, 1) ** 2
    inside = (across >= 0) & (across <= 1) & (y >= 0) & (y <= 1)
    return np.where(inside, np.minimum(arch + rim + tip, HEIGHT_LIMIT), HEIGHT_LIMIT)


def _draw(scaled: FloatArray) -> FloatArray:
    """Return the lowest height in every cell of the raster."""
    column = np.rint((scaled[:, 0] - _X_AXIS[0]) / _STEP).astype(int)
    row = np.rint((scaled[:, 1] - _Y_AXIS[0]) / _STEP).astype(int)
    inside = (row >= 0) & (row < len(_Y_AXIS)) & (column >= 0) & (column < len(_X_AXIS))
    heights = np.full(len(_Y_AXIS) * len(_X_AXIS), HEIGHT_LIMIT)
    np.minimum.at(heights, (row * len(_X_AXIS) + column)[inside], scaled[inside, 2])
    return heights.reshape(len(_Y_AXIS), len(_X_AXIS))


def _middle(heights: FloatArray) -> float:
    """Return the mean x of the cells that are not empty."""
    filled = (heights < HEIGHT_LIMIT).sum(axis=0)
    return float(filled @ _X_AXIS / max(filled.sum(), 1))
