"""The pattern that explains pictures of known disparity: dots of light, blurred, finer than pixels.

A picture samples every row of the pattern once a pixel, walls at other distances between. The
brightness of the dots is found by expectation maximisation (Richardson & Lucy): it cannot get
negative, so the dark between the dots stays dark, which halves the noise of least squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.sensing.infrared_reference import RAW_PER_PX

FINE = 4
"""Columns of the pattern per pixel."""
_DOWN = 2
_BLUR_PX = 0.5
"""Below that of any real camera, so that sharper dots than its own are never asked for."""
_REACH_SIGMAS = 4
_SLACK_PX = 2
_PRIOR = 0.05
"""Weight of brightness 1 where no picture says anything."""
_ROWS, _COLUMNS = 480, 640


@dataclass(frozen=True, eq=False)
class _Samples:
    """Where the pixels of one picture lie in the pattern: between two of its columns.

    Parameters
    ----------
    across : (480, 640) float32, columns
    used : (480, 640) bool
        Which of them lie in it; all that follows is of these only.
    column : (n,) int64
        The one on the left of each pixel.
    place : (n,) int64
        Its index among those of all rows.
    share : (n,) float64
        How far each pixel lies from it to the next.
    """

    across: Float32Array
    used: BoolArray
    column: IntArray
    place: IntArray
    share: FloatArray


class FinePattern:
    """A pattern that is fitted to pictures of known disparity.

    Parameters
    ----------
    first_px, width_px
        Its first column and its extent.
    """

    def __init__(self, first_px: int, width_px: int) -> None:
        self.first_px = first_px
        self._columns = width_px * FINE
        self._light = np.ones((_ROWS * _DOWN, self._columns), np.float32)
        self._kernels = tuple(map(_gaussian, (_BLUR_PX * FINE, _BLUR_PX * _DOWN)))

    @staticmethod
    def holding(raws: Sequence[FloatArray]) -> FinePattern:
        """Make one that holds all places of some disparities (480, 640), raw units."""
        low, high = (float(pick([pick(raw) for raw in raws])) for pick in (np.nanmin, np.nanmax))
        first_px = int(np.floor(low / RAW_PER_PX)) - _SLACK_PX
        last_px = int(np.ceil(high / RAW_PER_PX)) + _COLUMNS + _SLACK_PX
        return FinePattern(first_px, last_px - first_px)

    @property
    def seen(self) -> Float32Array:
        """(480, columns) the pattern as the camera sees it."""
        return np.ascontiguousarray(self._blurred(self._light)[::_DOWN])

    def fit(
        self, pictures: Sequence[Float32Array], raws: Sequence[FloatArray], rounds: int
    ) -> None:
        """Improve the pattern by some rounds.

        Parameters
        ----------
        pictures : each (480, 640) float32, 1 on average
        raws : each (480, 640) float64, raw units, with the distortion; NaN = not used
        """
        samples = [self._samples(raw) for raw in raws]
        counted = self._blurred(sum((self._gathered(s, s.used) for s in samples), self._none()))
        for _ in range(rounds):
            seen, ratio = self.seen, self._none()
            for picture, sample in zip(pictures, samples, strict=True):
                ratio += self._gathered(sample, picture / self._expected(seen, sample))
            self._light *= (self._blurred(ratio) + _PRIOR) / (counted + _PRIOR)

    def coverage(self, raws: Sequence[FloatArray], least: int) -> float:
        """Return the share of the pattern's columns of every row that enough walls have reached.

        Of those that any wall has reached.
        """
        samples = [self._samples(raw) for raw in raws]
        reached = np.zeros((_ROWS, self._columns // FINE), np.int64)
        for sample in samples:
            row = np.broadcast_to(np.arange(_ROWS)[:, None], sample.used.shape)[sample.used]
            np.add.at(reached, (row, sample.column // FINE), 1)
        return float((reached >= least).sum() / max((reached > 0).sum(), 1))

    def _none(self) -> Float32Array:
        return np.zeros_like(self._light)

    def _blurred(self, light: Float32Array) -> Float32Array:
        across, down = self._kernels
        return np.asarray(
            cv2.sepFilter2D(light, -1, across, down, borderType=cv2.BORDER_REFLECT), np.float32
        )

    def _samples(self, raw: FloatArray) -> _Samples:
        across = (np.arange(_COLUMNS) + raw / RAW_PER_PX - self.first_px) * FINE
        used = (across >= 0) & (across < self._columns - 1)
        across = np.where(used, across, 0)
        within = across[used]
        column = np.floor(within).astype(np.int64)
        row = np.broadcast_to(np.arange(_ROWS)[:, None], used.shape)[used]
        place = row * self._columns + column
        return _Samples(across.astype(np.float32), used, column, place, within - column)

    def _expected(self, seen: Float32Array, sample: _Samples) -> Float32Array:
        down = np.repeat(np.arange(_ROWS, dtype=np.float32)[:, None], _COLUMNS, axis=1)
        shown = np.asarray(cv2.remap(seen, sample.across, down, cv2.INTER_LINEAR), np.float32)
        return np.maximum(shown, np.float32(1e-3))

    def _gathered(
        self, sample: _Samples, values: FloatArray | Float32Array | BoolArray
    ) -> Float32Array:
        """Give every pixel's value to the two columns beside it: the transpose of sampling."""
        value, size = values[sample.used].astype(np.float64), _ROWS * self._columns
        total = np.bincount(sample.place, value * (1 - sample.share), size)
        total[1:] += np.bincount(sample.place, value * sample.share, size)[:-1]
        spread = self._none()
        spread[::_DOWN] = total.reshape(_ROWS, self._columns)
        return spread


def _gaussian(sigma: float) -> FloatArray:
    reach = int(np.ceil(_REACH_SIGMAS * sigma))
    kernel = np.exp(-(np.arange(-reach, reach + 1) ** 2) / (2 * sigma**2))
    return np.asarray(kernel / kernel.sum())
