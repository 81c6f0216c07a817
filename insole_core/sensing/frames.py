"""Average many depth frames of a still scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, islice

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, RawArray
from insole_core.sensing.disparity import NO_READING

Int16Array = np.ndarray[tuple[int, ...], np.dtype[np.int16]]
Int32Array = np.ndarray[tuple[int, ...], np.dtype[np.int32]]

_FIRST_FRAMES = 9
_NEAR_RAW = 3.0
_BLOCK_PX = 16
_ROW_STEP = 2
"""Every second row shows motion as well, in half of the time."""
_JUMP_RAW = 12.0
_MOVED_RAW = 1.2
"""A still scene seems to change by up to two thirds of this; it is 1.9 mm at 750 mm."""
_WIDE_BLOCK_PX = 32
_MOVED_PX = 1.2
"""A still scene seems to shift by up to half of this; it is 1.5 mm at 750 mm."""
_SMOOTH_PX = 9
_CHANGED_RAW = 0.6
"""Four times the noise of a mean of so many pixels."""
_EVERY_PX = 3
_LEAST_CHANGED = 60
_ROBUST_ROUNDS_RAW = (3.0, 2.0, 1.0, 0.7, 0.5, 0.5)
_LEAST_EXPLAINED = 0.5
_STEEPEST_RAW = 2.0
_LEAST_GRADIENT = 0.04
"""Squared disparity gradient, raw²/px², below which a block hardly shows a shift."""


def median_raw(frames: Iterable[RawArray], per_raw: int = 1) -> FloatArray:
    """Take the median over the frames in which a pixel measured (thesis 5.2, 6.1).

    Parameters
    ----------
    frames : each (height, width) uint16, parts of a raw unit, 2047 raw = no reading
    per_raw
        Number of these parts in a raw unit.

    Returns
    -------
    (height, width) float64, raw; NaN where fewer than half of the frames measured
    """
    # 2047 is the largest raw number, so sorting puts the readings before the gaps.
    ordered = np.stack(_sorted(list(frames)))
    readings = (ordered < NO_READING * per_raw).sum(0, dtype=np.int16)
    low, high = _picked(ordered, np.maximum(readings - 1, 0) // 2), _picked(ordered, readings // 2)
    middle = (low.astype(float) + high) / (2 * per_raw)
    return np.where(_enough(readings, len(ordered)), middle, np.nan)


def _picked(frames: RawArray, index: Int16Array) -> RawArray:
    """Take every pixel from the frame of its index, in a third of the time of numpy's own."""
    picked: RawArray = np.zeros_like(frames[0])
    for number, frame in enumerate(frames):
        np.copyto(picked, frame, where=index == number)
    return picked


def _sorted(frames: list[RawArray]) -> list[RawArray]:
    """Sort frames pixel by pixel (Batcher's odd-even merges): four times as fast as `np.sort`."""
    ordered = [np.array(frame) for frame in frames]
    spare = np.empty_like(ordered[0])
    for first, second in _exchanges(len(ordered)):
        np.minimum(ordered[first], ordered[second], out=spare)
        np.maximum(ordered[first], ordered[second], out=ordered[second])
        ordered[first], spare = spare, ordered[first]
    return ordered


def _exchanges(count: int) -> Iterator[tuple[int, int]]:
    """Yield the pairs to compare and exchange, one after the other (Knuth 5.2.2, algorithm M)."""
    run = 1
    while run < count:
        apart = run
        while apart >= 1:
            for start in range(apart % run, count - apart, 2 * apart):
                for first in range(start, min(start + apart, count - apart)):
                    if first // (2 * run) == (first + apart) // (2 * run):
                        yield first, first + apart
            apart //= 2
        run *= 2


@dataclass(frozen=True)
class Motion:
    """Translation of an object between frames, estimated from its surface.

    Parameters
    ----------
    along_u_px, along_v_px
        In the picture; 0 along a direction in which its surface is flat and no shift shows.
    nearer_raw
        Along the line of sight, raw units.
    at_raw
        Raw number at which the object was.
    """

    along_u_px: float
    along_v_px: float
    nearer_raw: float
    at_raw: float


