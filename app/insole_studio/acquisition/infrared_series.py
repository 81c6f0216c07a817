"""The infrared pictures of one view, and depth of the same pose, after its depth and colour."""

from __future__ import annotations

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
_MOVED_RAW, _MOVED_SHARE = 1.0, 0.1
"""Two millimetres sideways or 1.4 mm in depth at 700 mm; noise at edges moves up to 7 %."""
_PATCH = 7
"""Blocks across a patch, a third of a foot's width, whose median no flickering edge moves."""


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

    @property
    def moved_raw(self) -> float:
        """By how much depth has changed where it changed most, raw; noise makes it up to 0.25."""
        return _largest_change_raw(_change_raw(self.before.depth, self._depth))

    def check(self) -> tuple[str, ...]:
        """Return why the pictures cannot be used, a sentence each."""
        view = self.before.shot.view
        if _moved_share(_change_raw(self.before.depth, self._depth)) > _MOVED_SHARE:
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


def _change_raw(before: list[RawArray], after: list[RawArray]) -> FloatArray:
    """Return the change of depth of every block, NaN where it is not measured."""
    return _blocks(median_raw(before)) - _blocks(median_raw(after))


def _moved_share(change_raw: FloatArray) -> float:
    """Return the fraction of the measured blocks whose depth has changed."""
    measured = np.isfinite(change_raw)
    return float(np.mean(np.abs(change_raw[measured]) > _MOVED_RAW)) if measured.any() else 0.0


def _largest_change_raw(change_raw: FloatArray) -> float:
    """Return the largest median of a patch of blocks of which half are measured."""
    padded = np.pad(change_raw, _PATCH // 2, constant_values=np.nan)
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
