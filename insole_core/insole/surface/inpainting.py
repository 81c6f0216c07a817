"""Smooth continuation of a height field into unmeasured nodes.

Solves Laplace's equation with the measured nodes held and a free outer edge: a soap film through
the known heights. It neither steps at the seam nor overshoots (maximum principle). Solved from
coarse to fine (nested iteration), so the cost is proportional to the number of nodes. The coarse
nodes are those with even absolute index, so that a mirrored field has the mirrored result.
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray

_SWEEPS = 20
_COARSEST_NODES = 9


def fill(heights_mm: FloatArray, known: BoolArray, first: tuple[int, int]) -> FloatArray:
    """Fill the unknown nodes smoothly; the known ones keep their height to the bit.

    Parameters
    ----------
    heights_mm, known : (ny, nx)
        At least one node must be known.
    first
        Absolute index (row, column) of the first node: its position divided by the step.

    Returns
    -------
    (ny, nx) float64, mm
        Every height lies within the range of the known ones.
    """
    if known.all():
        return heights_mm
    held = np.where(known, heights_mm, 0.0)
    if min(known.shape) <= 2 or known.size <= _COARSEST_NODES:
        guess = np.full(known.shape, held.sum() / known.sum())
    else:
        guess = _from_coarser(held, known, first)
    return _relax(np.where(known, held, guess), ~known, first)


def _from_coarser(held: FloatArray, known: BoolArray, first: tuple[int, int]) -> FloatArray:
    """Solve on every second node and interpolate back."""
    rows, columns = known.shape
    pad = [(at % 2, (at + size - 1) % 2) for at, size in zip(first, known.shape, strict=True)]
    weight = _restrict(np.pad(known.astype(float), pad))
    total = _restrict(np.pad(held, pad))
    coarse_known = weight > 0
    mean = np.divide(total, weight, out=np.zeros_like(total), where=coarse_known)
    coarse_first = ((first[0] - pad[0][0]) // 2, (first[1] - pad[1][0]) // 2)
    fine = _prolong(fill(mean, coarse_known, coarse_first))
    return fine[pad[0][0] :, pad[1][0] :][:rows, :columns]


def _restrict(fine: FloatArray) -> FloatArray:
    """Sum the neighbourhood of every second node with the weights 1 2 1 along both axes."""
    ring = np.pad(fine, 1)
    rows = ring[:-2:2] + 2 * ring[1:-1:2] + ring[2::2]
    return np.asarray(rows[:, :-2:2] + 2 * rows[:, 1:-1:2] + rows[:, 2::2])


def _prolong(coarse: FloatArray) -> FloatArray:
    """Interpolate linearly to twice the number of intervals."""
    rows, columns = coarse.shape
    fine = np.empty((2 * rows - 1, 2 * columns - 1))
    fine[::2, ::2] = coarse
    fine[1::2, ::2] = (coarse[:-1] + coarse[1:]) / 2
    fine[:, 1::2] = (fine[:, :-2:2] + fine[:, 2::2]) / 2
    return fine


def _relax(heights: FloatArray, free: BoolArray, first: tuple[int, int]) -> FloatArray:
    """Run red-black Gauss-Seidel on the free nodes, with zero slope across the outer edge."""
    rows, columns = heights.shape
    even = (np.arange(rows)[:, None] + np.arange(columns) + sum(first)) % 2 == 0
    colors = (free & even, free & ~even)
    for _ in range(_SWEEPS):
        for color in colors:
            ring = np.pad(heights, 1, mode="edge")
            mean = (ring[:-2, 1:-1] + ring[2:, 1:-1] + (ring[1:-1, :-2] + ring[1:-1, 2:])) / 4
            heights = np.where(color, mean, heights)
    return heights
