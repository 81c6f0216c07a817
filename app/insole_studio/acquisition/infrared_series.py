"""The infrared pictures of one view, and depth of the same pose, after its depth and colour."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.messages import Message
from insole_core.sensing.frames import median_raw
from insole_core.sensing.infrared_reference import check_picture
from insole_studio.acquisition.sensor_port import DepthFrame, VideoFrame
from insole_studio.acquisition.view_frames import Series

PICTURES = 6
"""Of each view; their mean halves the noise, and more take time in which the foot moves."""
_DEPTH_FRAMES = 5
_BLOCK_PX = 8
_LEAST_MEASURED = 0.5
_MOST_MOVED_RAW = 1.5
"""Of a foot that moved by 1 mm sideways or 1.5 mm in depth (1.05 to 1.36) the pictures still bring
the surface nearer the truth; by 2 mm sideways (1.9 to 2.5) no longer."""
_PATCH = 7
"""Blocks across a patch, two thirds of a foot's width, whose median no flickering edge moves."""


class InfraredSeries:
    """Collects the infrared pictures of a view whose depth and colour are complete.

    Parameters
    ----------
    before
        Depth and colour of the view.
    switched_s
        When infrared took the place of colour, `time.monotonic()`.
    """

    def __init__(self, before: Series, switched_s: float) -> None:
        self.before = before
        self.pictures: list[RawArray] = []
        self._depth: list[RawArray] = []
        self._switched_s = switched_s

    @property
    def complete(self) -> bool:
        """Whether all pictures have arrived, and depth to compare with."""
        return len(self.pictures) >= PICTURES and len(self._depth) >= _DEPTH_FRAMES

    def take_depth(self, frame: DepthFrame) -> None:
        """Keep a depth frame of the moment of the infrared pictures."""
        if frame.time_s > self._switched_s and len(self._depth) < _DEPTH_FRAMES:
            self._depth.append(frame.raw)

    def take_picture(self, frame: VideoFrame) -> None:
        """Keep an infrared picture, as long as some are missing."""
        if len(self.pictures) < PICTURES:
            self.pictures.append(frame.dots())

    @cached_property
    def moved_raw(self) -> float:
        """By how much depth has changed where it changed most, raw; noise makes it up to 0.25.

        Once complete.
        """
        before, after = (_blocks(median_raw(frames)) for frames in (self.before.depth, self._depth))
        return _largest_median(before - after)

    def check(self) -> tuple[str, ...]:
        """Return why the pictures cannot be used, a sentence each."""
        view = self.before.shot.view
        if self.moved_raw > _MOST_MOVED_RAW:
            return (
                Message(
                    "Something moved between depth and infrared of view {view}, so its infrared "
                    "pictures are left out and the sensor's own depth is used; hold the foot still "
                    "and capture this view again.",
                    view=view,
                ),
            )
        try:
            check_picture(np.mean(self.pictures, axis=0))
        except InputError as error:
            reason = Message("View {view}: {warning}", view=view, warning=error.message)
            return (Message("{reason} The sensor's own depth was used.", reason=reason),)
        return ()


def _largest_median(change: FloatArray) -> float:
    """Return the largest median of a patch of blocks of which half are measured."""
    padded = np.pad(change, _PATCH // 2, constant_values=np.nan)
    patches = np.lib.stride_tricks.sliding_window_view(padded, (_PATCH, _PATCH))
    patches = patches.reshape(-1, _PATCH**2)
    half = np.isfinite(patches).sum(1) >= _LEAST_MEASURED * _PATCH**2
    return float(np.abs(np.nanmedian(patches[half], axis=1)).max(initial=0.0))


def _blocks(raw: FloatArray) -> FloatArray:
    """Return the mean of every block of an image, NaN where half of it is not measured."""
    height, width = (size // _BLOCK_PX for size in raw.shape)
    cut = raw[: height * _BLOCK_PX, : width * _BLOCK_PX]
    blocks = cut.reshape(height, _BLOCK_PX, width, _BLOCK_PX)
    known: BoolArray = np.isfinite(blocks)
    count = known.sum((1, 3))
    total = np.where(known, blocks, 0).sum((1, 3))
    least = _LEAST_MEASURED * _BLOCK_PX**2
    return np.where(count >= least, total / np.maximum(count, 1), np.nan)
