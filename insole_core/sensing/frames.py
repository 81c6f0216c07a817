"""Many depth frames of a still scene to one image of raw numbers."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, islice

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.sensing.disparity import NO_READING

_FIRST_FRAMES = 9
_NEAR_RAW = 3.0


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


def mean_raw(frames: Iterable[RawArray]) -> FloatArray:
    """Take the mean over the readings near a first robust estimate, in one pass.

    The first estimate is the median of the first nine frames; readings farther than 3 raw units
    from it are outliers (the noise of the sensor is about 0.5). Holds nine frames, however many
    there are. Keeps the fractions of a raw unit that the median loses.

    Parameters
    ----------
    frames : each (height, width) uint16, raw, 2047 = no reading

    Returns
    -------
    (height, width) float64, raw; NaN where fewer than half of the frames count
    """
    stream = iter(frames)
    first = list(islice(stream, _FIRST_FRAMES))
    anchor = median_raw(first)
    total = np.zeros(anchor.shape)
    readings = np.zeros(anchor.shape, dtype=np.int32)
    count = 0
    for frame in chain(first, stream):
        near = np.abs(frame - anchor) <= _NEAR_RAW
        total += np.where(near, frame, 0)
        readings += near
        count += 1
    mean = np.divide(total, readings, out=np.full(anchor.shape, np.nan), where=readings > 0)
    return np.where(_enough(readings, count), mean, np.nan)


def _enough(
    readings: np.ndarray[tuple[int, ...], np.dtype[np.signedinteger]], count: int
) -> BoolArray:
    return np.asarray((readings > 0) & (2 * readings >= count))
