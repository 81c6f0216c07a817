"""How long a machine takes along a path, with what it needs to speed up and to slow down.

The planner of GRBL, which those of LinuxCNC and Mach3 resemble: every piece is a trapezoid of speed
within the accelerations of the axes, and a corner is passed as fast as an arc that leaves it by
`_CORNER_MM` allows (Jeon, "Improving Grbl: Cornering Algorithm", 2011).
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray

_CORNER_MM = 0.01
"""GRBL's junction deviation; the tolerance that our programs give LinuxCNC (`G64 P0.01`)."""


def motion_minutes(
    points_mm: FloatArray, speed_mm_min: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the time of each piece of a path that begins and ends at rest.

    Parameters
    ----------
    points_mm : (n, 3) float64
        Along the axes of the machine.
    speed_mm_min : (n - 1,) float64
        At which each piece is ordered.
    acceleration_mm_s2 : (3,) float64
        Of the axes.

    Returns
    -------
    (n - 1,) float64, min
        0 for a piece without length.
    """
    pieces = np.diff(points_mm, axis=0)
    length_mm = np.linalg.norm(pieces, axis=1)
    minutes = np.zeros(len(length_mm))
    moves = length_mm > 0
    if moves.any():
        along = pieces[moves] / length_mm[moves, None]
        seconds = _seconds(length_mm[moves], along, speed_mm_min[moves] / 60, acceleration_mm_s2)
        minutes[moves] = seconds / 60
    return minutes


def _seconds(
    length_mm: FloatArray, along: FloatArray, speed_mm_s: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the time in s of pieces (m,) with unit directions (m, 3) and ordered speeds (m,)."""
    acceleration = _least_over_axes(acceleration_mm_s2, along)
    corner2 = _corner_speeds2(along, speed_mm_s, acceleration_mm_s2)
    ends2 = _reached(corner2, 2 * acceleration * length_mm)
    enter, leave = np.sqrt(ends2[:-1]), np.sqrt(ends2[1:])
    peak = np.minimum(np.sqrt(acceleration * length_mm + (ends2[:-1] + ends2[1:]) / 2), speed_mm_s)
    ramps_mm = (2 * peak**2 - ends2[:-1] - ends2[1:]) / (2 * acceleration)
    level_mm = np.maximum(length_mm - ramps_mm, 0)
    return np.asarray((2 * peak - enter - leave) / acceleration + level_mm / peak)


def _least_over_axes(limit: FloatArray, along: FloatArray) -> FloatArray:
    """Return the greatest value (m,) along directions (m, 3) with no axis beyond its limit."""
    share = np.maximum(np.abs(along), 1e-9)
    return np.asarray((limit / share).min(axis=1))


def _corner_speeds2(
    along: FloatArray, speed_mm_s: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the squared speeds (m + 1,), mm²/s², that corners allow; both ends are at rest."""
    before, after = along[:-1], along[1:]
    # Sine of half the angle between the pieces: 1 goes straight on, 0 turns back.
    straight = np.sqrt(np.clip((1 + (before * after).sum(axis=1)) / 2, 0, 1))
    change = after - before
    size = np.linalg.norm(change, axis=1)
    across = np.divide(change, size[:, None], out=np.ones_like(change), where=size[:, None] > 0)
    acceleration = _least_over_axes(acceleration_mm_s2, across)
    slack = np.maximum(1 - straight, 1e-12)
    allowed2 = acceleration * _CORNER_MM * straight / slack
    slower = np.minimum(speed_mm_s[:-1], speed_mm_s[1:])
    return np.concatenate([[0.0], np.minimum(allowed2, slower**2), [0.0]])


def _reached(corner2: FloatArray, gained2: FloatArray) -> FloatArray:
    """Return the squared speeds (m + 1,), mm²/s², at the ends of pieces.

    Parameters
    ----------
    corner2 : (m + 1,) float64, mm²/s²
        Allowed at the ends.
    gained2 : (m,) float64, mm²/s²
        By which the squared speed may grow, or fall, along each piece.

    u[i] = min(corner2[i], u[i - 1] + gained2[i - 1]), then the same from the end: the least, over
    all corners passed before, of what that corner allowed and all that was gained since.
    """

    def onwards(limit2: FloatArray, gain2: FloatArray) -> FloatArray:
        total = np.concatenate([[0.0], np.cumsum(gain2)])
        return np.asarray(np.minimum.accumulate(limit2 - total) + total)

    forth = onwards(corner2, gained2)
    back = onwards(forth[::-1], gained2[::-1])[::-1]
    return np.asarray(np.clip(back, 0, None))
