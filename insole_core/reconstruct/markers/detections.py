"""From blobs in the colour image to points in space, through the depth image."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.markers.blobs import Blobs
from insole_core.sensing.sensor import Sensor

_RIM_SHARE = 3 / 1280
"""Width of a blob's rim as a share of the image width."""
_NEAR_MM = 4.0
_PLACE_SHARE = 6 / 1280
"""Half the width of what is looked at round a place, as a share of the image width."""
_DISTANCES_MM = (400.0, 2000.0)
_AROUND_PX = 10


@dataclass(frozen=True)
class SizeLimits:
    """How large a marker can be, and how much depth must support it."""

    smallest_mm: float = 6.0
    largest_mm: float = 40.0
    least_depth_pixels: int = 5


@dataclass(frozen=True, eq=False)
class Detections:
    """Blobs that have a place in space.

    Parameters
    ----------
    pixels : (n, 2) float64, px, colour image
    points : (n, 3) float64, mm, depth camera frame
    spreads : (n, 2, 2) float64, px², optional
        Covariance of the pixels of each.
    fills : (n,) float64, optional
        How square each is (see `Blobs`).
    placed
        So many at the end are no blue spots, but places that somebody pointed at: they have NaN
        for `spreads` and `fills`, and for `points` where the depth image tells nothing.
    """

    pixels: FloatArray
    points: FloatArray
    spreads: FloatArray | None = None
    fills: FloatArray | None = None
    placed: int = 0

    def __len__(self) -> int:
        return len(self.points)

    def with_places(self, pixels: FloatArray, points: FloatArray) -> Detections:
        """Add places (k, 2) that somebody pointed at, with their points (k, 3)."""
        more = len(pixels)
        return Detections(
            np.concatenate([self.pixels, pixels]),
            np.concatenate([self.points, points]),
            _extended(self.spreads, more),
            _extended(self.fills, more),
            self.placed + more,
        )


def locate_blobs(
    blobs: Blobs,
    points: FloatArray,
    sensor: Sensor,
    limits: SizeLimits = SizeLimits(),
) -> Detections:
    """Place blobs in space: the direction from the colour image, the distance from the depth.

    Of every blob the rim is left out, where depth runs over to what lies behind, and the distance
    of the rest is taken along the ray through its centroid (thesis 6.2.2, with (13) - (15) run
    backwards). The distance is the mean of what lies near the median: the median alone has the
    steps of the sensor, 2 mm.

    Parameters
    ----------
    blobs
    points : (height, width, 3) float64, mm, depth camera frame, NaN = no reading
    sensor
    """
    color_points = transform(sensor.depth2color, points[np.isfinite(points[..., 2])])
    blob = _blob_below(sensor.color_camera.project(color_points), _without_rim(blobs.labels))
    distance, support = _robust_means(color_points[blob >= 0, 2], blob[blob >= 0], len(blobs))
    size_mm = np.sqrt(blobs.areas) * distance / sensor.color_camera.fx
    good = (support >= limits.least_depth_pixels) & (size_mm >= limits.smallest_mm)
    good &= size_mm <= limits.largest_mm
    pixels = blobs.centroids[good]
    rays = sensor.color_camera.normalised(pixels)
    in_color = np.column_stack([rays, np.ones(len(rays))]) * distance[good, None]
    spreads, fills = (None if x is None else x[good] for x in (blobs.spreads, blobs.fills))
    return Detections(pixels, transform(inverse(sensor.depth2color), in_color), spreads, fills)


def locate_places(pixels: FloatArray, points: FloatArray, sensor: Sensor) -> FloatArray:
    """Place what somebody pointed at in space, by the depth readings round it.

    Parameters
    ----------
    pixels : (n, 2) float64, px, colour image
    points : (height, width, 3) float64, mm, depth camera frame, NaN = no reading
    sensor

    Returns
    -------
    (n, 3) float64, mm, depth camera frame; NaN where there is no reading
    """
    return np.array([_point_below(pixel, points, sensor) for pixel in pixels]).reshape(-1, 3)


def _point_below(pixel: FloatArray, points: FloatArray, sensor: Sensor) -> FloatArray:
    camera, color2depth = sensor.color_camera, inverse(sensor.depth2color)
    ray = np.append(camera.normalised(pixel[None])[0], 1.0)
    # Only the part of the depth image is looked at in which the ray can lie.
    ends = sensor.depth_camera.project(
        transform(color2depth, ray * np.array(_DISTANCES_MM)[:, None])
    )
    low = np.maximum(np.floor(ends.min(0)).astype(int) - _AROUND_PX, 0)
    high = np.maximum(np.ceil(ends.max(0)).astype(int) + _AROUND_PX, 0)
    patch = points[low[1] : high[1], low[0] : high[0]].reshape(-1, 3)
    in_color = transform(sensor.depth2color, patch[np.isfinite(patch[:, 2])])
    apart = np.linalg.norm(camera.project(in_color) - pixel, axis=1)
    distances = in_color[apart < _PLACE_SHARE * camera.width, 2]
    if len(distances) == 0:
        return np.full(3, np.nan)
    return transform(color2depth, ray * float(np.median(distances)))


def _extended(values: FloatArray | None, more: int) -> FloatArray | None:
    """Add so many unknown ones."""
    if values is None:
        return None
    return np.concatenate([values, np.full((more, *values.shape[1:]), np.nan)])


def _without_rim(labels: IndexArray) -> IndexArray:
    steps = max(1, round(_RIM_SHARE * labels.shape[1]))
    inside = cv2.erode((labels >= 0).astype(np.uint8), np.ones((3, 3), np.uint8), iterations=steps)
    return np.where(inside > 0, labels, -1)


def _blob_below(pixels: FloatArray, labels: IndexArray) -> IndexArray:
    """Give for every pixel position (n, 2) the blob there, -1 for none or outside."""
    height, width = labels.shape
    u, v = np.rint(pixels).astype(np.int64).T
    inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
    return np.where(inside, labels[np.clip(v, 0, height - 1), np.clip(u, 0, width - 1)], -1)


def _robust_means(
    values: FloatArray, group: IndexArray, count: int
) -> tuple[FloatArray, np.ndarray[tuple[int], np.dtype[np.intp]]]:
    """Mean of what lies near the median of every group, NaN for an empty one, and its size."""
    order = np.lexsort((values, group))
    size = np.bincount(group, minlength=count)
    middle = np.cumsum(size) - size + size // 2
    median = np.append(values[order], np.nan)[np.where(size > 0, middle, -1)]
    near = np.abs(values - median[group]) <= _NEAR_MM
    total = np.bincount(group[near], values[near], minlength=count)
    support = np.bincount(group[near], minlength=count)
    return np.divide(total, support, out=np.full(count, np.nan), where=support > 0), support