@dataclass(frozen=True, eq=False)
class RawAverage:
    """Average of many frames of a still scene.

    Parameters
    ----------
    raw : (height, width) float64, raw units; NaN where fewer than half of the frames count
    variance : (height, width) float64, raw units²
        Of the mean; NaN like `raw`.
    frames
        Number of frames.
    moved
        Indices of the frames that were left out, because something in them had moved.
    motion_raw
        Largest change of a part of the picture over the frames, raw units.
    sideways_px
        Largest shift of a part of the picture over the frames.
    motion : optional
        Of the object that moved, in the frame that is farthest off; None where nothing moved
        or not as a whole.
    """

    raw: FloatArray
    variance: FloatArray
    frames: int
    moved: tuple[int, ...]
    motion_raw: float
    sideways_px: float = 0.0
    motion: Motion | None = None


def average_raw(frames: Iterable[RawArray], per_raw: int = 1) -> RawAverage:
    """Take the mean over the readings near a first robust estimate, in one pass.

    The first estimate is the median of the first nine frames; readings farther than 3 raw units
    from it are outliers (the noise of the sensor is about 0.5). Holds nine frames, however many
    there are. Keeps the fractions of a raw unit that the median loses. A frame of which a part
    came nearer or went sideways as a whole shows something that has moved, and is left out.

    Parameters
    ----------
    frames : each (height, width) uint16, parts of a raw unit, 2047 raw = no reading
    per_raw
        Number of these parts in a raw unit, up to 8.

    Returns
    -------
    RawAverage
        With images of (height, width).
    """
    stream = iter(frames)
    first = list(islice(stream, _FIRST_FRAMES))
    scene = _StillScene(median_raw(first, per_raw), per_raw)
    shape = scene.anchor.shape
    sums = _Sums(shape, scene.steps)
    moved: list[int] = []
    motion_raw, sideways_px, farthest, count = 0.0, 0.0, 0.0, 0
    motion = None
    for index, frame in enumerate(chain(first, stream)):
        count += 1
        halves, valid = scene.compare(frame)
        change, shift = scene.changes(halves, valid)
        motion_raw, sideways_px = max(motion_raw, change), max(sideways_px, shift)
        off = max(change / _MOVED_RAW, shift / _MOVED_PX)
        if off > 1:
            moved.append(index)
            if off > farthest:
                farthest, motion = off, scene.motion(halves, valid)
            continue
        near = valid & (np.abs(halves) <= scene.steps * _NEAR_RAW)
        halves *= near
        sums.add(halves, near)
    total, squares, readings = sums.totals()
    enough = _enough(readings, max(count - len(moved), 1))
    number = np.maximum(readings, 1)
    offset = total / (scene.steps * number)
    variance = (squares / (scene.steps**2 * number) - offset**2) / np.maximum(number - 1, 1)
    return RawAverage(
        np.where(enough, scene.anchor + offset, np.nan),
        np.where(enough, np.maximum(variance, 0), np.nan),
        count,
        tuple(moved),
        motion_raw,
        sideways_px,
        motion,
    )


def mean_raw(frames: Iterable[RawArray], per_raw: int = 1) -> FloatArray:
    """Return only the mean of `average_raw`.

    Parameters
    ----------
    frames, per_raw
        As there.

    Returns
    -------
    (height, width) float64, raw; NaN = no reading
    """
    return average_raw(frames, per_raw).raw


