"""Noise of single frames, and drift while the sensor warms up."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import RawArray
from insole_core.sensing.disparity import NO_READING, DisparityModel

_SETTLED_MM = 0.5
_STILL_RAW = 10.0
"""Frames that differ by more show different scenes: no sensor is that noisy."""
_CENTRE = (slice(200, 280), slice(270, 370))


@dataclass(frozen=True)
class Noise:
    """Temporal noise of one pixel, as medians over the image."""

    frames: int
    sd_raw: float
    sd_mm: float
    missing_share: float


@dataclass(frozen=True)
class WarmUp:
    """Depth at the image centre over time.

    Parameters
    ----------
    seconds, depth_mm
        The curve.
    drift_mm
        From the first to the last moment.
    settled_after_s
        Time after which the depth stays within 0.5 mm of the last; infinite if it never does.
    """

    seconds: tuple[float, ...]
    depth_mm: tuple[float, ...]
    drift_mm: float
    settled_after_s: float


def measure_noise(frames: Iterable[RawArray], disparity: DisparityModel) -> Noise:
    """Measure the temporal noise of every pixel of a still scene, in one pass (Welford).

    Parameters
    ----------
    frames : each (480, 640) uint16, raw units
    disparity
        Converts the noise to mm.

    Raises
    ------
    InputError
        If there are fewer than two frames, or they show different scenes.
    """
    count, total = np.zeros((480, 640)), 0
    mean, squares = np.zeros((480, 640)), np.zeros((480, 640))
    for frame in frames:
        seen = frame < NO_READING
        count += seen
        step = np.where(seen, frame - mean, 0)
        mean += np.divide(step, count, out=np.zeros_like(step), where=count > 0)
        squares += step * np.where(seen, frame - mean, 0)
        total += 1
    steady = count >= 2
    if total < 2 or not steady.any():
        raise InputError("The noise needs at least two frames with readings; record more.")
    sd = np.sqrt(squares[steady] / (count[steady] - 1))
    if np.median(sd) > _STILL_RAW:
        raise InputError(
            "The {count} frames show different scenes (they differ by {difference_raw:.0f} raw "
            "units); record one still wall without moving the sensor.",
            count=total,
            difference_raw=np.median(sd),
        )
    depth = disparity.depth_mm(mean[steady])
    per_raw = disparity.depth_mm(mean[steady] + 0.5) - disparity.depth_mm(mean[steady] - 0.5)
    sd_mm = (sd * per_raw)[np.isfinite(depth)]
    if not np.isfinite(sd_mm).any():
        raise InputError(
            "The frames show nothing at a distance that the sensor measures; record a wall 500 to "
            "3000 mm away."
        )
    return Noise(total, float(sd.mean()), float(np.nanmean(sd_mm)), float(1 - count.mean() / total))


def measure_warm_up(moments: Iterable[tuple[float, RawArray]], disparity: DisparityModel) -> WarmUp:
    """Measure the depth at the image centre over time.

    Parameters
    ----------
    moments
        Seconds and frame (480, 640), raw units, in order of time.

    Raises
    ------
    InputError
        If there are fewer than three moments with readings.
    """
    seconds, depths = [], []
    for time_s, frame in moments:
        window = frame[_CENTRE].astype(float)
        depth = disparity.depth_mm(np.where(window < NO_READING, window, np.nan))
        if np.isfinite(depth).any():
            seconds.append(time_s)
            depths.append(float(np.nanmean(depth)))
    if len(depths) < 3:
        raise InputError("The warm-up needs three moments with readings; record for 15 minutes.")
    away = np.abs(np.array(depths) - depths[-1]) > _SETTLED_MM
    last_away = int(np.flatnonzero(away)[-1]) if away.any() else -1
    settled = seconds[last_away + 1] if last_away + 1 < len(seconds) - 1 else float("inf")
    return WarmUp(tuple(seconds), tuple(depths), depths[-1] - depths[0], settled)
