"""Offsets of a height field by a ball: shells of even thickness, and hollows too tight to mill."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.height_field import HeightField

PITCH_MM = 0.5
"""Between the points of a surface that a ball may touch."""


def parallel_below(
    field: HeightField, distance_mm: float, pitch_mm: float = PITCH_MM
) -> FloatArray:
    """Compute the highest surface that keeps a distance from the field and stays above z = 0.

    It is the erosion of the field by a ball of that radius: no point is nearer than the distance,
    and no loop can arise in a hollow. Between the nodes of a coarse field the ball touches it too.

    Parameters
    ----------
    pitch_mm
        Greatest distance of the points that the ball may touch; a larger one is faster.

    Returns
    -------
    (ny, nx) float64, mm
        Heights at the nodes of the field.
    """
    pieces = int(np.ceil(field.step_mm / pitch_mm))
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
    reach = int(radius_mm / step_mm)
    ring = np.pad(heights_mm, reach, mode="edge")
    # Each of these is contiguous, which is twice as fast as strided parts of the ring.
    grids = {
        (i, j): np.ascontiguousarray(ring[i::every, j::every])
        for i in range(every)
        for j in range(every)
    }
    rows, columns = (-(-count // every) for count in heights_mm.shape)
    lowest = np.full((rows, columns), np.inf)
    for below_mm, offsets in _ball(reach, step_mm, radius_mm):
        parts = []
        for i, j in offsets:
            (down, row), (right, column) = divmod(reach + i, every), divmod(reach + j, every)
            parts.append(grids[row, column][down : down + rows, right : right + columns])
        level = parts[0] if len(parts) == 1 else np.minimum(parts[0], parts[1])
        for part in parts[2:]:
            np.minimum(level, part, out=level)
        np.minimum(lowest, level - below_mm, out=lowest)
    return lowest


def _ball(
    reach: int, step_mm: float, radius_mm: float
) -> list[tuple[float, list[tuple[int, int]]]]:
    """Return the depths of a ball below its centre, with the offsets (row, column) of each."""
    depths: dict[float, list[tuple[int, int]]] = {}
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            below2 = radius_mm**2 - (i * i + j * j) * step_mm**2
            if below2 >= 0:
                depths.setdefault(float(np.sqrt(below2)), []).append((i, j))
    return list(depths.items())