class _Sums:
    """Sums of small integers, over a stretch of frames in 16 bits: four times as fast.

    Parameters
    ----------
    shape
        Height and width.
    steps
        In a raw unit; the integers are multiples of one.
    """

    def __init__(self, shape: tuple[int, ...], steps: int) -> None:
        # Frames whose squares add up within 16 bits.
        self._stretch = int(np.iinfo(np.int16).max / (steps * _NEAR_RAW) ** 2)
        self._long = np.zeros((3, *shape), dtype=np.int32)
        self._short = np.zeros((3, *shape), dtype=np.int16)
        self._count = 0

    def add(self, values: Int16Array, counted: BoolArray) -> None:
        """Add one frame, which is 0 where it is not counted."""
        total, squares, number = self._short
        total += values
        squares += values * values
        number += counted
        self._count += 1
        if self._count == self._stretch:
            self._carry()

    def totals(self) -> Int32Array:
        """Return the sums (3, height, width) of the values, of their squares, and their number."""
        self._carry()
        return self._long

    def _carry(self) -> None:
        self._long += self._short
        self._short[:] = 0
        self._count = 0


class _StillScene:
    """The scene as long as nothing moves, to compare frames with.

    Differences are in halves of the frames' numbers, of which the median of integers is one;
    `steps` of them are a raw unit.
    """

    def __init__(self, anchor: FloatArray, per_raw: int) -> None:
        self.anchor = anchor
        self.steps = 2 * per_raw
        self._no_reading = NO_READING * per_raw
        self._known = np.isfinite(anchor)
        self._halves = np.where(self._known, self.steps * anchor, 0).astype(np.int16)
        self._slopes, self._steady = self._steady_slopes()
        along_u, along_v = self._row_slopes = [slope[::_ROW_STEP] for slope in self._slopes]
        self._uu, self._uv, self._vv = (
            _block_means(product, _WIDE_BLOCK_PX)
            for product in (along_u * along_u, along_u * along_v, along_v * along_v)
        )

    def _steady_slopes(self) -> tuple[tuple[Float32Array, Float32Array], BoolArray]:
        """Compute disparity gradients, raw/px, and where they are those of a surface; 0 elsewhere.

        Not at the edges of objects and beside gaps.
        """
        known = self._known.astype(np.float32)
        support = cv2.blur(known, (5, 5))
        smooth = cv2.blur(np.where(self._known, self.anchor, 0).astype(np.float32), (5, 5))
        smooth /= np.maximum(support, 1e-3)
        along_u, along_v = (
            cv2.Sobel(smooth, cv2.CV_32F, du, dv, ksize=1, scale=0.5) for du, dv in ((1, 0), (0, 1))
        )
        inside = cv2.erode(known, np.ones((7, 7), np.uint8)) > 0
        steady = inside & (np.maximum(np.abs(along_u), np.abs(along_v)) < _STEEPEST_RAW)
        return (along_u * steady, along_v * steady), steady

    def compare(self, frame: RawArray) -> tuple[Int16Array, BoolArray]:
        """Return the difference (height, width) in steps, and where it is valid."""
        numbers = np.asarray(frame)
        valid = self._known & (numbers < self._no_reading)
        return 2 * numbers.astype(np.int16) - self._halves, valid

    def motion(self, halves: Int16Array, valid: BoolArray) -> Motion | None:
        """Find the translation of one object that explains the changes on surfaces, or None.

        Pixels without change do not count, nor do the edges of objects.
        """
        usable = (valid & (np.abs(halves) < self.steps * _JUMP_RAW)).astype(np.float32)
        share = cv2.blur(usable, (_SMOOTH_PX, _SMOOTH_PX))
        mean = cv2.blur(
            (halves * (usable / self.steps)).astype(np.float32), (_SMOOTH_PX, _SMOOTH_PX)
        )
        mean /= np.maximum(share, 1e-6)
        changed = self._steady & (share > 0.5) & (np.abs(mean) > _CHANGED_RAW)
        lattice = slice(None, None, _EVERY_PX)
        at = np.flatnonzero(changed[lattice, lattice])
        if len(at) < _LEAST_CHANGED:
            return None
        u, v, change, anchor = (
            np.asarray(image[lattice, lattice], dtype=np.float64).ravel()[at]
            for image in (*self._slopes, mean, self.anchor)
        )
        shift, explained = _robust_shift(np.stack([-u, -v, np.ones(len(at))], axis=1), change)
        if explained < _LEAST_EXPLAINED:
            return None
        along_u_px, along_v_px, nearer_raw = shift.tolist()
        return Motion(along_u_px, along_v_px, nearer_raw, float(np.median(anchor)))

    def changes(self, halves: Int16Array, valid: BoolArray) -> tuple[float, float]:
        """Measure how far a part of the picture came nearer, raw units, and went sideways, px.

        Differences beyond `_JUMP_RAW` are the edges of objects, which flicker.
        """
        halves, valid = halves[::_ROW_STEP], valid[::_ROW_STEP]
        usable = (valid & (np.abs(halves) < self.steps * _JUMP_RAW)).astype(np.float32)
        difference = np.multiply(halves, usable, dtype=np.float32)
        difference *= 1 / self.steps
        share = _block_means(usable, _BLOCK_PX)
        wide_share = _block_means(usable, _WIDE_BLOCK_PX)
        return self._nearer_raw(difference, share), self._sideways_px(difference, wide_share)

    def _nearer_raw(self, difference: Float32Array, share: Float32Array) -> float:
        """Return the change that few blocks exceed; their mean has a tenth of a pixel's noise."""
        means = _block_means(difference, _BLOCK_PX) / np.maximum(share, 1e-6)
        return _percentile(np.abs(means[share >= 0.5]), 98)

    def _sideways_px(self, difference: Float32Array, share: Float32Array) -> float:
        """Return the shift that explains the differences by the slopes, exceeded in few blocks.

        Least squares in every block; where there is no slope, no shift is assumed.
        """
        u, v = (_block_means(slope * difference, _WIDE_BLOCK_PX) for slope in self._row_slopes)
        uu, vv = self._uu + _LEAST_GRADIENT, self._vv + _LEAST_GRADIENT
        determinant = uu * vv - self._uv**2
        shift = np.hypot(vv * u - self._uv * v, uu * v - self._uv * u) / determinant
        return _percentile(shift[share >= 0.5], 97)


