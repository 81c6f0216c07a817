"""A smooth map that varies with disparity, solved on blocks together with every wall's plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import cv2
import numpy as np
import scipy

from insole_core.calibration.walls.wall_plane import WallFit
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.sensing.correction import decay_lever

BLOCK_PX = 8
SPAN_RAW = 100.0
"""Raw units per unit of l."""
_ROUNDS = 3
_MOST_DECAY = 1.0
"""No lens distortion falls faster than to a third in a hundred raw units."""
_GAUGE = 1e-4
"""Weight that holds the one plane which walls of unknown position cannot determine."""
_CUT = 6.0
_LEAST_NOISE_RAW = 0.3
"""Least scale for judging outliers: the map itself is not more accurate."""
_PROBE_STEP = 16
"""Step in blocks: the variance is smooth, and every probe costs a solution."""


@dataclass(frozen=True, eq=False)
class MapBlocks:
    """Residuals of n captures, averaged over blocks of 8 x 8 pixels.

    Averaging bridges the column bands and the centre line of the device, which are narrower than
    the distortion and move with the distance.

    Parameters
    ----------
    residual : (n, blocks) float64, raw units
        Measured minus expected raw number.
    weight : (n, blocks) float64
        Share of the block that shows the wall.
    level : (n, blocks) float64, raw units
        The measured raw number, at which a correction is applied.
    rows : (blocks, 3) float64
        The row (x, y, 1) at each block's centre.
    free_plane : (n,) bool
        Whether a capture's plane is still to be adjusted.
    shape
        Rows and columns of blocks.
    """

    residual: FloatArray
    weight: FloatArray
    level: FloatArray
    rows: FloatArray
    free_plane: BoolArray
    shape: tuple[int, int]


def blocks_of(walls: Sequence[WallFit], rows: FloatArray) -> MapBlocks:
    """Average the residuals of the captures over blocks.

    Parameters
    ----------
    rows : (480, 640, 3) from `plane_rows`
    """
    weight = np.stack([_means(wall.wall.astype(float)) for wall in walls])
    residual = np.stack([_means(np.nan_to_num(wall.residual_raw)) for wall in walls])
    expected = np.stack([_means(np.nan_to_num(wall.expected_raw)) for wall in walls])
    residual = np.divide(residual, weight, out=np.zeros_like(weight), where=weight > 0)
    return MapBlocks(
        residual=residual,
        weight=weight,
        level=expected + residual,
        rows=np.stack([_means(rows[..., axis]) for axis in range(3)], axis=-1),
        free_plane=np.array([wall.capture.plane is None for wall in walls]),
        shape=(rows.shape[0] // BLOCK_PX, rows.shape[1] // BLOCK_PX),
    )


def bending(shape: tuple[int, int]) -> scipy.sparse.csc_array:
    """Return the quadratic form of the squared second differences of a map of blocks."""
    height, width = shape
    across, down = scipy.sparse.eye_array(width), scipy.sparse.eye_array(height)
    operator = scipy.sparse.vstack(
        [
            scipy.sparse.kron(down, _differences(width, (1.0, -2.0, 1.0))),
            scipy.sparse.kron(_differences(height, (1.0, -2.0, 1.0)), across),
            np.sqrt(2.0)
            * scipy.sparse.kron(
                _differences(height, (-1.0, 1.0)), _differences(width, (-1.0, 1.0))
            ),
        ]
    )
    return scipy.sparse.csc_array(operator.T @ operator)


def to_pixels(values: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """Interpolate one value per block to every pixel; the border is extrapolated along its slope.

    Parameters
    ----------
    values : (blocks,) float64
    shape
        Rows and columns of blocks.

    Returns
    -------
    (height, width) float64
    """
    padded = np.pad(values.reshape(shape), 1, mode="reflect", reflect_type="odd")
    size = (padded.shape[1] * BLOCK_PX, padded.shape[0] * BLOCK_PX)
    fine = cv2.resize(padded, size, interpolation=cv2.INTER_CUBIC)
    return np.asarray(fine[BLOCK_PX:-BLOCK_PX, BLOCK_PX:-BLOCK_PX])


def _means(image: FloatArray) -> FloatArray:
    height, width = image.shape
    blocks = image.reshape(height // BLOCK_PX, BLOCK_PX, width // BLOCK_PX, BLOCK_PX)
    return np.asarray(blocks.mean(axis=(1, 3)).ravel())


def _differences(count: int, stencil: tuple[float, ...]) -> scipy.sparse.dia_array:
    rows = count - len(stencil) + 1
    return scipy.sparse.diags_array(
        [np.full(rows, value) for value in stencil],
        offsets=list(range(len(stencil))),
        shape=(rows, count),
    )


@dataclass(frozen=True)
class Smoothing:
    """Stiffness of the map.

    Parameters
    ----------
    offset, slope
        Weight of the squared second differences between blocks, relative to one full block.
    slope_shrink
        Weight that pulls the slope towards the decay of the whole map, where the walls do not
        determine it.
    """

    offset: float = 0.5
    slope: float = 3.0
    slope_shrink: float = 0.3


class _Factor(Protocol):
    """A factorised symmetric matrix."""

    def solve(self, right: FloatArray) -> FloatArray: ...


@dataclass(frozen=True, eq=False)
class BlockMap:
    """A solved distortion map.

    Parameters
    ----------
    offset : (blocks,) float64, raw units, at `reference_raw`
    slope : (blocks,) float64, raw units per `SPAN_RAW`
    noise_raw
        Robust standard deviation of a block.
    decay
        The k that bends the slope, per `SPAN_RAW`: Herrera's exponent.
    remaining : (n, blocks) float64, raw units
        Residuals after map and planes.
    weight : (n, blocks) float64
        How much each of them counts.
    shape
        Rows and columns of blocks.
    factor
        The factorised normal matrix.
    """

    offset: FloatArray
    slope: FloatArray
    reference_raw: float
    noise_raw: float
    decay: float
    remaining: FloatArray
    weight: FloatArray
    shape: tuple[int, int]
    factor: _Factor

    @cached_property
    def deviation(self) -> FloatArray:
        """(blocks,) float64, raw units: standard deviation of a corrected block.

        It holds the uncertainty of the map, and the residuals of the walls there.
        """
        unit = _unit_std(self.factor, self.shape, 2 * len(self.offset))
        return _std(self.remaining, self.weight, unit)


def solve_map(blocks: MapBlocks, smoothing: Smoothing) -> BlockMap:
    """Solve for map and planes by iteratively reweighted least squares (Tukey).

    Parameters
    ----------
    blocks
        Residuals of all walls, from `blocks_of`.

    Returns
    -------
    BlockMap
        Raw units; one value per block.
    """
    reference = float(np.average(blocks.level, weights=blocks.weight))
    level = (blocks.level - reference) / SPAN_RAW
    stiffness = bending(blocks.shape)
    weight = blocks.weight
    count = blocks.weight.shape[1]
    offset, slope = np.zeros(count), np.zeros(count)
    planes = np.zeros((len(weight), 3))
    for number in range(_ROUNDS):
        decay = _common_decay(offset, slope)
        t = decay_lever(level, decay)
        factor = _factor(weight, t, stiffness, smoothing, decay)
        # The planes hardly move while the weights converge, and they are the costly part.
        if number in (0, _ROUNDS - 1):
            unknowns, planes = _solve(factor, blocks, weight, t)
        else:
            unknowns = _solve_map_alone(factor, blocks.residual - planes @ blocks.rows.T, weight, t)
        offset, slope = unknowns[:count], unknowns[count:]
        remaining = blocks.residual - offset - slope * t - planes @ blocks.rows.T
        noise = _noise(remaining, blocks.weight)
        cut = _CUT * max(noise, _LEAST_NOISE_RAW)
        weight = blocks.weight * np.clip(1 - (remaining / cut) ** 2, 0, None) ** 2
    if blocks.free_plane.all():
        offset, slope = (_without_plane(part, blocks) for part in (offset, slope))
    return BlockMap(offset, slope, reference, noise, decay, remaining, weight, blocks.shape, factor)


def _factor(
    weight: FloatArray,
    t: FloatArray,
    stiffness: scipy.sparse.csc_array,
    smoothing: Smoothing,
    decay: float,
) -> _Factor:
    """Factorise the normal matrix of the map for given planes.

    The last term is slope_shrink (S + decay D)².
    """
    unit = smoothing.slope_shrink * scipy.sparse.eye_array(weight.shape[1])
    cross = _diagonal((weight * t).sum(0)) + decay * unit
    gauge = _GAUGE * len(weight)
    normal = scipy.sparse.block_array(
        [
            [
                _diagonal(weight.sum(0) + gauge) + smoothing.offset * stiffness + decay**2 * unit,
                cross,
            ],
            [cross, _diagonal((weight * t * t).sum(0)) + smoothing.slope * stiffness + unit],
        ],
        format="csc",
    )
    factor: _Factor = scipy.sparse.linalg.splu(
        normal,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    return factor


def _solve(
    factor: _Factor, blocks: MapBlocks, weight: FloatArray, t: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Eliminate the map, solve for the planes, then for the map.

    Return the map's unknowns, and a correction (n, 3) of every plane.
    """
    weighted = weight * blocks.residual
    alone = _solve_map_alone(factor, blocks.residual, weight, t)
    planes = np.zeros((len(weight), 3))
    free = np.flatnonzero(blocks.free_plane)
    if not len(free):
        return alone, planes
    rows = blocks.rows
    coupling = np.concatenate(
        [
            np.concatenate([weight[i][:, None] * rows, (weight[i] * t[i])[:, None] * rows])
            for i in free
        ],
        axis=1,
    )
    answer = factor.solve(coupling)
    normal = -coupling.T @ answer
    right = -coupling.T @ alone
    for place, i in enumerate(free):
        part = slice(3 * place, 3 * place + 3)
        normal[part, part] += rows.T @ (weight[i][:, None] * rows)
        right[part] += rows.T @ weighted[i]
    solved = np.linalg.lstsq(normal, right, rcond=1e-12)[0]
    planes[free] = solved.reshape(-1, 3)
    return alone - answer @ solved, planes


