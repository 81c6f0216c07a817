"""Many depth frames of a still scene to one image of raw numbers."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.sensing.disparity import NO_READING

_FIRST_FRAMES = 9
_NEAR_RAW = 3.0
_BLOCK_PX = 16
_JUMP_RAW = 12.0
_MOVED_RAW = 1.0
"""A still scene changes by a fifth of this; it is 1.6 mm at 750 mm."""


def median_raw(frames: Iterable[RawArray]) -> FloatArray:
    """Take the median over the frames in which a pixel measured (thesis 5.2, 6.1).

    Parameters
    ----------
    frames : each (height, width) uint16, raw, 2047 = no reading

    Returns
    -------
    (height, width) float64, raw; NaN where fewer than half of the frames measured
    """
    # 2047 is the largest raw number, so after sorting the readings stand before the gaps.
    ordered = np.sort(np.stack(list(frames)), axis=0)
    readings = (ordered < NO_READING).sum(0)
    low = np.take_along_axis(ordered, np.maximum(readings - 1, 0)[None] // 2, axis=0)[0]
    high = np.take_along_axis(ordered, (readings // 2)[None], axis=0)[0]
    return np.where(_enough(readings, len(ordered)), (low.astype(float) + high) / 2, np.nan)


@dataclass(frozen=True, eq=False)
class RawAverage:
    """Many frames of a still scene as one.

    Parameters
    ----------
    raw : (height, width) float64, raw units; NaN where fewer than half of the frames count
    variance : (height, width) float64, raw units²
        Of the mean; NaN like `raw`.
    frames
        How many there were.
    moved
        The frames that were left out, because something in them had moved.
    motion_raw
        Largest change of a part of the picture over the frames, raw units.
    """

    raw: FloatArray
    variance: FloatArray
    frames: int
    moved: tuple[int, ...]
    motion_raw: float


def average_raw(frames: Iterable[RawArray]) -> RawAverage:
    """Take the mean over the readings near a first robust estimate, in one pass.

    The first estimate is the median of the first nine frames; readings farther than 3 raw units
    from it are outliers (the noise of the sensor is about 0.5). Holds nine frames, however many
    there are. Keeps the fractions of a raw unit that the median loses. A frame of which a part
    differs from the estimate as a whole shows something that has moved, and is left out.

    Parameters
    ----------
    frames : each (height, width) uint16, raw, 2047 = no reading
    """
    stream = iter(frames)
    first = list(islice(stream, _FIRST_FRAMES))
    anchor = median_raw(first)
    total, squares = np.zeros(anchor.shape), np.zeros(anchor.shape)
    readings = np.zeros(anchor.shape, dtype=np.int32)
    moved: list[int] = []
    motion_raw, count = 0.0, 0
    for index, frame in enumerate(chain(first, stream)):
        count += 1
        difference = np.where(frame < NO_READING, frame - anchor, np.nan)
        change = _largest_change(difference)
        motion_raw = max(motion_raw, change)
        if change > _MOVED_RAW:
            moved.append(index)
            continue
        near = np.abs(difference) <= _NEAR_RAW
        difference = np.where(near, difference, 0)
        total += difference
        squares += difference**2
        readings += near
    enough = _enough(readings, max(count - len(moved), 1))
    number = np.maximum(readings, 1)
    offset = total / number
    variance = (squares / number - offset**2) / np.maximum(number - 1, 1)
    return RawAverage(
        np.where(enough, anchor + offset, np.nan),
        np.where(enough, np.maximum(variance, 0), np.nan),
        count,
        tuple(moved),
        motion_raw,
    )


def mean_raw(frames: Iterable[RawArray]) -> FloatArray:
    """Give the mean alone of `average_raw`, (height, width) float64, raw; NaN = no reading."""
    return average_raw(frames).raw


def _largest_change(difference: FloatArray) -> float:
    """Change that a hundredth of the picture's blocks exceeds, raw units.

    The mean over a block has a twentieth of a pixel's noise; differences beyond `_JUMP_RAW` are
    the borders of things, which flicker, and blocks without enough readings tell nothing.
    """
    height, width = (size // _BLOCK_PX * _BLOCK_PX for size in difference.shape)
    blocks = difference[:height, :width].reshape(
        height // _BLOCK_PX, _BLOCK_PX, width // _BLOCK_PX, _BLOCK_PX
    )
    usable = np.abs(blocks) < _JUMP_RAW
    number = usable.sum((1, 3))
    means = np.where(usable, blocks, 0).sum((1, 3)) / np.maximum(number, 1)
    full = number >= _BLOCK_PX**2 / 2
    return float(np.percentile(np.abs(means[full]), 99)) if full.any() else 0.0


def _enough(
    readings: np.ndarray[tuple[int, ...], np.dtype[np.signedinteger]], count: int
) -> BoolArray:
    return np.asarray((readings > 0) & (2 * readings >= count))
