"""Hints from the live pictures of a sensor to the person who sets it up."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import cv2
import numpy as np

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import transform
from insole_core.reconstruct.markers.blobs import find_blobs
from insole_core.reconstruct.markers.detections import locate_blobs
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.reconstruct.volume import is_inside
from insole_core.recording.box import Box
from insole_core.recording.session import ReferenceSystem
from insole_core.sensing.disparity import NO_READING, DisparityModel
from insole_core.sensing.family import SensorFamily
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.driver_values import resized_camera
from insole_studio.acquisition.light import Light, judge_light

DEPTH_RANGE_MM = (400.0, 1200.0)
"""Depth range that the colours of a depth picture cover."""
_CENTRE_PX = 12
_MOVING_RAW = 8.0
_MOVING_SHARE = 0.05
_LEAST_VALID_SHARE = 0.01
_FOOT_POINTS = 1500
"""Minimum number of pixels on a foot at 1 m."""
_LEAST_POINTS = 300
"""Of a foot that is there at all: as many as a toe or a strip of the heel."""
_HIDDEN_SHARE = 0.5
"""Pixels on one of two feet, as a share of those on the other, below which something hides it."""


class HintKind(Enum):
    """What needs to be changed; the window supplies the wording."""

    NOTHING_MEASURED = "nothing measured"
    TOO_NEAR = "too near"
    TOO_FAR = "too far"
    NO_MARKERS = "no markers"
    MARKERS_HIDDEN = "markers hidden"
    NO_FOOT = "no foot"
    FOOT_MISSING = "foot missing"
    FOOT_HIDDEN = "foot hidden"
    TOO_DARK = "too dark"
    TOO_BRIGHT = "too bright"
    MOVING = "moving"


@dataclass(frozen=True)
class Hint:
    """One thing to change.

    Parameters
    ----------
    found, wanted
        Actual and required value, where the kind has any: mm, or number of markers.
    side
        The one of two feet that it is about.
    """

    kind: HintKind
    found: float = 0.0
    wanted: float = 0.0
    side: Side | None = None


@dataclass(frozen=True)
class Guidance:
    """What one sensor sees, and what to improve.

    Parameters
    ----------
    valid_share
        Fraction of the pixels that have a reading.
    markers_seen, markers_wanted
        Number of markers recognised, and required.
    hints
        What to change, the most urgent first; empty when all is well.
    """

    valid_share: float
    markers_seen: int
    markers_wanted: int
    hints: tuple[Hint, ...]


@dataclass(frozen=True, eq=False)
class FrameSnapshot:
    """The newest pictures of one sensor.

    Parameters
    ----------
    depth, depth_before : (rows, columns) uint16, raw
        The newest image, and one from a moment ago.
    color : (height, width, 3) uint8, RGB
        Of any size.
    """

    depth: RawArray
    depth_before: RawArray
    color: ByteArray


def guide(
    sensor: Sensor, system: ReferenceSystem, volume: Box, snapshot: FrameSnapshot
) -> Guidance:
    """Evaluate the pictures of one sensor.

    Parameters
    ----------
    volume
        Box that the foot should be in, reference frame; a system for both feet has its own.
    """
    depth, color = snapshot.depth, snapshot.color
    depth_mm = sensor.depth_mm(np.where(depth == NO_READING, np.nan, depth.astype(float)))
    valid_share = float(np.isfinite(depth_mm).mean())
    volumes = [p.volume_of_interest.moved(p.origin_mm) for p in system.feet] or [volume]
    seen, foot_points = _locate(_for_picture(sensor, color), system, volumes, depth_mm, color)
    wanted = len(system.facing(sensor.faces))
    hints = [
        *_distance_hints(depth_mm, valid_share, sensor.family),
        *_marker_hints(seen, wanted, foot_points),
        *_light_hints(color),
    ]
    if _is_moving(depth, snapshot.depth_before):
        hints.append(Hint(HintKind.MOVING))
    return Guidance(valid_share, seen, wanted, tuple(hints))


def depth_colors(disparity: DisparityModel) -> ByteArray:
    """Return the colour of every raw number, (2048, 3) uint8, RGB; no reading is grey."""
    near, far = DEPTH_RANGE_MM
    raw = np.arange(NO_READING + 1.0)
    raw[NO_READING] = np.nan
    share = (disparity.depth_mm(raw) - near) / (far - near)
    measured = np.isfinite(share)
    level = np.clip(np.where(measured, share, 0) * 255, 0, 255).astype(np.uint8)
    colored = cv2.applyColorMap(level[:, None], cv2.COLORMAP_VIRIDIS)[:, 0, ::-1]
    return np.where(measured[:, None], colored, np.uint8(48))


def centre_depth_mm(disparity: DisparityModel, depth: RawArray) -> float | None:
    """Return the depth in the middle of a raw image; None if nothing is measured there.

    Parameters
    ----------
    depth : (rows, columns) uint16, raw
    """
    middle = _middle(depth)
    measured = middle[middle != NO_READING]
    if not measured.size:
        return None
    mm = float(disparity.depth_mm(np.array(np.median(measured))))
    return mm if np.isfinite(mm) else None


def _middle(image: RawArray) -> RawArray:
    row, column = image.shape[0] // 2, image.shape[1] // 2
    rows, columns = (slice(middle - _CENTRE_PX, middle + _CENTRE_PX) for middle in (row, column))
    return image[rows, columns]


def _for_picture(sensor: Sensor, color: ByteArray) -> Sensor:
    """Return the sensor with the colour camera scaled to a smaller picture."""
    height, width = color.shape[:2]
    return replace(sensor, color_camera=resized_camera(sensor.color_camera, (width, height)))


def _locate(
    sensor: Sensor,
    system: ReferenceSystem,
    volumes: list[Box],
    depth_mm: FloatArray,
    color: ByteArray,
) -> tuple[int, list[int]]:
    """Count the recognised markers and the points inside each volume; none = unknown."""
    points = sensor.points(depth_mm)
    sightings = locate_blobs(find_blobs(color), points, sensor)
    try:
        found = PoseSearch(system, sensor).by_places(sightings)
    except ReconstructionError:
        return 0, []
    placed = transform(found.sensor2reference, points)
    return len(found.fixes), [int(np.count_nonzero(is_inside(placed, box))) for box in volumes]


def _distance_hints(depth_mm: FloatArray, valid_share: float, family: SensorFamily) -> list[Hint]:
    if valid_share < _LEAST_VALID_SHARE:
        return [Hint(HintKind.NOTHING_MEASURED)]
    middle_mm = float(np.nanmedian(depth_mm))
    nearest_mm, farthest_mm = family.reach_mm
    if middle_mm < nearest_mm:
        return [Hint(HintKind.TOO_NEAR, middle_mm, nearest_mm)]
    if middle_mm > farthest_mm:
        return [Hint(HintKind.TOO_FAR, middle_mm, farthest_mm)]
    return []


def _marker_hints(seen: int, wanted: int, foot_points: list[int]) -> list[Hint]:
    if not foot_points:
        return [Hint(HintKind.NO_MARKERS)]
    hints = []
    if seen < wanted:
        hints.append(Hint(HintKind.MARKERS_HIDDEN, wanted - seen, wanted))
    if max(foot_points) < _FOOT_POINTS:
        hints.append(Hint(HintKind.NO_FOOT))
    elif len(foot_points) > 1:
        hints += _hints_of_both(dict(zip(Side, foot_points, strict=True)))
    return hints


def _hints_of_both(points: dict[Side, int]) -> list[Hint]:
    """Say which of two feet the sensor sees less of than it could, one before the other."""
    side = min(points, key=lambda one: points[one])
    if points[side] < _LEAST_POINTS:
        return [Hint(HintKind.FOOT_MISSING, side=side)]
    if points[side] < _HIDDEN_SHARE * points[side.other]:
        return [Hint(HintKind.FOOT_HIDDEN, side=side)]
    return []


def _light_hints(color: ByteArray) -> list[Hint]:
    return {
        Light.DARK: [Hint(HintKind.TOO_DARK)],
        Light.BRIGHT: [Hint(HintKind.TOO_BRIGHT)],
        Light.GOOD: [],
    }[judge_light(color)]


def _is_moving(depth: RawArray, before: RawArray) -> bool:
    measured = (depth != NO_READING) & (before != NO_READING)
    if not measured.any():
        return False
    change = np.abs(depth[measured].astype(float) - before[measured])
    return float(np.mean(change > _MOVING_RAW)) > _MOVING_SHARE