def _robust_shift(design: FloatArray, change: FloatArray) -> tuple[FloatArray, float]:
    """Fit a shift (3,) to the changes (n,); return it and its inlier share (Geman & McClure)."""
    shift, weights = np.zeros(3), np.ones(len(change))
    for scale in _ROBUST_ROUNDS_RAW:
        weighted = weights[:, None] * design
        # Where a surface shows no shift along a direction, none is assumed.
        normal = weighted.T @ design + _LEAST_GRADIENT * weights.sum() * np.diag([0.1, 0.1, 0])
        shift = np.asarray(np.linalg.solve(normal, weighted.T @ change), dtype=np.float64)
        weights = 1 / (1 + ((change - design @ shift) / scale) ** 2) ** 2
    return shift, float((weights > 0.25).mean())


def _block_means(image: Float32Array, size: int) -> Float32Array:
    """Average over square blocks of pixels, of an image that holds every `_ROW_STEP`-th row."""
    rows = size // _ROW_STEP
    height, width = image.shape[0] // rows, image.shape[1] // size
    if min(height, width) == 0:
        return np.zeros((0, 0), np.float32)
    whole = image[: height * rows, : width * size]
    return np.asarray(cv2.resize(whole, (width, height), interpolation=cv2.INTER_AREA))


def _percentile(values: FloatArray | Float32Array, share: float) -> float:
    """Interpolate a percentile of few numbers, in a tenth of the time of numpy's own."""
    if not values.size:
        return 0.0
    ordered = np.sort(values, axis=None).astype(np.float64)
    return float(np.interp(share / 100 * (len(ordered) - 1), np.arange(len(ordered)), ordered))


def _enough(
    readings: np.ndarray[tuple[int, ...], np.dtype[np.signedinteger]], count: int
) -> BoolArray:
    return np.asarray((readings > 0) & (2 * readings >= count))
