"""Offsets of a height field by a ball: shells of even thickness, and hollows too tight to mill."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.surface.height_field import HeightField

_PITCH_MM = 0.5  # between the points of a surface that a ball may touch


def parallel_below(field: HeightField, distance_mm: float) -> FloatArray:
    """Compute the highest surface that keeps a distance from the field and stays above z = 0.

    It is the erosion of the field by a ball of that radius: no point is nearer than the distance,
    and no loop can arise in a hollow. Between the nodes of a coarse field the ball touches it too.

    Returns
    -------
    (ny, nx) float64, mm
        Heights at the nodes of the field.
    """
    pieces = int(np.ceil(field.step_mm / _PITCH_MM))
    fine, step_mm = _refined(field.heights_mm, pieces), field.step_mm / pieces
    return np.maximum(_eroded(fine, step_mm, distance_mm, every=pieces), 0.0)


def left_by_cutter(heights_mm: FloatArray, step_mm: float, radius_mm: float) -> FloatArray:
    """Compute the height of material that a ball-nose cutter from above cannot remove.

    The cutter's centre runs on the dilation of the surface by the ball; the remaining material is
    the closing of the surface minus the surface.

    Parameters
    ----------
    heights_mm : (ny, nx) float64
    step_mm
        Pitch of the grid.
    radius_mm
        Of the cutter.

    Returns
    -------
    (ny, nx) float64, mm
    """
    centres = -_eroded(-heights_mm, step_mm, radius_mm)
    return _eroded(centres, step_mm, radius_mm) - heights_mm


def _refined(heights_mm: FloatArray, pieces: int) -> FloatArray:
    """Interpolate heights linearly to this many times the number of intervals."""
    for axis in (0, 1):
        nodes = np.moveaxis(heights_mm, axis, 0)
        share = (np.arange((len(nodes) - 1) * pieces + 1) / pieces)[:, None]
        first = np.minimum(share.astype(int)[:, 0], len(nodes) - 2)
        over = share - first[:, None]
        heights_mm = np.moveaxis(nodes[first] * (1 - over) + nodes[first + 1] * over, 0, axis)
    return heights_mm


def _eroded(heights_mm: FloatArray, step_mm: float, radius_mm: float, every: int = 1) -> FloatArray:
    """Return the centre height of a ball that touches the surface from below, at its nodes.

    With `every`, only at each such node of a row and of a column.
    """
    rows, columns = heights_mm.shape
    reach = int(radius_mm / step_mm)
    ring = np.pad(heights_mm, reach, mode="edge")
    lowest = np.full_like(heights_mm[::every, ::every], np.inf)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            below2 = radius_mm**2 - (i * i + j * j) * step_mm**2
            if below2 >= 0:
                first_row, first_column = reach + i, reach + j
                part = ring[
                    first_row : first_row + rows : every,
                    first_column : first_column + columns : every,
                ]
                np.minimum(lowest, part - np.sqrt(below2), out=lowest)
    return lowest