def _solve_map_alone(
    factor: _Factor, residual: FloatArray, weight: FloatArray, t: FloatArray
) -> FloatArray:
    """Solve for the map's unknowns with the planes held."""
    weighted = weight * residual
    return factor.solve(np.concatenate([weighted.sum(0), (weighted * t).sum(0)]))


def _without_plane(values: FloatArray, blocks: MapBlocks) -> FloatArray:
    """Remove the plane that walls of unknown position cannot determine: its gauge is weak."""
    weight = np.sqrt(blocks.weight.sum(0))
    plane = np.linalg.lstsq(blocks.rows * weight[:, None], values * weight, rcond=None)[0]
    return np.asarray(values - blocks.rows @ plane)


def _noise(remaining: FloatArray, weight: FloatArray) -> float:
    """Robust standard deviation of the blocks that are mostly wall."""
    seen = remaining[weight > 0.5]
    if not len(seen):
        return 1.0
    return 1.4826 * float(np.median(np.abs(seen)))


def _common_decay(offset: FloatArray, slope: FloatArray) -> float:
    """Return the k of S = -k D that fits all blocks best; a distortion never grows with raw."""
    power = float(offset @ offset)
    return float(np.clip(-(slope @ offset) / power, 0, _MOST_DECAY)) if power > 0 else 0.0


