"""The frames of one view as they arrive, and checks on them once complete."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from insole_core.geometry.arrays import RawArray
from insole_core.messages import Message
from insole_core.recording.session import FrameTimes
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.frames import median_raw
from insole_studio.acquisition.capture_plan import CapturePlan, Shot
from insole_studio.acquisition.light import Light
from insole_studio.acquisition.messages import Capability, ViewStatus
from insole_studio.acquisition.sensor_port import DepthFrame, OpenSensor
from insole_studio.acquisition.stabilisation import Stabilisation

_LEAST_VALID_SHARE = 0.01
_MOVED_RAW = 4.0
"""Twice the depth step at 1 m, and far above the noise of a median of several frames."""
_MOVED_SHARE = 0.1
_SAME_S = 0.08
"""Longer than the pause between two colour pictures of a RealSense; a foot hardly moves in it."""
_CHECK_STEP_PX = 3
"""Every ninth pixel shows whether something moved."""


class Beginning(NamedTuple):
    """The state when a series begins.

    Parameters
    ----------
    switched_s
        When the emitters were switched, `time.monotonic()`.
    clear_s
        Until when frames were still exposed with the previous emitters on.
    discarded
        Number of frames of the sensor that had arrived damaged before.
    """

    switched_s: float
    clear_s: float
    discarded: int


class Series:
    """Collects the frames of one shot."""

    def __init__(
        self, shot: Shot, sensor: OpenSensor, plan: CapturePlan, beginning: Beginning
    ) -> None:
        self.shot = shot
        self.sensor = sensor
        self.depth: list[RawArray] = []
        self._depth_ms: list[float] = []
        self._color_ms: list[float] = []
        self.pair_count = 0
        self.light = Light.GOOD
        """Of the last colour picture."""
        self.stabilisation = Stabilisation(plan.settle, beginning.switched_s)
        self._plan = plan
        self._beginning = beginning

    @property
    def settled(self) -> bool:
        """Whether the depth is steady and frames are being used."""
        return self.stabilisation.settled_after_s is not None

    @property
    def complete(self) -> bool:
        """Whether all frames have arrived."""
        plan = self._plan
        pairs = plan.color_frames if Capability.PAIR in self.sensor.capabilities else 0
        return (
            len(self.depth) >= plan.frames
            and self.color_count >= plan.color_frames
            and self.pair_count >= pairs
        )

    @property
    def wants_pair(self) -> bool:
        """Return whether a pair of infrared pictures is used: as many as of colour."""
        return bool(self.depth) and self.pair_count < self._plan.color_frames

    @property
    def discarded(self) -> int:
        """Return the number of depth frames that arrived damaged since the start."""
        return self.sensor.discarded - self._beginning.discarded

    def take_depth(self, frame: DepthFrame) -> list[tuple[int, RawArray]]:
        """Add a depth frame; return the numbers and images of the frames that can be used now."""
        if frame.time_s <= self._beginning.clear_s:
            return []
        missing = self._plan.frames - len(self.depth)
        used = self.stabilisation.add(frame)[:missing]
        first = len(self.depth)
        self.depth += [one.raw for one in used]
        self._depth_ms += [1000 * one.time_s for one in used]
        return [(first + place, one.image) for place, one in enumerate(used)]

    def take_color(self, time_s: float) -> int:
        """Count a colour picture, and return its number."""
        self._color_ms.append(1000 * time_s)
        return len(self._color_ms) - 1

    @property
    def color_count(self) -> int:
        """Return how many colour pictures were taken."""
        return len(self._color_ms)

    @property
    def times(self) -> FrameTimes | None:
        """Return when its pictures were taken, ms since the first depth frame, if it tells."""
        if not self._is_timed:
            return None
        first_ms = self._depth_ms[0]
        depth, color = (
            tuple(round(moment - first_ms, 1) for moment in moments)
            for moments in (self._depth_ms, self._color_ms)
        )
        return FrameTimes(depth, color)

    def wants_color(self, time_s: float) -> bool:
        """Return whether a colour frame of that time is used.

        Emitters do not disturb colour; of a sensor that tells when its pictures were taken, it is
        of the instant of the depth.
        """
        begins_s = self._beginning.switched_s
        if self._is_timed:
            begins_s = self._depth_ms[0] / 1000 - _SAME_S if self._depth_ms else float("inf")
        return time_s > begins_s and self.color_count < self._plan.color_frames

    @property
    def _is_timed(self) -> bool:
        return Capability.TIMED in self.sensor.capabilities

    def status(self, finished: bool = False, warnings: tuple[str, ...] = ()) -> ViewStatus:
        """Return the progress of the view.

        Parameters
        ----------
        finished
            Whether the view is complete on the disk.
        warnings
            Sentences about what was captured.
        """
        shot = self.shot
        return ViewStatus(
            shot.view,
            shot.serial,
            len(self.depth),
            self._plan.frames,
            finished,
            warnings,
            shot.place,
        )

    def check(self) -> tuple[str, ...]:
        """Return what is doubtful about the frames, one sentence each."""
        view, warnings = self.shot.view, []
        if self.stabilisation.timed_out:
            warnings.append(
                Message(
                    "The depth of view {view} was still changing when it was captured; hold the "
                    "foot still and capture this view again.",
                    view=view,
                )
            )
        valid = float(np.mean([np.mean(image != NO_READING) for image in self.depth]))
        if valid < _LEAST_VALID_SHARE:
            warnings.append(
                Message(
                    "View {view} measured depth in only {share:.1%} of its picture; check that it "
                    "is far enough from the foot and not covered, and capture this view again.",
                    view=view,
                    share=valid,
                )
            )
        if _moved_share(self.depth) > _MOVED_SHARE:
            warnings.append(
                Message(
                    "Something moved while view {view} was captured; hold the foot still and "
                    "capture this view again.",
                    view=view,
                )
            )
        return (*warnings, *self._check_times(), *self._check_light())

    def _check_times(self) -> tuple[str, ...]:
        times = self.times
        if times is None or times.color_apart_ms <= 1000 * _SAME_S:
            return ()
        return (
            Message(
                "The colour picture of view {view} was taken {apart_ms:.0f} ms apart from its "
                "depth; hold the foot still and capture this view again.",
                view=self.shot.view,
                apart_ms=times.color_apart_ms,
            ),
        )

    def _check_light(self) -> tuple[str, ...]:
        if self.light is Light.GOOD:
            return ()
        view = self.shot.view
        if self.light is Light.DARK:
            return (
                Message(
                    "The colour picture of view {view} is too dark; add light and capture this "
                    "view again.",
                    view=view,
                ),
            )
        return (
            Message(
                "The colour picture of view {view} is too bright; turn strong lights away and "
                "capture this view again.",
                view=view,
            ),
        )


def _moved_share(frames: list[RawArray]) -> float:
    """Return the fraction of pixels valid in both halves of a series that changed between them."""
    half = len(frames) // 2
    if half < 2:
        return 0.0
    coarse = [image[::_CHECK_STEP_PX, ::_CHECK_STEP_PX] for image in frames]
    change = np.abs(median_raw(coarse[:half]) - median_raw(coarse[half:]))
    measured = np.isfinite(change)
    return float(np.mean(change[measured] > _MOVED_RAW)) if measured.any() else 0.0
