"""The grid of blocks on which the distortion map is solved, and its interpolation to pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from insole_core.calibration.walls.wall_plane import WallFit
from insole_core.geometry.arrays import BoolArray, FloatArray

BLOCK_PX = 8


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
