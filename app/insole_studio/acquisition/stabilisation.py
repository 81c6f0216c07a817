"""Detects when the depth of a sensor is steady after emitters were switched."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from insole_core.sensing.disparity import NO_READING

if TYPE_CHECKING:
    from insole_studio.acquisition.sensor_port import DepthFrame


@dataclass(frozen=True)
class StabilisationRule:
    """The rule for when the count of valid pixels is steady.

    The time that a projector needs is not documented, so it is measured each time. The frames that
    prove the depth steady are good frames themselves and are kept.

    Parameters
    ----------
    frames
        Number of consecutive frames over which the count is compared.
    tolerance
        Largest relative change of the count over these frames.
    most_s
        The longest wait; after it the frames are used as they are, with a warning.
    """

    frames: int = 5
    tolerance: float = 0.05
    most_s: float = 3.0


class _Held(NamedTuple):
    """A frame that may turn out to be steady."""

    frame: DepthFrame
    valid: int


class Stabilisation:
    """Holds frames back until they are steady, then returns every one.

    Parameters
    ----------
    started_s
        On the clock of the frames; earlier frames saw other emitters and are dropped.
    """

    def __init__(self, rule: StabilisationRule, started_s: float) -> None:
        self._rule = rule
        self._started_s = started_s
        self._held: deque[_Held] = deque(maxlen=rule.frames)
        self.settled_after_s: float | None = None
        """Time from the start to the first frame used; None before that."""
        self.timed_out = False

    def add(self, frame: DepthFrame) -> list[DepthFrame]:
        """Add a frame, on the clock of `started_s`; return those that can be used now, in order."""
        time_s = frame.time_s
        if self.settled_after_s is not None:
            return [frame]
        if time_s <= self._started_s:
            return []
        self._held.append(_Held(frame, int(np.count_nonzero(frame.raw != NO_READING))))
        self.timed_out = time_s - self._started_s > self._rule.most_s
        if not (self._steady() or self.timed_out):
            return []
        self.settled_after_s = self._held[0].frame.time_s - self._started_s
        return [held.frame for held in self._held]

    def _steady(self) -> bool:
        counts = [held.valid for held in self._held]
        most = max(counts)
        full = len(counts) == self._rule.frames
        return full and most > 0 and most - min(counts) <= self._rule.tolerance * most