def _std(remaining: FloatArray, weight: FloatArray, unit: FloatArray) -> FloatArray:
    """Combine the map's own uncertainty and its lack of fit in each block."""
    power = (weight * remaining**2).sum(0)
    overall = power.sum() / weight.sum()
    lack = (power + overall) / (weight.sum(0) + 1)
    return np.asarray(np.sqrt(overall * unit**2 + lack))


def _unit_std(factor: _Factor, shape: tuple[int, int], unknowns: int) -> FloatArray:
    """Return the root of the inverse normal matrix's diagonal, interpolated between probes."""
    height, width = shape
    down = np.append(np.arange(0, height - 1, _PROBE_STEP), height - 1)
    across = np.append(np.arange(0, width - 1, _PROBE_STEP), width - 1)
    probed = (down[:, None] * width + across).ravel()
    right = np.zeros((unknowns, len(probed)))
    right[probed, np.arange(len(probed))] = 1
    variance = factor.solve(right)[probed, np.arange(len(probed))]
    coarse = np.sqrt(np.maximum(variance, 0)).reshape(len(down), len(across))
    along = np.stack([np.interp(np.arange(width), across, row) for row in coarse])
    full = np.stack([np.interp(np.arange(height), down, column) for column in along.T], axis=1)
    return np.asarray(full.ravel())


def _diagonal(values: FloatArray) -> scipy.sparse.dia_array:
    return scipy.sparse.diags_array([values], offsets=[0])
